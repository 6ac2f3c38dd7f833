// SPDX-License-Identifier: Apache-2.0
#include "plc_session.hpp"

#include <stdexcept>

#include "cluster/cluster.hpp"
#include "plc/syntax/token.hpp"
#include "plc/tools/value_text.hpp"

namespace trunnion::cli {
namespace {

constexpr double answer_time = 10;  // s

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

ShownVariables::ShownVariables(const std::vector<idl::plc::VariableInfo>& variables) : variables_(variables) {
  for (const auto& info : variables_) {
    types_.push_back(type_of(info));
    cells_ += info.cells;
  }
}

std::vector<std::string> ShownVariables::texts(std::span<const std::uint64_t> cells) const {
  std::vector<std::string> result;
  for (std::size_t i = 0; i < variables_.size(); ++i) {
    result.push_back(st::value_text(types_[i], cells.subspan(0, variables_[i].cells)));
    cells = cells.subspan(variables_[i].cells);
  }
  return result;
}

PlcSession::PlcSession(const Common& common)
    : client_(cluster::find_cluster(common.domain).network),
      requests_(client_.bus(), topics::online_request, topics::online_reply) {}

OnlineReply PlcSession::call(OnlineRequest request) {
  auto reply = requests_.call(std::move(request), answer_time);
  if (!reply) throw std::runtime_error("the PLC has not answered within 10 s");
  if (!reply->accepted) throw std::runtime_error(reply->reason);
  return *std::move(reply);
}

OnlineReply PlcSession::call(OnlineAction action) {
  OnlineRequest request;
  request.action = action;
  return call(std::move(request));
}

}  // namespace trunnion::cli
