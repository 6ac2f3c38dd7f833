// SPDX-License-Identifier: Apache-2.0
#include "plc/tools/variables.hpp"

#include <algorithm>
#include <charconv>
#include <map>
#include <set>
#include <stdexcept>

#include "plc/library/register_names.hpp"
#include "plc/machine/arithmetic.hpp"
#include "plc/syntax/token.hpp"
#include "plc/tools/value_text.hpp"

namespace trunnion::st {
namespace {

[[noreturn]] void refuse(const std::string& path, const std::string& why) {
  throw std::runtime_error("'" + path + "': " + why);
}

bool is_compound(const Type& type) {
  return type.kind == Kind::array || type.kind == Kind::structure || type.kind == Kind::block;
}

bool begins_path(const std::string& path, const std::string& name) {
  return path.starts_with(name) &&
         (path.size() == name.size() || path[name.size()] == '.' || path[name.size()] == '[');
}

/// Variables of a function block that have a value of their own.
bool has_value(const Variable& variable) {
  return variable.type->kind != Kind::error && !variable.constant.is_constant &&
         variable.section != VariableSection::in_out && variable.section != VariableSection::external &&
         variable.section != VariableSection::temporary && variable.place.base != Place::Base::none;
}

std::string why_without_value(const Variable& variable) {
  if (variable.constant.is_constant) return "it is a constant";
  if (variable.section == VariableSection::in_out) return "it is VAR_IN_OUT and has no value of its own";
  if (variable.section == VariableSection::external) return "it is VAR_EXTERNAL; name the global variable";
  return "it has no value between two scans";
}

Location part(const Location& whole, const std::string& suffix, const Type* type, std::uint32_t address) {
  auto at = whole;
  at.path += suffix, at.type = type, at.address = address;
  return at;
}

Location member(const Location& block, const Variable& variable) {
  const auto offset = static_cast<std::uint32_t>(variable.place.offset);
  auto at = part(block, "." + variable.text, variable.type,
                 variable.place.base == Place::Base::absolute ? offset : block.address + offset);
  at.bit = variable.place.bit;
  return at;
}

Location register_location(const std::string& path, const RegisterAddress& address) {
  const auto& area = info(address.area);
  const auto kind = address.bit >= 0  ? Kind::boolean
                    : area.bits == 8  ? Kind::usint
                    : area.bits == 16 ? Kind::uint_
                                      : Kind::dint;
  return {path, elementary(kind), address_of(address.area, address.index), address.bit, area.retained, ""};
}

std::string register_text(std::uint32_t cell, int bit) {
  auto at = register_at(cell);
  at.bit = static_cast<std::int8_t>(bit);
  return register_text(at);
}

const NamedRegister* named_register(std::uint32_t cell, int bit) {
  for (const auto& one : register_table())
    if (address_of(one.address.area, one.address.index) == cell && one.address.bit == bit) return &one;
  return nullptr;
}

/// Values of the one can be values of the other, with the same meaning.
bool same_values(const Type& a, const Type& b) {
  if (a.kind != b.kind || a.cells != b.cells || a.length != b.length) return false;
  if (a.ranged != b.ranged || a.low != b.low || a.high != b.high) return false;
  return std::equal(a.enumerators.begin(), a.enumerators.end(), b.enumerators.begin(), b.enumerators.end(),
                    [](const auto& x, const auto& y) { return x.name == y.name && x.value == y.value; });
}

}  // namespace

std::uint64_t value_cell(const Location& at, std::uint64_t cell) {
  if (at.bit >= 0) return (cell >> at.bit) & 1u;
  return at.is_register() ? narrowed(cell, cell_form(at.type->kind)) : cell;
}

std::int64_t register_number_of(const Location& at, std::uint64_t value) {
  const auto& area = info(register_at(at.address).area);
  const auto form = static_cast<unsigned>(area.bits) | (area.is_signed ? signed_flag : 0u);
  return at.bit >= 0 ? as_signed(value) : as_signed(narrowed(value, form));
}

SymbolInPath symbol_in(const std::vector<Symbol>& symbols, const std::string& upper) {
  SymbolInPath best;
  for (const auto& symbol : symbols)
    if (begins_path(upper, upper_case(symbol.path)) && symbol.path.size() > best.end)
      best = {&symbol, symbol.path.size()};
  if (best.symbol != nullptr) return best;
  for (const auto& symbol : symbols) {
    if (symbol.name_at == 0 || !begins_path(upper, upper_case(symbol.path.substr(symbol.name_at)))) continue;
    if (best.symbol != nullptr) refuse(upper, "several programs have it; write program.variable");
    best = {&symbol, symbol.path.size() - symbol.name_at};
  }
  return best;
}

Variables::Variables(const Compilation& compilation)
    : symbols_(compilation.symbols),
      constants_(compilation.constants),
      retained_(compilation.code->retained),
      retained_registers_(compilation.code->retained_registers),
      types_(compilation.types) {}

Location Variables::with_retention(Location at) const {
  if (at.is_register()) {
    const auto address = register_at(at.address);
    at.retained = info(address.area).retained ||
                  std::any_of(retained_registers_.begin(), retained_registers_.end(), [&](const auto& kept) {
                    return kept.area == address.area && kept.index == address.index &&
                           (kept.bit < 0 || kept.bit == at.bit);
                  });
    if (const auto* named = named_register(at.address, at.bit)) at.unit = named->unit;
  } else {
    at.retained = std::any_of(retained_.begin(), retained_.end(), [&](const Cells& cells) {
      return at.address >= cells.first && at.address < cells.first + cells.count;
    });
  }
  return at;
}

Location Variables::find(const std::string& path) const {
  const auto upper = upper_case(path);
  if (path.starts_with('%')) {
    const char* problem = "";
    const auto address = parse_register(upper.substr(1), &problem);
    if (!address) refuse(path, problem);
    return with_retention(register_location(path, *address));
  }
  const auto [best, behind] = symbol_in(symbols_, upper);
  if (best == nullptr) {
    const auto found = interface_registers().find(upper);
    for (const auto& constant : constants_)
      if (const auto name = upper_case(constant); upper == name || name.ends_with("." + upper))
        refuse(path, "it is a constant");
    if (found == interface_registers().end()) refuse(path, "there is no such variable");
    return with_retention(register_location(path, found->second));
  }
  Location at{best->path, best->type, best->address, best->bit, false, ""};
  for (auto rest = upper.substr(behind); !rest.empty();) {
    if (rest[0] == '.') {
      const auto end = std::min(rest.find_first_of(".[", 1), rest.size());
      const auto name = rest.substr(1, end - 1);
      if (at.type->kind == Kind::structure) {
        const auto* field = at.type->field(name);
        if (field == nullptr) refuse(path, "there is no field '" + name + "'");
        at = part(at, "." + field->text, field->type, at.address + field->offset);
      } else if (at.type->kind == Kind::block) {
        const auto& names = at.type->block->pou->names;
        const auto found = names.find(name);
        if (found == names.end()) refuse(path, "there is no variable '" + name + "'");
        if (!has_value(*found->second)) refuse(path, why_without_value(*found->second));
        at = member(at, *found->second);
      } else {
        refuse(path, at.type->name + " has no members");
      }
      rest = rest.substr(end);
    } else {
      const auto end = rest.find(']');
      if (rest[0] != '[' || at.type->kind != Kind::array || end == std::string::npos)
        refuse(path, "no array, or ']' is missing");
      const char* digits = rest.data() + 1;
      const char* const last = rest.data() + end;
      std::int64_t stride = at.type->cells, offset = 0;
      for (const auto& dimension : at.type->dimensions) {
        std::int64_t number = 0;
        const auto parsed = std::from_chars(digits, last, number);
        if (parsed.ec != std::errc{} || number < dimension.low || number > dimension.high)
          refuse(path, "the index is outside " + std::to_string(dimension.low) + " .. " +
                           std::to_string(dimension.high));
        stride /= dimension.high - dimension.low + 1;
        offset += (number - dimension.low) * stride;
        const bool is_last = &dimension == &at.type->dimensions.back();
        if (is_last ? parsed.ptr != last : parsed.ptr == last || *parsed.ptr != ',')
          refuse(path, at.type->name + " has " + std::to_string(at.type->dimensions.size()) + " indices");
        digits = is_last ? last : parsed.ptr + 1;
      }
      at = part(at, rest.substr(0, end + 1), at.type->element,
                at.address + static_cast<std::uint32_t>(offset));
      rest = rest.substr(end + 1);
    }
  }
  return with_retention(at);
}

Location Variables::find_elementary(const std::string& path) const {
  auto at = find(path);
  if (is_compound(*at.type)) refuse(path, "it is " + at.type->name + "; name one of its elements");
  return at;
}

void Variables::expand(const Location& at, std::vector<Location>& elements) const {
  const auto& type = *at.type;
  if (type.kind == Kind::structure) {
    for (const auto& field : type.fields)
      expand(part(at, "." + field.text, field.type, at.address + field.offset), elements);
  } else if (type.kind == Kind::block) {
    for (const auto& variable : type.block->pou->variables)
      if (has_value(variable)) expand(member(at, variable), elements);
  } else if (type.kind == Kind::array) {
    std::vector<std::int64_t> index;
    for (const auto& dimension : type.dimensions) index.push_back(dimension.low);
    for (std::uint32_t i = 0; i < type.cells; i += type.element->cells) {
      std::string text;
      for (const auto number : index) text += (text.empty() ? "" : ",") + std::to_string(number);
      expand(part(at, "[" + text + "]", type.element, at.address + i), elements);
      for (auto d = index.size(); d-- > 0;) {
        if (++index[d] <= type.dimensions[d].high) break;
        index[d] = type.dimensions[d].low;
      }
    }
  } else {
    elements.push_back(with_retention(at));
  }
}

std::vector<Location> Variables::elements(const std::string& path) const {
  std::vector<Location> result;
  expand(find(path), result);
  return result;
}

std::vector<Location> Variables::all() const {
  std::vector<Location> result;
  for (const auto& symbol : symbols_)
    expand({symbol.path, symbol.type, symbol.address, symbol.bit, false, ""}, result);
  return result;
}

std::string Variables::path_at(std::uint32_t cell, int bit) const {
  if (cell < image_cells) return register_text(cell, bit);
  for (const auto& symbol : symbols_) {
    if (cell < symbol.address || cell >= symbol.address + symbol.type->cells) continue;
    std::vector<Location> elements;
    expand({symbol.path, symbol.type, symbol.address, symbol.bit, false, ""}, elements);
    for (const auto& element : elements)
      if (element.address == cell && !element.is_register()) return element.path;
  }
  return "";
}

Changeover::Changeover(const Variables& running, const Variables& next, bool only_retained) {
  std::map<std::string, Location> old;
  for (auto& at : running.all())
    if (!at.is_register()) old.emplace(upper_case(at.path), at);
  const auto told = [](const Location& at) {
    return at.path + " (" + at.type->name + (at.retained ? ", RETAIN)" : ")");
  };
  for (const auto& at : next.all()) {
    if (at.is_register()) continue;
    const auto found = old.find(upper_case(at.path));
    if (found == old.end()) {
      losses_.push_back(told(at) + " is new: it begins with its initial value");
      continue;
    }
    if (is_reference(at.type->kind)) {
      losses_.push_back(told(at) + " names a variable by its place: it begins with its initial value");
    } else if (same_values(*found->second.type, *at.type)) {
      if (!only_retained || at.retained)
        moves_.push_back({found->second.address, at.address, at.type->cells, at.path});
    } else
      losses_.push_back(told(found->second) + " becomes " + at.type->name +
                        ": it begins with its initial value");
    old.erase(found);
  }
  for (const auto& [name, at] : old)
    losses_.push_back(told(at) + " is not in the new programs: its value is lost");
  std::sort(moves_.begin(), moves_.end(), [](const Move& a, const Move& b) { return a.from < b.from; });
}

std::optional<std::uint32_t> Changeover::moved(std::uint32_t cell) const {
  if (cell < image_cells) return cell;
  for (const auto& move : moves_)
    if (cell >= move.from && cell < move.from + move.count) return move.to + (cell - move.from);
  return std::nullopt;
}

}  // namespace trunnion::st
