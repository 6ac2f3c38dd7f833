// SPDX-License-Identifier: Apache-2.0
#include "plc/online/shown_variables.hpp"

#include "plc/syntax/token.hpp"
#include "plc/tools/value_text.hpp"

namespace trunnion::plc_online {
namespace {

st::Type type_of(const idl::plc::VariableInfo& info) {
  using idl::plc::ValueKind;
  if (const auto* known = st::elementary(st::upper_case(info.type))) return *known;
  st::Type type;
  type.name = info.type;
  type.cells = info.cells;
  switch (info.kind) {
    case ValueKind::STRING_VALUE:
      type.kind = st::Kind::string;
      type.length = (info.cells - 1u) * 8;
      break;
    case ValueKind::ENUMERATED_VALUE:
      type.kind = st::Kind::enumeration;
      for (const auto& name : info.names)
        type.enumerators.push_back({st::upper_case(name.name), name.name, name.value});
      break;
    default:  // a subrange
      type.kind = info.kind == ValueKind::UNSIGNED_VALUE ? st::Kind::ulint : st::Kind::lint;
      break;
  }
  return type;
}

}  // namespace

bus::Json json_of(const idl::plc::VariableInfo& info) {
  bus::Json json = {{"path", info.path}, {"type", info.type}};
  if (!info.unit.empty()) json["unit"] = info.unit;
  json["retained"] = info.retained;
  if (!info.names.empty()) {
    auto& names = json["names"] = bus::Json::object();
    for (const auto& name : info.names) names[name.name] = name.value;
  }
  return json;
}

ShownVariables::ShownVariables(const std::vector<idl::plc::VariableInfo>& variables) : variables_(variables) {
  for (const auto& info : variables_) {
    types_.push_back(type_of(info));
    cells_ += info.cells;
  }
}

bus::Json ShownVariables::json() const {
  auto list = bus::Json::array();
  for (const auto& info : variables_) list.push_back(json_of(info));
  return list;
}

std::vector<std::string> ShownVariables::texts(std::span<const std::uint64_t> cells) const {
  std::vector<std::string> result;
  for (std::size_t i = 0; i < variables_.size(); ++i) {
    result.push_back(st::value_text(types_[i], cells.subspan(0, variables_[i].cells)));
    cells = cells.subspan(variables_[i].cells);
  }
  return result;
}

}  // namespace trunnion::plc_online
