// SPDX-License-Identifier: Apache-2.0
// The part of Interpreter that branches, loops and jumps.
#include <algorithm>
#include <cstdint>
#include <cstdio>

#include "language/interpreter.hpp"

namespace trunnion::language {
namespace {

/// Behind so many bytes no text is in front of a program.
constexpr std::uint64_t longest_leader = 16384;

}  // namespace

Interpreter::State Interpreter::run_statement(std::string_view line) {
  CallLevel& level = levels_[depth_];
  const Fault in_vain{AlarmNumber::begin_without_end, block_.at};
  const Statement statement = level.open.meaning(block_.statement, block_.key());
  switch (statement) {
    case Statement::none:
      return State::running;
    case Statement::assignment:
      if (Fault fault = carry_out_requests()) {
        fault.offset = block_.at;
        return fail(fault, line);
      }
      return State::running;
    case Statement::go_to:
      return jump(Purpose::label, block_.label, position_, {AlarmNumber::label_missing, block_.at}, line);
    case Statement::call_cycle:
      return call_cycle(line);
    case Statement::print:
      if (const Fault fault = executor_.print(level.program, line_, queue_)) return fail(fault, line);
      return State::running;
    case Statement::call_sub:
      return call_sub(line);
    case Statement::begin_sub:
      return begin_sub(line);
    case Statement::end_sub:
    case Statement::return_sub:
      return return_from_sub(line);
    case Statement::break_loop:
    case Statement::continue_loop:
      return leave_loop(line);
    case Statement::modal_state:
      return change_modes(line);
    case Statement::end_repeat:
      if (!level.open.runs_again(block_.key())) break;
      reader_.seek(*level.source, level.open.top().body);
      return State::running;
    default:
      break;
  }
  const TextPosition begin = level.open.size() != 0 ? level.open.top().begin : TextPosition{};
  const AlarmNumber alarm = level.open.pass(statement, block_.key(), position_);
  if (alarm != AlarmNumber::none) return fail({alarm, block_.at}, line);
  switch (statement) {
    case Statement::begin_if:
      return branch(block_.condition, line);
    case Statement::else_if: {
      const bool due = else_if_due_;
      else_if_due_ = false;
      if (!due) return jump(Purpose::end, 0, position_, in_vain, line);
      bool condition = false;
      if (const Fault fault = dialect_->read_condition(line, block_.rest, variables_, condition)) {
        else_if_due_ = fault.number == value_pending;
        return fail(fault, line);
      }
      return branch(condition, line);
    }
    case Statement::else_:
      return jump(Purpose::end, 0, position_, in_vain, line);
    case Statement::begin_while:
    case Statement::begin_do:
      return block_.condition ? execute_rest(line) : jump(Purpose::end, 0, position_, in_vain, line);
    case Statement::end_while:
    case Statement::end_do:
      // The beginning is read again: its condition decides.
      reader_.seek(*level.source, begin);
      return State::running;
    case Statement::end_until:
      if (block_.condition) reader_.seek(*level.source, begin);
      return State::running;
    case Statement::begin_repeat:
      return repeat(line);
    default:
      return State::running;
  }
}

Interpreter::State Interpreter::repeat(std::string_view line) {
  const auto times = static_cast<std::uint32_t>(block_.arguments[0].number);
  if (times == 0) return jump(Purpose::end, 0, position_, {AlarmNumber::begin_without_end, block_.at}, line);
  levels_[depth_].open.repeat(times, reader_.position());
  return State::running;
}

Interpreter::State Interpreter::branch(bool condition, std::string_view line) {
  if (condition) return execute_rest(line);
  return jump(Purpose::branch, 0, position_, {AlarmNumber::begin_without_end, block_.at}, line);
}

// What the NUM dialect permits behind THEN and DO.
Interpreter::State Interpreter::execute_rest(std::string_view line) {
  if (block_.has_more()) return execute_words(line);
  if (const Fault fault = carry_out_requests()) return fail(fault, line);
  return State::running;
}

Interpreter::State Interpreter::jump(Purpose purpose, std::uint64_t wanted, TextPosition from,
                                     const Fault& in_vain, std::string_view line, std::size_t depth) {
  const JumpCache::Target* const known =
      jumps_.find(levels_[depth_].source, from.offset, key(purpose, wanted));
  if (known != nullptr) return arrive(*known);
  char label[16] = "";
  Fault fault = in_vain;
  if (purpose == Purpose::label || purpose == Purpose::local) {
    std::snprintf(label, sizeof label, "N%u", static_cast<unsigned>(wanted));
    fault.detail = label;
  }
  not_found_ = located(fault, line);
  not_allowed_ = located({AlarmNumber::jump_into_structure, in_vain.offset}, line);
  return search(purpose, wanted, from, depth);
}

Interpreter::State Interpreter::search(Purpose purpose, std::uint64_t wanted, TextPosition from,
                                       std::size_t depth) {
  const CallLevel& level = levels_[depth_];
  search_.purpose = purpose;
  search_.source = level.source;
  search_.dialect = dialect_name_;
  search_.wanted = wanted;
  search_.from = from;
  search_.from_top = search_.heading = false;
  search_.begun = true;
  search_.depth = depth == innermost ? level.open.size() : depth;
  search_.open = level.open;
  return State::searching;
}

Interpreter::State Interpreter::arrive(const JumpCache::Target& target) {
  CallLevel& level = levels_[depth_];
  level.open.cut(target.open, target.divided);
  else_if_due_ = target.at_else_if;
  reader_.seek(*level.source, target.position);
  return State::running;
}

Interpreter::State Interpreter::search_line(Step& step) {
  const TextPosition position = reader_.position();
  std::string_view line;
  const LineReader::Status status = reader_.next(line);
  if (status == LineReader::Status::end) return search_ended();
  if (status != LineReader::Status::line) return report_line_status(status, step);
  if (search_.purpose == Purpose::leader) {
    const Leader leader = dialect_->leader(line);
    if (!leader.passes || position.offset > longest_leader) return fail(not_found_);
    return pass_leader(leader, position);
  }
  const Dialect& dialect = search_.dialect == dialect_name_ ? *dialect_ : dialect_of(search_.dialect);
  const Outline outline = dialect.outline(line, options_.block_skip);
  if (search_.purpose == Purpose::sub || search_.purpose == Purpose::sub_end)
    return search_sub(outline, position, line);
  if (search_.purpose == Purpose::program) {
    if (outline.head != Head::program || outline.program_number != search_.wanted) return State::searching;
    const bool cycle = call_.kind == CallKind::cycle;
    return found(*search_.source, cycle ? cycle_file : levels_[depth_].program, position, search_.dialect);
  }
  if (search_.purpose == Purpose::label || search_.purpose == Purpose::local) {
    // What lies between the top and the jump is this program, its head included.
    const bool next_program = outline.head != Head::none && !search_.heading;
    if (search_.from_top ? position.offset > search_.from.offset : next_program) return search_ended();
    search_.heading = search_.heading && outline.head != Head::program && !outline.sequence_number &&
                      outline.statement == Statement::none;
    if (outline.sequence_number == search_.wanted) return label_found(position);
  } else {
    if (outline.head != Head::none) return search_ended();
    if (search_.open.size() == search_.depth &&
        structure_found(search_.open.meaning(outline.statement, outline.key()), outline.key())) {
      // The jump passes the line, so nothing else reads what is behind its word.
      if (outline.behind) {
        line_ = position.line;
        return fail(outline.behind, line);
      }
      JumpCache::Target target{reader_.position(), search_.depth - 1, false, search_.open.divided()};
      if (search_.purpose == Purpose::last) target = {position, search_.depth, false, search_.open.divided()};
      if (outline.statement == Statement::else_) {
        search_.open.pass(outline.statement, outline.key(), position);
        target.open = search_.depth;
        target.divided = search_.open.divided();
      }
      if (outline.statement == Statement::else_if)
        target = {position, search_.depth, true, search_.open.divided()};
      jumps_.store(search_.source, search_.from.offset, key(search_.purpose, search_.wanted), target);
      return arrive(target);
    }
  }
  const AlarmNumber alarm = search_.open.pass(outline.statement, outline.key(), position);
  if (alarm == AlarmNumber::none) return State::searching;
  line_ = position.line;
  return fail({alarm, 0}, {});
}

// Blank tape, and text in front of the % with which a tape begins, are none of the program. What could be a
// block is.
Interpreter::State Interpreter::pass_leader(const Fault& fault, std::string_view line) {
  const std::size_t blank = std::min(line.find_first_not_of('\0'), line.size());
  const bool blank_tape = blank != 0 && line.find('\0', blank) == std::string_view::npos;
  const Leader leader = blank_tape ? Leader{true, blank} : dialect_->leader(line);
  if (!leader.passes || leader.mark == 0) return fail(fault, line);
  not_found_ = named(fault, line);
  CallLevel& level = levels_[depth_];
  if (leader.named && level.taped && not_found_.foreign == nullptr) {
    level.started = true;
    return State::running;
  }
  search_.purpose = Purpose::leader;
  search_.source = levels_[depth_].source;
  return pass_leader(leader, position_);
}

bool Interpreter::passes_before_head(std::string_view line) const {
  const Dialect& dialect = dialect_of(headless());
  return reader_.position().offset <= longest_leader && dialect.leader(line).passes;
}

// A text that has nothing else ends with the alarm of its first line.
Interpreter::State Interpreter::pass_leader(const Leader& leader, TextPosition position) {
  if (leader.mark == Leader::no_mark) return State::searching;
  CallLevel& level = levels_[depth_];
  level.top = {position.offset + leader.mark, position.line};
  reader_.seek(*level.source, level.top);
  had_leader_ = had_leader_ || depth_ == 0;
  return State::running;
}

bool Interpreter::structure_found(Statement statement, std::uint64_t named) const {
  if (!search_.open.top().has(named)) return false;
  const Statement begin = search_.open.top().kind;
  switch (statement) {
    case Statement::else_if:
    case Statement::else_:
      return search_.purpose == Purpose::branch && begin == Statement::begin_if;
    case Statement::end_if:
      return begin == Statement::begin_if;
    case Statement::end_while:
      return begin == Statement::begin_while;
    case Statement::end_do:
      return begin == Statement::begin_do;
    case Statement::end_repeat:
      return begin == Statement::begin_repeat;
    case Statement::end_until:
      return begin == Statement::begin_until;
    default:
      return false;
  }
}

Interpreter::State Interpreter::label_found(TextPosition position) {
  if (search_.purpose == Purpose::local) {
    if (search_.open.size() != 0) return fail(not_allowed_);
    return found(*search_.source, levels_[depth_].program, position, search_.dialect);
  }
  const std::size_t common = levels_[depth_].open.common(search_.open);
  if (common != search_.open.size()) return fail(not_allowed_);
  const JumpCache::Target target{position, common, false, search_.open.divided()};
  jumps_.store(search_.source, search_.from.offset, key(search_.purpose, search_.wanted), target);
  return arrive(target);
}

Interpreter::State Interpreter::search_ended() {
  if (search_.purpose == Purpose::sub) return search_sub_elsewhere();
  if (search_.purpose == Purpose::program && call_.kind != CallKind::cycle) {
    TextSource* const other = environment_.subprogram(ProgramName(call_.number).view());
    if (other != nullptr) return read_head(*other, call_.number, Heading::Then::enter);
    if (rules_.homing_program != 0 && call_.number == rules_.homing_program) return home_axis();
    // The old form: the last four digits are the program, those before them count.
    constexpr std::uint32_t four_digits = 10000;
    if (!call_.counted && call_.number > four_digits && call_.number % four_digits != 0) {
      call_.repetitions = call_.number / four_digits;
      call_.number %= four_digits;
      call_.counted = true;
      search_.wanted = call_.number;
      reader_.seek(*search_.source, {});
      return State::searching;
    }
  }
  if (search_.purpose == Purpose::end && rules_.text_closes_else) {
    search_.open.close_divided();
    if (search_.open.size() < search_.depth) return end_of_text();
  }
  const bool labelled = search_.purpose == Purpose::label || search_.purpose == Purpose::local;
  if (!labelled || search_.from_top) return fail(not_found_);
  search_.from_top = true;
  search_.open.clear();
  reader_.seek(*search_.source, levels_[depth_].home);
  return State::searching;
}

}  // namespace trunnion::language
