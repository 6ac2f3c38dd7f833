// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <optional>

#include "plc/semantics/lowering.hpp"

namespace trunnion::st {

namespace {

/// How often FOR runs its body.
std::int64_t runs_of(std::int64_t from, std::int64_t to, std::int64_t by) {
  if (by > 0 ? to < from : from < to) return 0;
  const auto distance = by > 0 ? static_cast<std::uint64_t>(to) - static_cast<std::uint64_t>(from)
                               : static_cast<std::uint64_t>(from) - static_cast<std::uint64_t>(to);
  const auto step = by > 0 ? static_cast<std::uint64_t>(by) : 0 - static_cast<std::uint64_t>(by);
  return static_cast<std::int64_t>(std::min<std::uint64_t>(distance / step, std::uint64_t{1} << 62)) + 1;
}

}  // namespace

void Lowering::body(const Statements& statements) {
  for (const auto& s : statements) statement(*s);
  finish_jumps();
  emit_.jump_to_here(returns_);
  returns_.clear();
  emit_.place(pou_->declaration->end);
  emit_.add(Op::return_);
}

void Lowering::statement(const Statement& s) {
  const auto mark = emit_.mark();
  emit_.place(s.at);
  using enum Statement::Kind;
  // What an instruction list keeps in between is a step on the way to what it writes.
  const bool is_step = s.kind == assign && s.target->name.starts_with('@');
  if (!is_step) emit_.add(Op::statement);
  switch (s.kind) {
    case assign:
      this->assign(s);
      break;
    case call: {
      const auto value = expression(*s.value);
      if (!value.is_error() && value.type->kind != Kind::none && value.variable == nullptr &&
          s.value->parts[0]->kind == Expression::Kind::name && !called_method(*s.value->parts[0])) {
        const auto* pou = unit_.find_pou(s.value->parts[0]->name);
        if (pou == nullptr || pou->declaration->kind == PouKind::function)
          unit_.diagnostics().warning(s.at, "the result of '" + s.value->parts[0]->text + "' is not used");
      }
      break;
    }
    case if_:
      if_statement(s);
      break;
    case case_:
      case_statement(s);
      break;
    case for_:
      for_statement(s);
      break;
    case while_:
      while_statement(s);
      break;
    case repeat:
      repeat_statement(s);
      break;
    case exit:
    case continue_:
      if (loops_.empty())
        failed(s.at,
               s.kind == exit ? "EXIT is permitted in a loop only" : "CONTINUE is permitted in a loop only");
      else
        (s.kind == exit ? loops_.back().exits : loops_.back().continues).push_back(emit_.add(Op::jump));
      break;
    case return_:
      returns_.push_back(emit_.add(Op::jump));
      break;
    case Statement::Kind::define:
      this->define(s);
      return;  // its place stays taken
    case jump:
      jumps_.push_back({emit_.add(Op::loop), s.target->name, s.target->text, s.at});
      break;
    case Statement::Kind::label:
      this->label(s);
      break;
  }
  emit_.release(mark);
}

void Lowering::define(const Statement& s) {
  std::optional<std::size_t> skip;
  if (s.to) skip = emit_.add(Op::jump_if_not, 0, condition(*s.to, "EN"));
  auto& result = defined_[s.target->name];
  const auto value = expression(*s.value);
  result = value;
  if (value.is_error()) return;
  if (value.type->kind == Kind::none || value.type->kind == Kind::block) {
    result = failed(s.value->at, "the block has no result");
    return;
  }
  if (value.is_constant && !skip) return;
  result = own_copy(value, nullptr, s.value->at);
  if (skip) initial_at(*skip, result);
}

void Lowering::label(const Statement& s) {
  emit_.target();
  if (!labels_.emplace(s.target->name, emit_.here()).second)
    failed(s.at, "the label '" + s.target->text + "' is there twice");
}

void Lowering::finish_jumps() {
  for (const auto& jump : jumps_)
    if (const auto found = labels_.find(jump.label); found != labels_.end())
      emit_.set_jump(jump.instruction, found->second);
    else
      failed(jump.at, "there is no label '" + jump.text + "'");
}

void Lowering::assign(const Statement& s) {
  if (s.target->kind == Expression::Kind::call) {
    failed(s.target->at, "a call cannot be assigned to");
    return;
  }
  const auto target = this->target(*s.target);
  // The value is checked too when the target is wrong: both errors are of use.
  const auto value = expression(*s.value, target.is_error() ? nullptr : target.type);
  if (target.is_error() || value.is_error() || !check_writable(target, s.target->at)) return;
  if (target.type->kind == Kind::block) {
    failed(s.target->at, "a function block cannot be assigned to; set its inputs");
    return;
  }
  note(*s.target, target, writing());
  if (s.attempts)
    attempt(target, value, s.value->at);
  else
    store(target, converted(value, *target.type, s.value->at));
}

std::int32_t Lowering::condition(const Expression& e, const char* what) {
  auto value = expression(e, elementary(Kind::boolean));
  if (value.is_error()) return 0;
  if (value.type->kind != Kind::boolean) {
    failed(e.at, std::string("the condition of ") + what + " is BOOL, not " + value.type->name +
                     (is_integer(value.type->kind) ? "; compare: value <> 0" : ""));
    return 0;
  }
  return cell(value, *elementary(Kind::boolean));
}

void Lowering::if_statement(const Statement& s) {
  std::vector<std::size_t> ends;
  for (std::size_t i = 0; i < s.branches.size(); ++i) {
    const auto& branch = s.branches[i];
    std::optional<std::size_t> next;
    if (branch.condition) {
      const auto mark = emit_.mark();
      const auto test = condition(*branch.condition, "IF");
      next = emit_.add(Op::jump_if_not, 0, test);
      emit_.release(mark);
    }
    for (const auto& inner : branch.body) statement(*inner);
    if (i + 1 < s.branches.size()) ends.push_back(emit_.add(Op::jump));
    if (next) emit_.jump_to_here(*next);
  }
  emit_.jump_to_here(ends);
}

void Lowering::case_label(const CaseLabel& label, const Value& selector, std::vector<std::size_t>& jumps,
                          std::vector<std::pair<std::int64_t, std::int64_t>>& seen) {
  Value first, last;
  const auto evaluate = [&](const Expression& e, Value& value) {
    value = expression(e, selector.type);
    if (value.is_error()) return false;
    if (!value.is_constant) {
      failed(e.at, "a value of CASE is a constant");
      return false;
    }
    value = converted(value, *selector.type, e.at);
    return !value.is_error();
  };
  if (!evaluate(*label.first, first)) return;
  last = first;
  if (label.last && !evaluate(*label.last, last)) return;
  if (first.integer > last.integer) {
    failed(label.first->at, "the range " + std::to_string(first.integer) + " .. " +
                                std::to_string(last.integer) + " is empty");
    return;
  }
  for (const auto& [low, high] : seen)
    if (first.integer <= high && last.integer >= low) {
      failed(label.first->at,
             "the value " + std::to_string(std::max(first.integer, low)) + " is in two cases");
      return;
    }
  seen.emplace_back(first.integer, last.integer);
  const auto mark = emit_.mark();
  const auto low = emit_.temporary(), hit = emit_.temporary();
  emit_.constant(low, static_cast<std::uint64_t>(first.integer));
  if (!label.last) {
    emit_.add(Op::equal, hit, selector.place.offset, low);
  } else {
    const auto high = emit_.temporary();
    const bool is_unsigned = !is_signed(selector.type->kind);
    emit_.constant(high, static_cast<std::uint64_t>(last.integer));
    emit_.add(is_unsigned ? Op::less_equal_u : Op::less_equal, hit, low, selector.place.offset);
    emit_.add(is_unsigned ? Op::less_equal_u : Op::less_equal, low, selector.place.offset, high);
    emit_.add(Op::and_, hit, hit, low);
  }
  jumps.push_back(emit_.add(Op::jump_if, 0, hit));
  emit_.release(mark);
}

void Lowering::case_statement(const Statement& s) {
  auto selector = expression(*s.value);
  const auto kind = selector.type->kind;
  if (!selector.is_error() && !is_integer(kind) && kind != Kind::enumeration && !is_bits(kind)) {
    selector =
        failed(s.value->at, "the selector of CASE is an integer, a bit string or an enumeration, not " +
                                selector.type->name);
  }
  if (!selector.is_error()) {
    auto copy =
        temporary(selector.type->kind == Kind::enumeration ? selector.type : elementary(selector.type->kind));
    emit_.add(Op::move, copy.place.offset, cell(selector));
    selector = copy;
  }
  std::vector<std::size_t> ends;
  std::vector<std::pair<std::int64_t, std::int64_t>> seen;
  for (const auto& branch : s.branches) {
    std::optional<std::size_t> next;
    if (!branch.labels.empty()) {
      std::vector<std::size_t> jumps;
      if (!selector.is_error())
        for (const auto& label : branch.labels) case_label(label, selector, jumps, seen);
      next = emit_.add(Op::jump);
      emit_.jump_to_here(jumps);
    }
    for (const auto& inner : branch.body) statement(*inner);
    ends.push_back(emit_.add(Op::jump));
    if (next) emit_.jump_to_here(*next);
  }
  emit_.jump_to_here(ends);
}

// The next value is kept in 64 bits, so the loop also ends when the variable's type has no value behind `to`.
void Lowering::for_statement(const Statement& s) {
  const auto variable = target(*s.target);
  note(*s.target, variable, writing());
  const auto kind = variable.is_error() ? Kind::dint : variable.type->kind;
  bool good = !variable.is_error() && check_writable(variable, s.target->at);
  if (good && !is_integer(kind)) {
    failed(s.target->at, "the variable of FOR is an integer, not " + variable.type->name);
    good = false;
  }
  const auto* type = good ? variable.type : elementary(Kind::dint);
  const auto* plain = elementary(type->kind);
  const auto from = converted(expression(*s.value, plain), *plain, s.value->at);
  const auto to = converted(expression(*s.to, plain), *plain, s.to->at);
  Value by = constant_integer(elementary(Kind::lint), 1);
  // A step may be negative although the variable is not.
  const auto* of_step = is_signed(type->kind) ? plain : elementary(Kind::lint);
  if (s.by) by = converted(expression(*s.by, of_step), *of_step, s.by->at);
  if (by.is_constant && by.integer == 0 && !by.is_error())
    failed(s.by ? s.by->at : s.at, "the step of FOR is 0: the loop would never end");
  const auto next = emit_.temporary(), limit = emit_.temporary(), step = emit_.temporary(),
             done = emit_.temporary();
  emit_.add(Op::move, next, cell(from, *plain));
  emit_.add(Op::move, limit, cell(to, *plain));
  emit_.add(Op::move, step, cell(by, *elementary(Kind::lint)));
  if (good) mark_written(variable);
  const auto start = emit_.here();
  if (by.is_constant) {
    if (by.integer > 0)
      emit_.add(Op::less, done, limit, next);
    else
      emit_.add(Op::less, done, next, limit);
  } else {
    const auto zero = emit_.temporary(), up = emit_.temporary(), high = emit_.temporary(),
               low = emit_.temporary();
    emit_.constant(zero, 0);
    emit_.add(Op::less_equal, up, zero, step);
    emit_.add(Op::less, high, limit, next);
    emit_.add(Op::less, low, next, limit);
    emit_.add(Op::and_, high, high, up);
    emit_.add(Op::not_, up, up);
    emit_.add(Op::and_, low, low, up);
    emit_.add(Op::or_, done, high, low);
  }
  const auto leave = emit_.add(Op::jump_if, 0, done);
  const auto put = [&] {
    if (!good) return;
    const auto value = emit_.temporary();
    emit_.add(Op::narrow, value, next, 0, cell_form(type->kind));
    if (type->ranged) emit_.add(Op::check_range, value, unit_.range_entry({type->low, type->high, 1}));
    store_cell(variable.place, *type, value);
  };
  const auto mark = emit_.mark();
  put();
  emit_.release(mark);
  loops_.emplace_back();
  for (const auto& inner : s.body) statement(*inner);
  emit_.jump_to_here(loops_.back().continues);
  emit_.add(Op::add, next, next, step);
  std::optional<std::int64_t> runs;
  if (from.is_constant && to.is_constant && by.is_constant && by.integer != 0)
    runs = runs_of(from.integer, to.integer, by.integer);
  emit_.loop(start, s.at, runs);
  emit_.jump_to_here(leave);
  // Behind a loop that came to its end the variable is one step further, unless its type ends before.
  if (!type->ranged) put();
  emit_.jump_to_here(loops_.back().exits);
  loops_.pop_back();
}

void Lowering::while_statement(const Statement& s) {
  const auto start = emit_.here();
  const auto mark = emit_.mark();
  const auto test = condition(*s.value, "WHILE");
  const auto leave = emit_.add(Op::jump_if_not, 0, test);
  emit_.release(mark);
  loops_.emplace_back();
  for (const auto& inner : s.body) statement(*inner);
  emit_.jump_to_here(loops_.back().continues);
  emit_.loop(start, s.at);
  emit_.jump_to_here(leave);
  emit_.jump_to_here(loops_.back().exits);
  loops_.pop_back();
}

void Lowering::repeat_statement(const Statement& s) {
  const auto start = emit_.here();
  loops_.emplace_back();
  for (const auto& inner : s.body) statement(*inner);
  emit_.jump_to_here(loops_.back().continues);
  const auto test = condition(*s.value, "UNTIL");
  const auto leave = emit_.add(Op::jump_if, 0, test);
  emit_.loop(start, s.at);
  emit_.jump_to_here(leave);
  emit_.jump_to_here(loops_.back().exits);
  loops_.pop_back();
}

}  // namespace trunnion::st
