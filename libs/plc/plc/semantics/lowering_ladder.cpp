// SPDX-License-Identifier: Apache-2.0
// MOV, ADD, SUB, MUL, DIV and DISAS as the ladder of the manuals has them (HNC-8, macro variables and
// PLC, 4.4): the target is an argument, and the value is cut off to its size.
#include "plc/library/functions.hpp"
#include "plc/semantics/lowering.hpp"

namespace trunnion::st {
namespace {

constexpr std::int64_t most_bytes = 8;

const Expression* argument_of(const Expression& e, std::string_view name, std::size_t position) {
  for (const auto& argument : e.arguments)
    if (argument.name == name) return argument.value.get();
  if (position < e.arguments.size() && e.arguments[position].name.empty())
    return e.arguments[position].value.get();
  return nullptr;
}

bool has_target(const Expression& e) {
  for (const auto& argument : e.arguments)
    if (argument.name == "D") return true;
  return false;
}

const char* operator_of(const std::string& name) {
  return name == "ADD" ? "+" : name == "SUB" ? "-" : name == "MUL" ? "*" : name == "DIV" ? "/" : nullptr;
}

}  // namespace

/// Nothing when the call is none of these.
std::optional<Value> Lowering::ladder_function(const Expression& e) {
  const auto& name = e.parts[0]->name;
  const auto* sign = operator_of(name);
  const bool moves = name == "MOV" && (e.arguments.size() != 1 || has_target(e));
  if (!moves && name != "DISAS" && (sign == nullptr || !has_target(e))) return std::nullopt;
  const std::size_t expected = moves ? 2 : 3;
  const auto wrong = [&] {
    return failed(e.at, name + (moves             ? " has the parameters S and D"
                                : sign != nullptr ? " with a target has the parameters S1, S2 and D"
                                                  : " has the parameters N, D and S"));
  };
  if (e.arguments.size() != expected) return wrong();
  const auto* to = argument_of(e, "D", 1);
  if (moves) {
    const auto* from = argument_of(e, "S", 0);
    if (from == nullptr || to == nullptr) return wrong();
    return move_converted(*to, expression(*from));
  }
  if (sign == nullptr) {
    const auto *count = argument_of(e, "N", 0), *from = argument_of(e, "S", 2);
    if (count == nullptr || from == nullptr || to == nullptr) return wrong();
    return disassemble(*count, *to, expression(*from), from->at);
  }
  const auto *left = argument_of(e, "S1", 0), *right = argument_of(e, "S2", 1);
  if (left == nullptr || right == nullptr || to == nullptr) return wrong();
  const auto first = expression(*left);
  const auto second = expression(*right);
  if (first.is_error() || second.is_error()) return error();
  emit_.place(e.at);
  return move_converted(*to, arithmetic(sign, kept(first), second, e.at));
}

Value Lowering::move_converted(const Expression& to, const Value& value) {
  const auto target = this->target(to);
  if (value.is_error() || !check_writable(target, to.at)) return error();
  note(to, target, writing());
  const bool converts = value.is_literal() || !is_elementary(value.type->kind) ||
                        !is_elementary(target.type->kind) || widens(*value.type, *target.type);
  const auto result = converts ? converted(value, *target.type, to.at)
                               : converted_to(value, *elementary(target.type->kind), false, to.at);
  store(target, result);
  Value none;
  none.type = elementary(Kind::none);
  return none;
}

Value Lowering::disassemble(const Expression& count, const Expression& to, const Value& value, Position at) {
  Value number;
  if (!unit_.constant(count, *elementary(Kind::dint), pou_, number)) return error();
  const auto target = this->target(to);
  if (value.is_error() || !check_writable(target, to.at)) return error();
  if (number.integer < 1 || number.integer > most_bytes)
    return failed(count.at, "DISAS gives 1 .. 8 bytes, not " + std::to_string(number.integer));
  const auto from = value.is_literal() ? Kind::lint : value.type->kind;
  if (!is_integer(from) && !is_bits(from)) return failed(at, "DISAS is for integers and bit strings");
  const auto& element = target.type->kind == Kind::array ? *target.type->element : *target.type;
  const auto cells = static_cast<std::uint32_t>(number.integer);
  const auto first = static_cast<std::uint32_t>(target.place.offset);
  const bool in_image = target.place.base == Place::Base::absolute && first < image_cells;
  const bool fits = target.type->kind == Kind::array ? cells <= target.type->cells
                    : in_image                       ? first + cells <= image_cells &&
                                     register_at(first).area == register_at(first + cells - 1).area
                               : cells == 1;
  if ((!is_integer(element.kind) && !is_bits(element.kind)) || bits(element.kind) != 8 ||
      target.place.bit >= 0)
    return failed(to.at, "DISAS writes registers of 8 bits, as %Y10, or an array of BYTE or USINT, not " +
                             target.type->name);
  if (!fits)
    return failed(to.at, "there are fewer than " + std::to_string(cells) + " registers from here on");
  const auto source = cell(value, *elementary(from));
  for (std::uint32_t i = 0; i < cells; ++i) {
    auto part = target;
    part.type = &element;
    part.place = moved(target.place, static_cast<std::int32_t>(i));
    note(to, part, writing());
    mark_written(part);
    const auto byte = emit_.temporary();
    emit_.add(Op::field_get, byte, source, 8, static_cast<std::uint16_t>(8 * i));
    emit_.add(Op::narrow, byte, byte, 0, cell_form(element.kind));
    store_cell(part.place, element, byte);
  }
  Value none;
  none.type = elementary(Kind::none);
  return none;
}

}  // namespace trunnion::st
