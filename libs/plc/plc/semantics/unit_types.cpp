// SPDX-License-Identifier: Apache-2.0
// Types and initial values.
#include <algorithm>

#include "plc/machine/strings.hpp"
#include "plc/semantics/lowering.hpp"
#include "plc/semantics/unit.hpp"

namespace trunnion::st {
namespace {

constexpr std::uint32_t default_string = 80;
constexpr std::int64_t most_elements = 1 << 19;

const char* word_of(Kind kind) { return kind == Kind::pointer ? "POINTER TO " : "REF_TO "; }

/// Through references and arrays alone, so that there is no variable behind them.
bool leads_to(const Type* from, const Type* to) {
  const auto leads = [](const Type& type) {
    return type.kind == Kind::reference || type.kind == Kind::pointer || type.kind == Kind::array;
  };
  while (from != nullptr && from != to && leads(*from)) from = from->element;
  return from == to;
}

}  // namespace

void Unit::register_types() {
  for (const auto& declaration : tree_.types) {
    if (elementary(declaration.name) != nullptr)
      diagnostics_.error(declaration.at, "'" + declaration.text + "' is a type of the standard");
    else if (!declared_.emplace(declaration.name, &declaration).second)
      diagnostics_.error(declaration.at, "the type '" + declaration.text + "' is declared twice");
  }
}

void Unit::build_types() {
  for (const auto& [name, declaration] : declared_) named_type(name);
}

const Type* Unit::named_type(const std::string& upper) {
  if (const auto* type = elementary(upper)) return type;
  if (upper == "STRING" || upper == "WSTRING") return string_type(default_string, upper == "WSTRING");
  if (const auto found = named_.find(upper); found != named_.end()) return found->second;
  const auto declared = declared_.find(upper);
  if (declared == declared_.end()) return nullptr;
  const auto& declaration = *declared->second;
  if (!in_progress_.insert(upper).second) {
    diagnostics_.error(declaration.at, "the type '" + declaration.text + "' contains itself");
    return named_[upper] = elementary(Kind::error);
  }
  const auto* type = build(*declaration.type, declaration.text, nullptr);
  if (const auto again = named_.find(upper); again != named_.end()) return named(upper, again->second);
  if (declaration.initial != nullptr && type->kind != Kind::error) {
    named_[upper] = type;  // TYPE Colour : (red, green) := Colour#green
    auto& own = types_.emplace_back(*type);
    own.initial = initial_cells(declaration.initial.get(), *type, nullptr);
    type = &own;
  }
  in_progress_.erase(upper);
  return named(upper, type);
}

/// The type has its name, and references in it have their type.
const Type* Unit::named(const std::string& upper, const Type* type) {
  for (auto& [reference, name] : open_references_) {
    if (name != upper) continue;
    reference->element = leads_to(type, reference) ? elementary(Kind::error) : type;
    if (reference->element != type)
      diagnostics_.error(declared_.at(upper)->at,
                         "the type '" + declared_.at(upper)->text + "' contains itself");
  }
  return named_[upper] = type;
}

/// A structure or function block may contain a reference to its own type, as the elements of a list do.
const Type* Unit::reference(const TypeSpec& element, Kind kind, Pou* context) {
  const bool is_named = element.kind == TypeSpec::Kind::named && !element.low;
  if (auto* pou = is_named ? find_pou(element.name) : nullptr;
      pou != nullptr && pou->declaration->kind == PouKind::function_block &&
      pou->state == Pou::State::in_progress)
    return reference_type(pou->type, kind);
  if (is_named && in_progress_.contains(element.name) && !named_.contains(element.name)) {
    auto& type = types_.emplace_back();
    type.kind = kind;
    type.name = word_of(kind) + element.text;
    type.initial = {null_reference};
    open_references_.emplace_back(&type, element.name);
    return &type;
  }
  const auto* type = build(element, "", context);
  return type->kind == Kind::error ? type : reference_type(*type, kind);
}

const Type* Unit::string_type(std::uint32_t length, bool wide) {
  auto& known = strings_[{length, wide}];
  if (known == nullptr) {
    auto& type = types_.emplace_back();
    type.kind = Kind::string;
    type.name = (wide ? "WSTRING[" : "STRING[") + std::to_string(length) + "]";
    type.length = length;
    type.wide = wide;
    type.cells = string_cells(wide ? 3 * length : length);
    type.initial.assign(type.cells, 0);
    known = &type;
  }
  return known;
}

const Type* Unit::reference_type(const Type& element, Kind kind) {
  auto& known = references_to_[{&element, kind}];
  if (known == nullptr) {
    auto& type = types_.emplace_back();
    type.kind = kind;
    type.name = word_of(kind) + element.name;
    type.element = &element;
    type.initial = {null_reference};
    known = &type;
  }
  return known;
}

std::int32_t Unit::pointed(const Type& type) {
  const auto& element = innermost(type);
  const auto known = std::find_if(pointed_types_.begin(), pointed_types_.end(),
                                  [&](const Type* other) { return same_limited_type(*other, element); });
  Pointed entry;
  entry.element = static_cast<std::uint32_t>(known - pointed_types_.begin());
  if (known == pointed_types_.end()) pointed_types_.push_back(&element);
  entry.cells = std::max<std::uint32_t>(element.cells, 1);
  // A program without variables has no cells.
  entry.count = std::max<std::uint32_t>(type.cells / entry.cells, 1);
  entry.bytes = std::max<std::uint32_t>(static_cast<std::uint32_t>(bytes_of(element)), 1);
  const bool is_number = has_bytes(element) && element.kind != Kind::string;
  if (has_bytes(element)) entry.view = is_number ? Pointed::View::number : Pointed::View::string;
  if (is_number) entry.form = cell_form(element.kind);
  const auto found = std::find(code.pointed.begin(), code.pointed.end(), entry);
  if (found != code.pointed.end()) return static_cast<std::int32_t>(found - code.pointed.begin());
  if (code.pointed.size() == most_pointed) {
    if (diagnostics_.errors() == 0)
      diagnostics_.error({library_files_, 1, 1}, "pointers reach variables of more than " +
                                                     std::to_string(most_pointed) + " types and sizes");
    return 0;
  }
  code.pointed.push_back(entry);
  return static_cast<std::int32_t>(code.pointed.size() - 1);
}

const Type* Unit::type_of(const TypeSpec& spec, Pou* context) { return build(spec, "", context); }

const Type* Unit::build(const TypeSpec& spec, const std::string& name, Pou* context) {
  switch (spec.kind) {
    case TypeSpec::Kind::enumeration:
      return enumeration(spec, name.empty() ? "enumeration" : name);
    case TypeSpec::Kind::structure:
      return structure(spec, name.empty() ? "structure" : name, context);
    case TypeSpec::Kind::array:
      return array(spec, context);
    case TypeSpec::Kind::reference:
      return reference(*spec.element, Kind::reference, context);
    case TypeSpec::Kind::pointer:
      return reference(*spec.element, Kind::pointer, context);
    case TypeSpec::Kind::string: {
      const bool wide = spec.name == "WSTRING";
      const auto longest = wide ? longest_wide_string : longest_string;
      if (!spec.length) return string_type(default_string, wide);
      Value length;
      if (!constant(*spec.length, *elementary(Kind::dint), context, length)) return elementary(Kind::error);
      if (length.integer < 1 || length.integer > longest) {
        diagnostics_.error(spec.at, std::string("the length of a ") + (wide ? "WSTRING" : "string") +
                                        " is 1 .. " + std::to_string(longest) + ", not " +
                                        std::to_string(length.integer));
        return elementary(Kind::error);
      }
      return string_type(static_cast<std::uint32_t>(length.integer), wide);
    }
    case TypeSpec::Kind::named:
      break;
  }
  const auto* type = named_type(spec.name);
  if (type == nullptr)
    if (auto* pou = find_pou(spec.name); pou != nullptr) {
      if (pou->declaration->kind != PouKind::function_block) {
        diagnostics_.error(spec.at, "'" + spec.text + "' is no type and no function block");
        return elementary(Kind::error);
      }
      if (pou->declaration->is_abstract) {
        diagnostics_.error(
            spec.at,
            "'" + spec.text + "' is ABSTRACT and has no instances; declare one of a block that extends it");
        return elementary(Kind::error);
      }
      return translated(spec.name, spec.at) == nullptr ? elementary(Kind::error) : &pou->type;
    }
  if (const auto* interface = find_interface(spec.name); type == nullptr && interface != nullptr)
    return &interface->type;
  if (type == nullptr) {
    diagnostics_.error(spec.at, "there is no type '" + spec.text + "'");
    return elementary(Kind::error);
  }
  return spec.low ? subrange(spec, type, context) : type;
}

const Type* Unit::subrange(const TypeSpec& spec, const Type* base, Pou* context) {
  Value low, high;
  if (!is_integer(base->kind)) {
    diagnostics_.error(spec.at, "a subrange is of an integer type, not of " + base->name);
    return elementary(Kind::error);
  }
  if (!constant(*spec.low, *base, context, low) || !constant(*spec.high, *base, context, high))
    return elementary(Kind::error);
  if (low.integer > high.integer) {
    diagnostics_.error(spec.at, "the lower limit " + std::to_string(low.integer) +
                                    " is above the upper limit " + std::to_string(high.integer));
    return elementary(Kind::error);
  }
  auto& type = types_.emplace_back(*base);
  type.ranged = true;
  type.low = low.integer;
  type.high = high.integer;
  type.name = base->name + " (" + std::to_string(type.low) + ".." + std::to_string(type.high) + ")";
  // Without initial value a variable has the value nearest to zero that the subrange has.
  type.initial = {static_cast<std::uint64_t>(std::clamp<std::int64_t>(0, type.low, type.high))};
  return &type;
}

const Type* Unit::enumeration(const TypeSpec& spec, const std::string& name) {
  const auto* base = spec.name.empty() ? elementary(Kind::dint) : named_type(spec.name);
  const bool whole = base != nullptr && (is_integer(base->kind) || is_bits(base->kind));
  if (!whole || base->kind == Kind::boolean || bits(base->kind) > 32) {
    diagnostics_.error(spec.at, "named values are of an integer or bit string of at most 32 bits, not of '" +
                                    spec.text + "'");
    base = elementary(Kind::dint);
  }
  auto& type = types_.emplace_back();
  type.kind = Kind::enumeration;
  type.name = name;
  type.space = spec.space;
  std::int64_t next = 0;
  for (const auto& enumerator : spec.enumerators) {
    if (type.enumerator(enumerator.name) != nullptr) {
      diagnostics_.error(enumerator.at, "the enumerated value '" + enumerator.text + "' is declared twice");
      continue;
    }
    Value value;
    if (!enumerator.value && !fits(*base, next))
      diagnostics_.error(enumerator.at, std::to_string(next) + " of '" + enumerator.text + "' is outside " +
                                            limits_text(*base) + " of " + base->name);
    if (enumerator.value && constant(*enumerator.value, *base, nullptr, value)) next = value.integer;
    type.enumerators.push_back({enumerator.name, enumerator.text, next});
    ++next;
  }
  type.initial = {type.enumerators.empty() ? 0 : static_cast<std::uint64_t>(type.enumerators[0].value)};
  const auto prefix = spec.space.empty() ? std::string() : spec.space + ".";
  for (const auto& enumerator : type.enumerators)
    enumerators_[prefix + enumerator.name].push_back({&type, &enumerator});
  return &type;
}

const Enumerator* Unit::find_enumerator(const std::string& upper, const Type** type) {
  const auto found = enumerators_.find(upper);
  if (found == enumerators_.end() || found->second.size() != 1) return nullptr;
  *type = found->second[0].first;
  return found->second[0].second;
}

const Type* Unit::array(const TypeSpec& spec, Pou* context) {
  const bool is_in_out = &spec == in_out_spec_;
  const auto* element = build(*spec.element, "", context);
  const auto is_open = [](const TypeSpec::Dimension& dimension) { return dimension.low == nullptr; };
  if (std::any_of(spec.dimensions.begin(), spec.dimensions.end(), is_open)) {
    if (is_in_out && std::all_of(spec.dimensions.begin(), spec.dimensions.end(), is_open))
      return open_array(spec, element);
    diagnostics_.error(spec.at, "ARRAY[*] is for VAR_IN_OUT, where the caller's array gives every limit");
    return elementary(Kind::error);
  }
  Type type;
  type.kind = Kind::array;
  type.element = element;
  type.name = "ARRAY[";
  std::int64_t elements = 1;
  bool good = element->kind != Kind::error;
  for (const auto& dimension : spec.dimensions) {
    Value low, high;
    if (!constant(*dimension.low, *elementary(Kind::dint), context, low) ||
        !constant(*dimension.high, *elementary(Kind::dint), context, high)) {
      good = false;
      continue;
    }
    if (low.integer > high.integer) {
      diagnostics_.error(dimension.low->at, "the lower limit " + std::to_string(low.integer) +
                                                " is above the upper limit " + std::to_string(high.integer));
      good = false;
      continue;
    }
    if (!type.dimensions.empty()) type.name += ",";
    type.name += std::to_string(low.integer) + ".." + std::to_string(high.integer);
    type.dimensions.push_back({low.integer, high.integer});
    elements = std::min(elements * (high.integer - low.integer + 1), most_elements + 1);
  }
  if (!good) return elementary(Kind::error);
  if (elements * element->cells > most_elements) {
    diagnostics_.error(spec.at, "the array has more than " + std::to_string(most_elements) + " cells");
    return elementary(Kind::error);
  }
  type.name += "] OF " + element->name;
  type.cells = static_cast<std::uint32_t>(elements * element->cells);
  type.initial.reserve(type.cells);
  for (std::int64_t i = 0; i < elements; ++i)
    type.initial.insert(type.initial.end(), element->initial.begin(), element->initial.end());
  return &types_.emplace_back(std::move(type));
}

const Type* Unit::open_array(const TypeSpec& spec, const Type* element) {
  if (element->kind == Kind::error) return element;
  auto& type = types_.emplace_back();
  type.kind = Kind::array;
  type.open = true;
  type.element = element;
  type.dimensions.resize(spec.dimensions.size());
  type.name = "ARRAY[";
  for (std::size_t i = 0; i < spec.dimensions.size(); ++i) type.name += i == 0 ? "*" : ",*";
  type.name += "] OF " + element->name;
  type.cells = element->cells;
  type.initial = element->initial;
  return &type;
}

const Type* Unit::structure(const TypeSpec& spec, const std::string& name, Pou* context) {
  Type type;
  type.kind = Kind::structure;
  type.name = name;
  type.cells = 0;
  bool good = true;
  for (const auto& field : spec.fields) {
    if (type.field(field.name) != nullptr) {
      diagnostics_.error(field.at, "the field '" + field.text + "' is declared twice");
      continue;
    }
    const auto* field_type = build(*field.type, "", context);
    if (field_type->kind == Kind::error) {
      good = false;
      continue;
    }
    if (field_type->kind == Kind::block)
      diagnostics_.error(field.at, "a structure cannot contain the function block '" + field.text + "'");
    type.fields.push_back({field.name, field.text, field_type, type.cells});
    const auto cells = initial_cells(field.initial, *field_type, context);
    type.initial.insert(type.initial.end(), cells.begin(), cells.end());
    type.cells += field_type->cells;
  }
  if (good && type.fields.empty()) {
    diagnostics_.error(spec.at, "a structure has at least one field");
    good = false;
  }
  return good ? &types_.emplace_back(std::move(type)) : elementary(Kind::error);
}

bool Unit::constant(const Expression& expression, const Type& type, Pou* context, Value& value) {
  Lowering lowering(*this, context, 0);
  value = lowering.expression(expression, &type);
  if (value.is_error() || type.kind == Kind::error) return false;
  if (!value.is_constant) {
    diagnostics_.error(expression.at,
                       "a constant is required here: a literal, a VAR CONSTANT or their combination");
    return false;
  }
  value = lowering.converted(value, type, expression.at);
  return !value.is_error();
}

std::vector<std::uint64_t> Unit::initial_cells(const Expression* initial, const Type& type, Pou* context) {
  if (initial == nullptr || type.kind == Kind::error) return type.initial;
  std::vector<std::uint64_t> cells;
  if (type.kind == Kind::array) {
    if (initial->kind == Expression::Kind::list) {
      list_cells(*initial, type, context, cells);
      return cells;
    }
  } else if (type.kind == Kind::structure || type.kind == Kind::block) {
    if (initial->kind == Expression::Kind::structure) {
      structure_cells(*initial, type, context, cells);
      return cells;
    }
  } else {
    Value value;
    if (initial->kind == Expression::Kind::list || initial->kind == Expression::Kind::structure) {
      diagnostics_.error(initial->at, type.name + " has one initial value, not a list");
    } else if (constant(*initial, type, context, value)) {
      if (type.kind != Kind::string) return {constant_cell(value, type)};
      cells.assign(type.cells, 0);
      const auto text =
          value.text.substr(0, type.wide ? bytes_of_characters(value.text, type.length) : type.length);
      cells[0] = text.size();
      std::copy(text.begin(), text.end(), reinterpret_cast<char*>(cells.data() + 1));
      return cells;
    }
    return type.initial;
  }
  diagnostics_.error(initial->at, type.kind == Kind::array
                                      ? "an array has its initial values in brackets: [1, 2, 5(0)]"
                                      : "a structure has its initial values in parentheses: (a := 1)");
  return type.initial;
}

void Unit::list_cells(const Expression& list, const Type& type, Pou* context,
                      std::vector<std::uint64_t>& cells) {
  for (std::size_t i = 0; i < list.parts.size(); ++i) {
    std::int64_t count = 1;
    if (list.repeat[i]) {
      Value value;
      if (!constant(*list.repeat[i], *elementary(Kind::dint), context, value)) break;
      count = value.integer;
    }
    const auto one =
        list.parts[i] ? initial_cells(list.parts[i].get(), *type.element, context) : type.element->initial;
    if (count < 0 ||
        static_cast<std::int64_t>(cells.size() / std::max<std::uint32_t>(type.element->cells, 1)) + count >
            static_cast<std::int64_t>(type.cells / std::max<std::uint32_t>(type.element->cells, 1))) {
      diagnostics_.error(list.at, "more initial values than the " +
                                      std::to_string(type.cells / type.element->cells) +
                                      " elements of the array");
      break;
    }
    for (; count > 0; --count) cells.insert(cells.end(), one.begin(), one.end());
  }
  cells.insert(
      cells.end(),
      type.initial.begin() + static_cast<std::ptrdiff_t>(std::min(cells.size(), type.initial.size())),
      type.initial.end());
}

void Unit::structure_cells(const Expression& list, const Type& type, Pou* context,
                           std::vector<std::uint64_t>& cells) {
  cells = type.initial;
  for (const auto& argument : list.arguments) {
    const Type* field_type = nullptr;
    std::uint32_t offset = 0;
    if (type.kind == Kind::structure) {
      if (const auto* field = type.field(argument.name)) field_type = field->type, offset = field->offset;
    } else if (const auto found = type.block->pou->names.find(argument.name);
               found != type.block->pou->names.end()) {
      const auto& variable = *found->second;
      if (variable.place.base == Place::Base::frame && variable.section != VariableSection::in_out)
        field_type = variable.type, offset = static_cast<std::uint32_t>(variable.place.offset);
    }
    if (field_type == nullptr) {
      diagnostics_.error(argument.at, type.name + " has no field '" + argument.name + "'");
      continue;
    }
    const auto field = initial_cells(argument.value.get(), *field_type, context);
    std::copy(field.begin(), field.end(), cells.begin() + offset);
  }
}

}  // namespace trunnion::st
