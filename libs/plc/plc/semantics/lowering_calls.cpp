// SPDX-License-Identifier: Apache-2.0
// Calls of functions, function blocks and programs.
#include <algorithm>
#include <optional>
#include <vector>

#include "plc/library/functions.hpp"
#include "plc/semantics/lowering.hpp"

namespace trunnion::st {
namespace {

const char* section_name(VariableSection section) {
  return section == VariableSection::input    ? "an input"
         : section == VariableSection::output ? "an output"
                                              : "VAR_IN_OUT";
}

bool declares_control(const PouDeclaration& pou) {
  return std::any_of(pou.blocks.begin(), pou.blocks.end(), [](const VariableBlock& block) {
    return (block.section == VariableSection::input || block.section == VariableSection::output) &&
           std::any_of(block.variables.begin(), block.variables.end(),
                       [](const VariableDeclaration& v) { return v.name == "EN" || v.name == "ENO"; });
  });
}

}  // namespace

bool is_parameter(const Variable& variable, const Pou& pou) {
  return &variable != pou.result &&
         (variable.section == VariableSection::input || variable.section == VariableSection::output ||
          variable.section == VariableSection::in_out);
}

/// Of an instance before its value is known; nullptr when there is none.
const Type* Lowering::instance_type(const Expression& e) const {
  if (e.kind == Expression::Kind::name) {
    const Variable* variable = own_variable(e);
    if (variable == nullptr && e.scope == NameScope::any) variable = unit_.find_global(e.name);
    if (variable == nullptr && in_test()) variable = unit_.find_instance(e.name);
    if (variable != nullptr) return variable->type;
    if (e.name == "THIS" && instance() != nullptr) return &instance()->type;
    // A test names the variables of a program by the program.
    const auto* pou = in_test() ? unit_.find_pou(e.name) : nullptr;
    const bool is_program = pou != nullptr && pou->declaration->kind == PouKind::program;
    return is_program && unit_.translated(e.name, e.at) != nullptr ? &pou->type : nullptr;
  }
  const bool follows = e.kind == Expression::Kind::dereference;
  if (e.kind != Expression::Kind::index && e.kind != Expression::Kind::member && !follows) return nullptr;
  const auto* owner = instance_type(*e.parts[0]);
  if (owner == nullptr) return nullptr;
  if (follows)
    return owner->kind == Kind::reference || owner->kind == Kind::pointer ? owner->element : nullptr;
  if (e.kind == Expression::Kind::index) return owner->kind == Kind::array ? owner->element : nullptr;
  if (owner->kind == Kind::structure) {
    const auto* field = owner->field(e.name);
    return field == nullptr ? nullptr : field->type;
  }
  if (owner->kind != Kind::block) return nullptr;
  const auto& names = owner->block->pou->names;
  const auto found = names.find(e.name);
  return found == names.end() ? nullptr : found->second->type;
}

/// EN and ENO of units that declare them are parameters like others.
bool Lowering::has_own_control(const Expression& callee) const {
  if (const auto called = called_method(callee)) return declares_control(*called->method.declaration);
  if (const auto* type = instance_type(callee); type != nullptr && type->kind == Kind::block)
    return declares_control(*type->block->pou->declaration);
  if (callee.kind != Expression::Kind::name) return false;
  const auto* pou = unit_.find_pou(callee.name);
  return pou != nullptr && declares_control(*pou->declaration);
}

Value Lowering::call(const Expression& e, const Type* expected) {
  return e.control.empty() || has_own_control(*e.parts[0]) ? plain_call(e, expected)
                                                           : enabled_call(e, expected);
}

/// Without EN nothing of the call is executed, not its arguments either; the result is the initial value of
/// its type. ENO is EN.
Value Lowering::enabled_call(const Expression& e, const Type* expected) {
  const Argument *enable = nullptr, *done = nullptr;
  for (const auto& argument : e.control) {
    auto& given = argument.output ? done : enable;
    if (given != nullptr)
      return failed(argument.at, argument.output ? "ENO has two variables" : "EN has two values");
    given = &argument;
  }
  const auto executed = temporary(elementary(Kind::boolean));
  std::optional<std::size_t> skip;
  if (enable == nullptr) {
    emit_.constant(executed.place.offset, 1);
  } else {
    emit_.add(Op::move, executed.place.offset, condition(*enable->value, "EN"));
    skip = emit_.add(Op::jump_if_not, 0, executed.place.offset);
  }
  auto result = plain_call(e, expected);
  if (result.is_error()) return result;
  if (skip && result.type->kind == Kind::none) {
    emit_.jump_to_here(*skip);
  } else if (skip) {
    result = own_copy(result, expected, e.at);
    initial_at(*skip, result);
  }
  if (done != nullptr) give_output(*done, executed);
  return result;
}

Value Lowering::plain_call(const Expression& e, const Type* expected) {
  const auto& callee = *e.parts[0];
  Value none;
  none.type = elementary(Kind::none);
  if (const auto called = called_method(callee)) return call_method(*called, e);
  const bool plain = callee.kind == Expression::Kind::name && callee.scope == NameScope::any;
  // A variable hides a function only when it can be called itself.
  const auto instance_named = [&] {
    const Variable* variable = own_variable(callee);
    if (variable == nullptr) variable = unit_.find_global(callee.name);
    if (variable == nullptr && in_test()) variable = unit_.find_instance(callee.name);
    if (variable == nullptr) return false;
    return variable->type->kind == Kind::block ||
           (unit_.find_pou(callee.name) == nullptr && !is_standard_function(callee.name));
  };
  const bool local = plain && instance_named();
  if (plain && !local) {
    if (auto* pou = unit_.find_pou(callee.name)) {
      switch (pou->declaration->kind) {
        case PouKind::function:
          if (unit_.translated(callee.name, callee.at) == nullptr) return error();
          return call_function(*pou, e);
        case PouKind::program:
          if (!in_test() || unit_.is_configured(*pou))
            return failed(callee.at,
                          "the program '" + callee.text + "' is run by its task; only a TEST calls it");
          if (unit_.translated(callee.name, callee.at) == nullptr) return error();
          call_program(*pou, e);
          return none;
        default:
          return failed(callee.at, "'" + callee.text + "' is a function block: declare an instance, name : " +
                                       callee.text + "; and call name(...)");
      }
    }
    if (auto value = reference_of(e)) return *value;
    if (auto value = pointer_function(e)) return *value;
    if (auto value = array_bound(e, expected)) return *value;
    if (auto value = ladder_function(e)) return *value;
    if (auto value = standard_function(e, expected)) return *value;
    return failed(callee.at, "there is no function '" + callee.text + "'");
  }
  const auto instance = target(callee);
  if (instance.is_error()) return instance;
  auto access = writing();
  access.calls = true;
  note(callee, instance, access);
  if (instance.type->kind != Kind::block)
    return failed(callee.at, "'" + callee.text + "' is " + instance.type->name + " and cannot be called");
  if (instance.type->block->pou->declaration->is_class)
    return failed(callee.at, "'" + callee.text + "' is an instance of a class: call one of its methods");
  const auto& block = *instance.type->block->pou;
  if (block.state == Pou::State::in_progress &&
      unit_.translated(block.declaration->name, callee.at) == nullptr)
    return error();
  call_block(located(instance), e);
  return none;
}

/// For each parameter in the order of declaration its argument or nullptr.
bool Lowering::bind(const Pou& pou, const Expression& e, bool is_block, std::vector<const Argument*>& bound) {
  std::vector<const Variable*> parameters;
  for (const auto& variable : pou.variables)
    if (is_parameter(variable, pou)) parameters.push_back(&variable);
  bound.assign(parameters.size(), nullptr);
  bool good = true;
  std::size_t next = 0;
  const auto report = [&](Position at, const std::string& text) {
    unit_.diagnostics().error(at, text);
    good = false;
  };
  const auto& name = pou.declaration->text;
  std::vector<const Argument*> given;
  for (const auto& argument : e.arguments) given.push_back(&argument);
  if (declares_control(*pou.declaration))
    for (const auto& argument : e.control) given.push_back(&argument);
  for (const auto* one : given) {
    const auto& argument = *one;
    std::size_t index = 0;
    if (argument.name.empty()) {
      while (next < parameters.size() && parameters[next]->section == VariableSection::output) ++next;
      if (next >= parameters.size()) {
        report(argument.at, "'" + name + "' has fewer parameters than arguments");
        continue;
      }
      index = next++;
    } else {
      while (index < parameters.size() && parameters[index]->name != argument.name) ++index;
      if (index == parameters.size()) {
        report(argument.at, "'" + name + "' has no parameter '" + argument.name + "'");
        continue;
      }
      const auto section = parameters[index]->section;
      if (argument.output != (section == VariableSection::output)) {
        report(argument.at, "'" + parameters[index]->text + "' is " + section_name(section) + ": write " +
                                (section == VariableSection::output ? "=> variable" : ":= value"));
        continue;
      }
    }
    if (bound[index] != nullptr) report(argument.at, "'" + parameters[index]->text + "' has two values");
    bound[index] = &argument;
  }
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    if (bound[i] != nullptr) continue;
    const auto& p = *parameters[i];
    if (p.section == VariableSection::in_out)
      report(e.at, "VAR_IN_OUT '" + p.text + "' of '" + name + "' needs a variable in every call");
    else if (p.section == VariableSection::input && !is_block && given.empty() &&
             p.initial == p.type->initial)
      report(e.at, "'" + name + "' needs a value for '" + p.text + "'");
  }
  return good;
}

/// The cells of VAR_IN_OUT: the address of the variable that it refers to, of ARRAY[*] also the limits.
std::vector<std::int32_t> Lowering::reference(const Argument& argument, const Variable& parameter) {
  const auto value = referred(*argument.value);
  if (value.is_error()) return {0};
  const auto at = argument.value->at;
  if (value.place.bit >= 0 || value.place.form != 0) {
    unit_.diagnostics().error(at, "a part of a register cannot be VAR_IN_OUT '" + parameter.text +
                                      "'; copy it to a variable and back");
    return {0};
  }
  if (!fits_parameter(*value.type, *parameter.type)) {
    unit_.diagnostics().error(
        at, "VAR_IN_OUT '" + parameter.text + "' is " + parameter.type->name + ", not " + value.type->name);
    return {0};
  }
  if (!check_pointed(*argument.value, parameter)) return {0};
  mark_written(value);
  std::vector<std::int32_t> cells{address(value)};
  if (parameter.type->open) add_limits(value, cells);
  return cells;
}

/// To the variable behind =>, inverted with NOT before the output's name.
void Lowering::give_output(const Argument& argument, const Value& output) {
  const auto at = argument.value->at;
  const auto target = this->target(*argument.value);
  if (!check_writable(target, at)) return;
  note(*argument.value, target, writing());
  const auto value = argument.inverted ? inverted(output, argument.at) : output;
  store(target, converted(value, *target.type, at));
}

Value Lowering::call_function(Pou& function, const Expression& e) {
  std::vector<const Argument*> bound;
  const bool good = bind(function, e, false, bound);
  struct Step {
    const Variable* parameter;
    std::int32_t cell;
    Value value;
    std::vector<std::int32_t> references{};
  };
  // All arguments first: an argument may call the same function.
  std::vector<Step> steps;
  std::size_t i = 0;
  for (const auto& variable : function.variables) {
    if (!is_parameter(variable, function)) continue;
    const auto* argument = bound[i++];
    if (argument == nullptr) {
      if (variable.section == VariableSection::input) {
        // Each call begins with the initial value of what it does not give.
        Value initial;
        initial.type = variable.type;
        steps.push_back({&variable, -1, initial});
      }
      continue;
    }
    if (variable.section == VariableSection::output) continue;
    if (variable.section == VariableSection::in_out) {
      steps.push_back({&variable, 0, {}, reference(*argument, variable)});
      continue;
    }
    const auto at = argument->value->at;
    auto value = converted(expression(*argument->value, variable.type), *variable.type, at);
    if (value.is_error()) continue;
    if (is_one_cell(variable.type->kind)) {
      const auto source = cell(value, *variable.type);
      check_range(*variable.type, value, source);
      const auto keep = emit_.temporary();
      emit_.add(Op::move, keep, source);
      steps.push_back({&variable, keep, value});
    } else {
      steps.push_back({&variable, 0, value});
    }
  }
  if (!good) return error();
  const auto base = static_cast<std::int32_t>(function.base);
  for (const auto& step : steps) {
    const auto target = base + step.parameter->place.offset;
    Value parameter;
    parameter.type = step.parameter->type;
    parameter.place = {Place::Base::absolute, target, 0, -1, 0, 0, true, ""};
    if (step.parameter->section == VariableSection::in_out) {
      for (std::size_t k = 0; k < step.references.size(); ++k)
        emit_.add(Op::save, step.references[k], target + static_cast<std::int32_t>(k));
    } else if (step.cell < 0) {
      Value initial;
      initial.type = step.parameter->type;
      initial.place = {Place::Base::absolute,
                       static_cast<std::int32_t>(unit_.allocate(step.parameter->initial)),
                       0,
                       -1,
                       0,
                       0,
                       false,
                       ""};
      if (is_one_cell(initial.type->kind))
        emit_.add(Op::save, cell(initial), target);
      else
        copy(parameter, initial);
    } else if (is_one_cell(step.parameter->type->kind)) {
      emit_.add(Op::save, step.cell, target);
    } else {
      copy(parameter, step.value);
    }
  }
  emit_.add(Op::call, static_cast<std::int32_t>(function.routine), base);
  i = 0;
  for (const auto& variable : function.variables) {
    if (!is_parameter(variable, function)) continue;
    const auto* argument = bound[i++];
    if (argument == nullptr || variable.section != VariableSection::output) continue;
    Value output;
    output.type = variable.type;
    output.place = {Place::Base::absolute, base + variable.place.offset, 0, -1, 0, 0, false, ""};
    give_output(*argument, output);
  }
  if (function.result == nullptr) {
    Value none;
    none.type = elementary(Kind::none);
    return none;
  }
  // The next call of the function overwrites its frame.
  auto result = temporary(function.result->type);
  Value stored;
  stored.type = result.type;
  stored.place = {Place::Base::absolute, base + function.result->place.offset, 0, -1, 0, 0, false, ""};
  if (is_one_cell(result.type->kind))
    emit_.add(Op::load, result.place.offset, stored.place.offset);
  else
    copy(result, stored);
  return result;
}

void Lowering::call_block(const Value& instance, const Expression& e) {
  const auto& pou = *instance.type->block->pou;
  std::vector<const Argument*> bound;
  if (!bind(pou, e, true, bound)) return;
  const auto start = address(instance.place);
  auto place_of = [&](const Variable& variable) {
    Value value;
    value.type = variable.type;
    value.place = instance.place.base == Place::Base::indirect
                      ? Place{Place::Base::indirect, variable.place.offset, start, -1, 0, 0, true, ""}
                      : moved(instance.place, variable.place.offset);
    value.place.writable = true;
    return value;
  };
  std::size_t i = 0;
  for (const auto& variable : pou.variables) {
    if (!is_parameter(variable, pou)) continue;
    const auto* argument = bound[i++];
    if (argument == nullptr || variable.section == VariableSection::output) continue;
    if (variable.section == VariableSection::in_out) {
      const auto sources = reference(*argument, variable);
      for (std::size_t k = 0; k < sources.size(); ++k)
        store_cell(moved(place_of(variable).place, static_cast<std::int32_t>(k)), *elementary(Kind::lint),
                   sources[k]);
      continue;
    }
    const auto at = argument->value->at;
    store(place_of(variable), converted(expression(*argument->value, variable.type), *variable.type, at));
  }
  emit_.add(Op::call_at, static_cast<std::int32_t>(pou.routine), start);
  i = 0;
  for (const auto& variable : pou.variables) {
    if (!is_parameter(variable, pou)) continue;
    const auto* argument = bound[i++];
    if (argument == nullptr || variable.section != VariableSection::output) continue;
    give_output(*argument, place_of(variable));
  }
}

void Lowering::call_program(Pou& program, const Expression& e) {
  if (!e.arguments.empty() || (declares_control(*program.declaration) && !e.control.empty()))
    failed(e.at, "a program is called without arguments; assign program.variable before");
  emit_.add(Op::call, static_cast<std::int32_t>(program.routine), static_cast<std::int32_t>(program.base));
}

bool Lowering::in_test() const { return pou_ != nullptr && pou_->declaration->kind == PouKind::test; }

}  // namespace trunnion::st
