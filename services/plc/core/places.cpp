// SPDX-License-Identifier: Apache-2.0
#include "places.hpp"

#include <algorithm>

#include "plc/machine/arithmetic.hpp"
#include "plc/semantics/type.hpp"

namespace trunnion::plc {
namespace {

idl::plc::ValueKind kind_of(st::Kind kind) {
  using enum idl::plc::ValueKind;
  switch (kind) {
    case st::Kind::boolean:
      return BOOL_VALUE;
    case st::Kind::real:
      return REAL_VALUE;
    case st::Kind::lreal:
      return LREAL_VALUE;
    case st::Kind::time:
    case st::Kind::ltime:
      return DURATION_VALUE;
    case st::Kind::date:
      return DATE_VALUE;
    case st::Kind::tod:
      return TIME_OF_DAY_VALUE;
    case st::Kind::dt:
      return DATE_AND_TIME_VALUE;
    case st::Kind::string:
      return STRING_VALUE;
    case st::Kind::enumeration:
    case st::Kind::interface_:
    case st::Kind::reference:
    case st::Kind::pointer:
      return ENUMERATED_VALUE;
    default:
      return st::is_signed(kind) ? SIGNED_VALUE : UNSIGNED_VALUE;
  }
}

}  // namespace

ValuePlace place_of(const st::Location& at) {
  ValuePlace place;
  place.cell = at.address;
  place.cells = at.type->cells;
  if (!place.is_register()) return place;
  const auto address = st::register_at(at.address);
  place.address = {address.area, address.index, static_cast<std::int8_t>(at.bit)};
  place.form = at.bit >= 0 ? std::uint16_t{1} : st::cell_form(at.type->kind);
  return place;
}

void copy_value(const Memory& memory, const ValuePlace& place, std::span<std::uint64_t> to) {
  if (place.is_register()) {
    const auto value = static_cast<std::uint64_t>(std::int64_t{load(memory.registers, place.address)});
    to[0] = st::narrowed(value, place.form);
    return;
  }
  const auto* from = memory.program.values.data() + (place.cell - st::image_cells);
  std::copy_n(from, place.cells, to.begin());
}

idl::plc::VariableInfo info_of(const st::Location& at) {
  idl::plc::VariableInfo info;
  info.path = at.path.substr(0, 240);
  info.type = at.type->name.substr(0, 64);
  info.kind = kind_of(at.type->kind);
  info.unit = at.unit.substr(0, 16);
  info.cells = static_cast<std::uint16_t>(at.type->cells);
  info.retained = at.retained;
  for (const auto& enumerator : at.type->enumerators) {
    if (info.names.size() == 64) break;
    info.names.push_back({enumerator.text.substr(0, 64), enumerator.value});
  }
  if (st::is_reference(at.type->kind))
    info.names.push_back({"NULL", static_cast<std::int64_t>(st::null_reference)});
  return info;
}

}  // namespace trunnion::plc
