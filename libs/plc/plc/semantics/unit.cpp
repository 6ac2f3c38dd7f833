// SPDX-License-Identifier: Apache-2.0
#include "plc/semantics/unit.hpp"

#include <algorithm>

#include "plc/library/functions.hpp"
#include "plc/library/register_names.hpp"
#include "plc/semantics/lowering.hpp"

namespace trunnion::st {
namespace {

bool keeps_nothing(const Pou& pou) {
  return pou.declaration->kind == PouKind::function || pou.declaration->kind == PouKind::method;
}

const char* kind_text(const Pou& pou) { return pou.is_method() ? "a method" : "a function"; }

}  // namespace

std::string title_of(const Pou& pou) {
  const auto of = pou.interface != nullptr  ? pou.interface->declaration->text + "."
                  : pou.instance != nullptr ? pou.instance->declaration->text + "."
                                            : std::string();
  return of + pou.declaration->text;
}

Unit::Unit(const SourceTree& tree, Diagnostics& diagnostics, const RegisterNames& registers,
           std::uint16_t library_files)
    : tree_(tree), diagnostics_(diagnostics), registers_(registers), library_files_(library_files) {
  code.initial.assign(image_cells + 1, 0);
}

void Unit::run() {
  register_types();
  declare_pous();
  declare_interfaces();
  // Types are built when they are needed; they may use constants, so those come first.
  for (const bool constants : {true, false})
    for (const auto& block : tree_.globals)
      if (block.constant == constants) declare_globals(block);
  build_types();
  declare_prototypes();
  declare_instances();
  for (const auto& declaration : tree_.pous)
    if (const auto found = pous.find(declaration.name);
        found != pous.end() && found->second.declaration == &declaration && !is_library(declaration.at))
      translated(declaration.name, declaration.at);
  translate_methods();
  add_tasks();
  finish();
}

void Unit::declare_pous() {
  for (const auto& declaration : tree_.pous) {
    auto& pou = pous[declaration.name];
    const bool replaces = declaration.kind == PouKind::function && !is_library(declaration.at) &&
                          is_replaceable_function(declaration.name) &&
                          (pou.declaration == nullptr || is_library(pou.declaration->at));
    if (replaces) {
      diagnostics_.warning(declaration.at,
                           "'" + declaration.text + "' takes the place of the standard function");
    } else if (pou.declaration != nullptr) {
      const auto& other = *pou.declaration;
      diagnostics_.error(declaration.at,
                         "'" + declaration.text + "' is declared already" +
                             (is_library(other.at) ? std::string(" in the standard library")
                                                   : " in line " + std::to_string(other.at.line)));
      continue;
    }
    if (declared_.contains(declaration.name) || elementary(declaration.name) != nullptr)
      diagnostics_.error(declaration.at, "'" + declaration.text + "' is a type already");
    if (!replaces && is_standard_function(declaration.name))
      diagnostics_.error(declaration.at, "'" + declaration.text + "' is a standard function");
    pou.declaration = &declaration;
    pou.type.kind = Kind::block;
    pou.type.name = declaration.text;
  }
}

Pou* Unit::find_pou(const std::string& upper) {
  const auto found = pous.find(upper);
  return found == pous.end() ? nullptr : &found->second;
}

Pou* Unit::translated(const std::string& upper, Position at) {
  auto* pou = find_pou(upper);
  return pou != nullptr && complete(*pou, at) ? pou : nullptr;
}

bool Unit::complete(Pou& pou, Position at) {
  if (pou.state == Pou::State::in_progress) {
    diagnostics_.error(at, "'" + title_of(pou) +
                               "' calls or contains itself; recursion is not permitted (IEC 61131-3, 6.6.1)");
    return false;
  }
  if (pou.state == Pou::State::declared) {
    pou.state = Pou::State::in_progress;
    pou.called_at = at;
    if (pou.interface != nullptr)
      translate_dispatcher(pou);
    else
      translate(pou);
    pou.state = Pou::State::done;
  }
  return true;
}

void Unit::declare_globals(const VariableBlock& block) {
  for (const auto& declaration : block.variables) {
    if (global_names_.contains(declaration.name)) {
      diagnostics_.error(declaration.at, "the global variable '" + declaration.text + "' is declared twice");
      continue;
    }
    auto& variable = globals.emplace_back();
    variable.name = declaration.name;
    variable.text = declaration.text;
    variable.at = declaration.at;
    variable.section = VariableSection::global;
    variable.retain = block.retain;
    variable.is_constant = block.constant;
    variable.used = true;
    variable.type = type_of(*declaration.type, nullptr);
    global_names_[variable.name] = &variable;
    if (variable.type->kind == Kind::error) continue;
    if (block.retain) refuse_retention(*variable.type, variable.text, variable.at);
    variable.initial = initial_cells(declaration.initial, *variable.type, nullptr);
    if (block.constant && is_elementary(variable.type->kind) && declaration.initial != nullptr)
      constant(*declaration.initial, *variable.type, nullptr, variable.constant);
    if (!declaration.location.empty()) {
      locate(variable, declaration);
      continue;
    }
    const auto address = allocate(variable.initial);
    variable.place = {Place::Base::absolute, static_cast<std::int32_t>(address), 0, -1, 0, 0, !block.constant,
                      "is a constant"};
    if (block.retain) code.retained.push_back({address, variable.type->cells});
    each_block(*variable.type, address, [&](const Pou& pou, std::uint32_t at) {
      for (const auto timer : pou.timers) code.timers.push_back(at + timer);
      if (!block.retain)
        for (const auto& cells : pou.retained) code.retained.push_back({at + cells.first, cells.count});
    });
  }
}

Variable* Unit::find_global(const std::string& upper) {
  const auto found = global_names_.find(upper);
  return found == global_names_.end() ? nullptr : found->second;
}

void Unit::each_block(const Type& type, std::uint32_t offset,
                      const std::function<void(const Pou&, std::uint32_t)>& visit) {
  if (type.kind == Kind::block) {
    visit(*type.block->pou, offset);
  } else if (type.kind == Kind::array && type.element->cells > 0) {
    for (std::uint32_t at = 0; at < type.cells; at += type.element->cells) {
      if (is_elementary(type.element->kind)) return;
      each_block(*type.element, offset + at, visit);
    }
  } else if (type.kind == Kind::structure) {
    for (const auto& field : type.fields) each_block(*field.type, offset + field.offset, visit);
  }
}

void Unit::declare_variable(Pou& pou, const Pou& declared_in, const VariableBlock& block,
                            const VariableDeclaration& declaration) {
  if (const auto twice = pou.names.find(declaration.name); twice != pou.names.end()) {
    diagnostics_.error(declaration.at, "the variable '" + declaration.text +
                                           "' is declared already in line " +
                                           std::to_string(twice->second->at.line));
    return;
  }
  const bool is_function = keeps_nothing(pou);
  auto& variable = pou.variables.emplace_back();
  variable.name = declaration.name;
  variable.text = declaration.text;
  variable.at = declaration.at;
  variable.section = block.section;
  variable.retain = block.retain;
  variable.is_constant = block.constant;
  variable.access = block.access;
  variable.is_internal = block.is_internal;
  if (pou.declaration->kind == PouKind::function_block) variable.declared_in = &declared_in;
  in_out_spec_ = block.section == VariableSection::in_out ? declaration.type : nullptr;
  variable.type = type_of(*declaration.type, &pou);
  in_out_spec_ = nullptr;
  pou.names[variable.name] = &variable;
  if (variable.type->kind == Kind::error) {
    variable.used = true;
    return;
  }
  const auto& type = *variable.type;
  if (block.retain) refuse_retention(type, variable.text, variable.at);
  if (block.section == VariableSection::external) {
    auto* global = find_global(declaration.global.empty() ? declaration.name : declaration.global);
    variable.external = global;
    if (global == nullptr) {
      diagnostics_.error(declaration.at, "there is no global variable '" + declaration.text + "'");
      variable.type = elementary(Kind::error);
    } else if (!same_type(*global->type, type)) {
      diagnostics_.error(declaration.at, "the global variable '" + declaration.text + "' has the type " +
                                             global->type->name + ", not " + type.name);
      variable.type = elementary(Kind::error);
    } else {
      variable.place = global->place;
      variable.constant = global->constant;
      variable.is_constant = global->is_constant;
    }
    return;
  }
  if (is_function && block.retain)
    diagnostics_.error(block.at, std::string(kind_text(pou)) + " keeps nothing: RETAIN is not permitted");
  bool contains_block = type.kind == Kind::block;
  each_block(type, 0, [&](const Pou&, std::uint32_t) { contains_block = true; });
  if (contains_block && is_function && block.section != VariableSection::in_out)
    diagnostics_.error(declaration.at, std::string(kind_text(pou)) +
                                           " keeps nothing, so it cannot contain the function block '" +
                                           declaration.text + "'; pass it as VAR_IN_OUT");
  if (contains_block &&
      (block.section == VariableSection::temporary || block.section == VariableSection::input))
    diagnostics_.error(declaration.at,
                       "the function block '" + declaration.text +
                           "' cannot be temporary or an input; declare it in VAR or VAR_IN_OUT");
  if (block.section == VariableSection::in_out && declaration.initial != nullptr)
    diagnostics_.error(declaration.at, "VAR_IN_OUT '" + declaration.text +
                                           "' is the caller's variable and has no initial value");
  variable.initial = block.section == VariableSection::in_out
                         ? std::vector<std::uint64_t>(type.open ? 1 + 2 * type.dimensions.size() : 1, 0)
                         : initial_cells(declaration.initial, type, &pou);
  if (block.constant) {
    if (declaration.initial == nullptr)
      diagnostics_.error(declaration.at,
                         "the constant '" + declaration.text + "' has no value: write := value");
    else if (is_elementary(type.kind))
      constant(*declaration.initial, type, &pou, variable.constant);
  }
  if (!declaration.location.empty()) {
    if (block.section != VariableSection::local || is_function)
      diagnostics_.error(declaration.location_at,
                         "AT is for VAR of programs and function blocks and for VAR_GLOBAL");
    locate(variable, declaration);
    return;
  }
  const auto offset = static_cast<std::uint32_t>(pou.initial.size());
  variable.place = {Place::Base::frame, static_cast<std::int32_t>(offset), 0, -1, 0, 0, true, ""};
  const bool writes_inputs = is_codesys(declaration.at);
  if (block.section == VariableSection::input && pou.declaration->kind == PouKind::function_block &&
      !writes_inputs) {
    variable.place.writable = false;
    variable.place.refusal = "is an input of the function block";
  }
  if (block.constant) variable.place.writable = false, variable.place.refusal = "is a constant";
  pou.initial.insert(pou.initial.end(), variable.initial.begin(), variable.initial.end());
  if (block.section == VariableSection::in_out) return;
  if (block.retain) pou.retained.push_back({offset, type.cells});
  if (is_library(declaration.at) && declaration.name == "TIMER_END") pou.timers.push_back(offset);
  each_block(type, offset, [&](const Pou& inner, std::uint32_t at) {
    for (const auto timer : inner.timers) pou.timers.push_back(at + timer);
    if (!block.retain)
      for (const auto& cells : inner.retained) pou.retained.push_back({at + cells.first, cells.count});
  });
}

bool Unit::locate(Variable& variable, const VariableDeclaration& declaration) {
  const char* problem = "";
  const auto address = parse_register(declaration.location, &problem);
  variable.place = {Place::Base::none, 0, 0, -1, 0, 0, true, ""};
  if (!address) {
    diagnostics_.error(declaration.location_at, "'%" + declaration.location + "': " + problem);
    variable.type = elementary(Kind::error);
    return false;
  }
  if (declaration.initial != nullptr)
    diagnostics_.error(declaration.at,
                       "'" + declaration.text + "' is a register of the machine and has no initial value");
  warn_moved(*address, declaration.location_at);
  const auto value = register_value(*address, variable.type, declaration.location_at);
  if (value.is_error()) variable.type = value.type;
  variable.place = value.place;
  if (variable.retain && !value.is_error()) retain(*address, variable.type->cells, declaration.location_at);
  return true;
}

void Unit::retain(const RegisterAddress& first, std::uint32_t count, Position at) {
  const auto& area = info(first.area);
  if (first.area <= Area::g)
    diagnostics_.error(at, "RETAIN is not for this area: keep the value in R, W, D, B or in a variable");
  else if (!area.retained)
    for (std::uint32_t i = 0; i < count; ++i)
      code.retained_registers.push_back({first.area, static_cast<std::uint16_t>(first.index + i), first.bit});
}

void Unit::declare_variables(Pou& pou) {
  if (pou.declaration->result) {
    auto& result = pou.variables.emplace_back();
    result.name = pou.declaration->name;
    result.text = pou.declaration->text.substr(pou.declaration->text.rfind('.') + 1);
    result.at = pou.declaration->at;
    result.section = VariableSection::output;
    result.type = type_of(*pou.declaration->result, &pou);
    result.used = true;
    result.initial = result.type->initial;
    result.place = {Place::Base::frame, 0, 0, -1, 0, 0, true, ""};
    pou.initial = result.initial;
    pou.names[result.name] = &result;
    pou.result = &result;
  } else if (pou.declaration->kind == PouKind::function) {
    pou.initial.push_back(0);
  }
  if (pou.is_method()) {
    pou.self = static_cast<std::uint32_t>(pou.initial.size());
    pou.initial.push_back(0);
    if (pou.declaration->kind == PouKind::function_block) return;  // SUPER() has none of its own
  }
  // Those of an extended block come first, in its own order.
  std::vector<const Pou*> lineage;
  for (const Pou* block = &pou; block != nullptr; block = block->parent)
    lineage.insert(lineage.begin(), block);
  for (const auto* block : lineage) declare_blocks(pou, *block);
}

void Unit::declare_blocks(Pou& pou, const Pou& declared_in) {
  // An export may use a constant before it declares it.
  const bool sorts = is_codesys(declared_in.declaration->at);
  for (const bool first : {true, false})
    for (const auto& block : declared_in.declaration->blocks)
      if (first == (block.constant || !sorts))
        for (const auto& declaration : block.variables)
          declare_variable(pou, declared_in, block, declaration);
}

void Unit::translate(Pou& pou) {
  blocks_.push_back({&pou});
  pou.type.block = &blocks_.back();
  find_parent(pou);
  declare_variables(pou);
  check_methods(pou);
  // Every instance has an address of its own, which values of interfaces are.
  if (pou.declaration->kind == PouKind::function_block && pou.initial.empty()) pou.initial.push_back(0);
  pou.is_declared = true;
  pou.frame = static_cast<std::uint32_t>(pou.initial.size());
  Lowering lowering(*this, &pou, pou.frame);
  const bool is_function = keeps_nothing(pou);
  for (const auto& variable : pou.variables)
    if (variable.section == VariableSection::temporary ||
        (is_function &&
         (variable.section == VariableSection::local || variable.section == VariableSection::output)))
      lowering.initialize(variable);
  if (pou.is_method() && pou.declaration->kind == PouKind::function_block)
    for (const auto& variable : pou.instance->variables)
      if (variable.section == VariableSection::temporary && variable.declared_in == pou.declared_in)
        lowering.initialize(variable);
  lowering.body(pou.declaration->body);
  pou.frame = lowering.emitter().frame();
  check_frame(pou);
  if (!pou.is_method()) pou.initial.resize(pou.frame, 0);
  pou.routine = add_routine(lowering.emitter(), pou.frame);
  pou.type.cells = pou.frame;
  pou.type.initial = pou.initial;
  order.push_back(&pou);
  // A variable of a function block may be used by a method, which is translated later.
  if (!is_library(pou.declaration->at) && pou.declaration->kind != PouKind::function_block) warn_unused(pou);
  if (pou.declaration->kind == PouKind::function_block || pou.is_method() || is_configured(pou)) return;
  pou.base = allocate(pou.initial);
  if (is_function) return;
  for (const auto& variable : pou.variables)
    if (variable.section == VariableSection::in_out)
      diagnostics_.error(variable.at, "nothing gives VAR_IN_OUT '" + variable.text +
                                          "' a variable; connect it in a CONFIGURATION, or use VAR_EXTERNAL");
  const bool is_test = pou.declaration->kind == PouKind::test;
  if (is_test) {
    for (const auto timer : pou.timers) code.timers.push_back(pou.base + timer);
    for (const auto& cells : pou.retained) code.retained.push_back({pou.base + cells.first, cells.count});
  } else {
    Variable variable;
    variable.name = pou.declaration->name, variable.text = pou.declaration->text;
    add_instance(pou, std::move(variable), pou.base, false);
  }
  code.entries.push_back(
      {is_test ? pou.declaration->text : pou.declaration->name, pou.routine, pou.base, is_test});
}

void Unit::warn_unused(const Pou& pou) {
  for (const auto& variable : pou.variables)
    if (!variable.used && (variable.declared_in == nullptr || variable.declared_in == &pou) &&
        (variable.section == VariableSection::local || variable.section == VariableSection::temporary ||
         variable.section == VariableSection::external))
      diagnostics_.warning(variable.at, "the variable '" + variable.text + "' is not used");
}

std::uint32_t Unit::add_routine(Emitter& emitter, std::uint32_t frame) {
  auto& body = emitter.code();
  const auto entry = static_cast<std::uint32_t>(code.code.size());
  for (const auto& [loop, about] : emitter.loops()) loops[entry + static_cast<std::uint32_t>(loop)] = about;
  for (auto& in : body)
    if (in.op == Op::jump || in.op == Op::jump_if || in.op == Op::jump_if_not || in.op == Op::loop)
      in.a += static_cast<std::int32_t>(entry);
  code.code.insert(code.code.end(), body.begin(), body.end());
  for (const auto& line : emitter.lines()) code.lines.push_back({entry + line.instruction, line.at});
  code.routines.push_back({entry, static_cast<std::uint32_t>(code.code.size()), frame});
  return static_cast<std::uint32_t>(code.routines.size() - 1);
}

void Unit::check_frame(const Pou& pou) {
  if (pou.frame > most_cells)
    diagnostics_.error(pou.declaration->at, "the variables of '" + title_of(pou) + "' need more than " +
                                                std::to_string(most_cells) + " cells");
}

std::uint32_t Unit::allocate(const std::vector<std::uint64_t>& initial) {
  const auto address = static_cast<std::uint32_t>(code.initial.size());
  if (code.initial.size() + initial.size() > most_cells) {
    if (diagnostics_.errors() == 0)
      diagnostics_.error({library_files_, 1, 1},
                         "the variables need more than " + std::to_string(most_cells) + " cells");
    return 0;
  }
  code.initial.insert(code.initial.end(), initial.begin(), initial.end());
  return address;
}

std::uint32_t Unit::string_constant(const std::string& text) {
  const auto found = string_constants_.find(text);
  if (found != string_constants_.end()) return found->second;
  std::vector<std::uint64_t> cells(string_cells(static_cast<std::uint32_t>(text.size())), 0);
  cells[0] = text.size();
  std::copy(text.begin(), text.end(), reinterpret_cast<char*>(cells.data() + 1));
  return string_constants_[text] = allocate(cells);
}

std::int32_t Unit::range_entry(Range range) {
  const auto found = std::find(code.ranges.begin(), code.ranges.end(), range);
  if (found != code.ranges.end()) return static_cast<std::int32_t>(found - code.ranges.begin());
  code.ranges.push_back(range);
  return static_cast<std::int32_t>(code.ranges.size() - 1);
}

void Unit::warn_moved(const RegisterAddress& address, Position at) {
  if (!moved_.emplace(address_of(address.area, address.index), address.bit).second) return;
  if (const auto text = moved_register(address); !text.empty()) diagnostics_.warning(at, text);
}

void Unit::use_register(std::uint32_t address, std::uint32_t count, bool written) {
  for (auto i = address; i < address + count && i < image_cells; ++i)
    used_registers_[i] = used_registers_[i] || written;
}

Value Unit::register_value(const RegisterAddress& address, const Type* type, Position at) {
  const auto& area = info(address.area);
  Value value;
  const auto refuse = [&](const std::string& text) {
    diagnostics_.error(at, text);
    value.type = elementary(Kind::error);
    return value;
  };
  const auto natural = area.bits == 8 ? Kind::usint : area.bits == 16 ? Kind::uint_ : Kind::dint;
  const bool is_bit = address.bit >= 0;
  if (type == nullptr) type = elementary(is_bit ? Kind::boolean : natural);
  value.type = type;
  const auto* element = type->kind == Kind::array ? type->element : type;
  const auto name = std::string("%") + area.letter + std::to_string(address.index);
  if (is_bit != (type->kind == Kind::boolean))
    return refuse(is_bit ? "a bit is BOOL, not " + type->name
                         : name + " is a register of " + std::to_string(area.bits) + " bits and cannot be " +
                               type->name);
  if (!is_bit && (!(is_integer(element->kind) || is_bits(element->kind)) || bits(element->kind) != area.bits))
    return refuse(name + " is a register of " + std::to_string(area.bits) + " bits and cannot be " +
                  type->name + "; it can be " + elementary(natural)->name +
                  " or another integer or bit string of this size");
  const auto form = static_cast<std::uint16_t>(area.bits + (area.is_signed ? 128 : 0));
  if (address.index + type->cells > area.count)
    return refuse("the array leaves the area " + std::string(1, area.letter));
  const auto first = address_of(address.area, address.index);
  use_register(first, type->cells, false);
  value.place = {Place::Base::absolute, static_cast<std::int32_t>(first), 0, -1, 0, 0, true, ""};
  if (is_bit)
    value.place.bit = address.bit, value.place.width = 1, value.place.form = form;
  else if (cell_form(element->kind) != form) {
    if (type->kind == Kind::array)
      return refuse("an array at " + name + " has elements of " + elementary(natural)->name);
    value.place.form = form;
  }
  return value;
}

void Unit::finish() {
  for (const auto& [address, written] : used_registers_) {
    const auto at = register_at(address);
    code.registers.push_back({at.area, at.index, written});
  }
}

}  // namespace trunnion::st
