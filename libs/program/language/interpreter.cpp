// SPDX-License-Identifier: Apache-2.0
#include "language/interpreter.hpp"

#include <cmath>
#include <string_view>

#include "language/computed_word.hpp"
#include "language/foreign_words.hpp"
#include "language/haas_dialect.hpp"
#include "language/iso_dialect.hpp"
#include "language/iso_line.hpp"
#include "language/linuxcnc_dialect.hpp"
#include "language/num_dialect.hpp"
#include "text/utf8.hpp"

namespace trunnion::language {
namespace {

/// Lines read in one call of next() before it gives the thread back.
constexpr int lines_per_call = 1000;

/// Makes the end of the program (M2) that of the subprogram (M99).
void return_at_end(Block& block) {
  for (std::size_t i = 0; i < block.m_count; ++i)
    if (block.m[i].value == 2) block.m[i].value = 99;
}

/// The message of a block: what its reader has composed, or a part of its line.
std::string_view shown_text(const Block& block, std::string_view line) {
  if (block.text_size != 0) return {block.text.data(), block.text_size};
  return line.substr(0, line.find_last_not_of(" \t") + 1).substr(block.message_at);
}

}  // namespace

const Dialect& Interpreter::dialect_of(ProgramDialect name) {
  static const IsoDialect iso;
  static const NumDialect num;
  static const LinuxcncDialect linuxcnc;
  static const HaasDialect haas;
  if (name == ProgramDialect::num) return num;
  if (name == ProgramDialect::linuxcnc) return linuxcnc;
  if (name == ProgramDialect::haas) return haas;
  return iso;
}

Interpreter::Interpreter(Environment& environment, InterpreterOptions options, const Dialect* dialect)
    : environment_(environment),
      chosen_(dialect),
      dialect_(dialect != nullptr ? dialect : &dialect_of(ProgramDialect::iso)),
      options_(options),
      executor_(environment),
      control_(environment, executor_),
      variables_(control_) {}

void Interpreter::start(TextSource& text, const AxisValues& position, const ModalState& initial,
                        const VariableStore& variables, Beginning beginning) {
  take_rules();
  executor_.start(position, initial, beginning);
  if (beginning == Beginning::program) {
    control_.start();
    modal_calls_.clear();
    kept_modes_[0].valid = kept_modes_[0].returns = false;
  }
  control_.forget_call();
  variables_.start(variables);
  control_.set_skip_position(variables_.skip_position());
  if (beginning == Beginning::program) control_.set_skip_touched(false);
  for (std::size_t i = 0; i < cycle_m_codes_.size(); ++i) cycle_m_codes_[i] = environment_.cycle_m_code(i);
  code_calls_ = environment_.code_calls();
  calls_by_code_ = code_calls_ != CodeCalls{};
  queue_.clear();
  alarm_ = Alarm{};
  depth_ = 0;
  found_.fill({});
  next_found_ = 0;
  named_text_count_ = 0;
  jumps_.clear();
  blocks_ = lines_ = 0;
  message_size_ = 0;
  stop_line_ = 0;
  else_if_due_ = false;
  had_leader_ = false;
  modal_calls_.leave(0);
  levels_[0] = CallLevel{};
  levels_[0].source = &text;
  begins_program_ = beginning == Beginning::program;
  reader_.reset();
  state_ = read_head(text, 0, Heading::Then::start);
}

Step Interpreter::next(Command& command) {
  for (int lines = 0; queue_.empty(); ++lines) {
    if (state_ != State::failed && executor_.busy()) {
      queue_.clear();
      if (const Fault fault = executor_.resume(queue_)) state_ = fail(fault, {});
      if (lines == lines_per_call) return Step::working;
      continue;
    }
    if (executor_.needs_position()) return Step::position;
    if (control_.needs_answer()) return Step::answer;
    if (control_.needs_value()) return Step::value;
    if (state_ == State::done) return Step::end;
    if (state_ == State::failed) return Step::alarm;
    if (lines == lines_per_call) return Step::working;
    queue_.clear();
    Step step = Step::working;
    if (state_ == State::heading) {
      state_ = head_line(step);
      if (step == Step::pending) return step;
      continue;
    }
    ++lines_;
    const auto from = reader_.position().offset;
    const auto depth = depth_;
    state_ = state_ == State::searching ? search_line(step) : run_line(step);
    if (step == Step::pending || step == Step::line) return step;
    if (watch_ != nullptr && jumped_back(from, depth) && repeats_for_ever()) state_ = State::done;
  }
  command = queue_.pop();
  return Step::command;
}

// Not by a call, nor behind one; nor to the begin of a line that waits for the value of a spindle.
bool Interpreter::jumped_back(std::uint64_t from, std::size_t depth) const {
  if (state_ != State::running || executor_.busy() || control_.needs_value() || depth_ > depth) return false;
  const auto offset = reader_.position().offset;
  return depth_ < depth ? offset != levels_[depth_].resume.offset : offset <= from;
}

bool Interpreter::repeats_for_ever() {
  ReadingPlace place;
  place.depth = depth_;
  place.modal_calls = modal_calls_.count();
  for (std::size_t i = 0; i <= depth_; ++i) {
    const CallLevel& level = levels_[i];
    const TextPosition behind = i == depth_ ? reader_.position() : level.resume;
    place.levels[i] = {level.source, behind.offset, level.remaining, level.open.repetitions()};
  }
  const std::uint32_t line = depth_ == 0 ? reader_.position().line : levels_[1].call_line;
  return watch_->returns(place, line, variables_, executor_.position(), executor_.modal());
}

Interpreter::State Interpreter::report_line_status(LineReader::Status status, Step& step) {
  line_ = reader_.position().line;
  if (status == LineReader::Status::failed) return fail({AlarmNumber::text_unreadable, 0}, {});
  if (status == LineReader::Status::too_long) return fail({AlarmNumber::line_too_long, 0}, {});
  step = Step::pending;
  return state_;
}

Alarm Interpreter::located(const Fault& fault, std::string_view line) {
  // Seen when the moves behind it are read, but its own.
  if (fault.number == AlarmNumber::compensation_interference) {
    Alarm alarm = make_alarm({fault.number, 0}, {}, levels_[depth_].program, executor_.interference().line,
                             executor_.fault_detail(fault.number));
    alarm.file_name = file_name(alarm.program);
    return alarm;
  }
  std::string_view detail = fault.number == AlarmNumber::spindle_without_mark
                                ? std::string_view(control_.unmarked())
                                : executor_.fault_detail(fault.number);
  Fault found = fault;
  WordDetail computed;
  if (detail.empty()) {
    detail = computed_word(fault, line, variables_, computed);
    if (!detail.empty()) found.detail = nullptr;
  }
  Alarm alarm = make_alarm(found, line, levels_[depth_].program, line_, detail);
  alarm.file_name = file_name(alarm.program);
  alarm.calls = static_cast<std::uint8_t>(depth_);
  for (std::size_t i = 0; i < depth_; ++i)
    alarm.chain[i] = {levels_[i].program, levels_[i + 1].call_line, file_name(levels_[i].program)};
  return alarm;
}

Interpreter::State Interpreter::fail(const Fault& fault, std::string_view line) {
  if (fault.number == value_pending) return ask_value(line);
  return fail(named(fault, line));
}

// An M code is above all one that the machine does not have: its alarm keeps the number.
Alarm Interpreter::named(const Fault& fault, std::string_view line) {
  Fault found = fault;
  const ForeignWord* const word =
      dialect_->names_foreign_words() ? find_foreign_word(fault, line, found.offset) : nullptr;
  if (word == nullptr) return located(fault, line);
  if (fault.number != AlarmNumber::unknown_m) found.number = AlarmNumber::foreign_word;
  found.detail = word->shown;
  Alarm alarm = located(found, line);
  alarm.foreign = word;
  return alarm;
}

// The line has had no effect yet but for what it has stored: that is taken back, and the line is read again.
Interpreter::State Interpreter::ask_value(std::string_view line) {
  if (!variables_.take_back()) return fail({AlarmNumber::too_many_codes, 0}, line);
  if (const Fault fault = executor_.read_value(control_.wanted(), levels_[depth_].program, line_, queue_))
    return fail(fault, line);
  control_.await_value();
  reader_.seek(*levels_[depth_].source, position_);
  return State::running;
}

Interpreter::State Interpreter::fail(const Alarm& alarm) {
  alarm_ = alarm;
  return State::failed;
}

void Interpreter::use_dialect(ProgramDialect name) {
  if (chosen_ != nullptr || name == dialect_name_) return;
  dialect_name_ = name;
  dialect_ = &dialect_of(name);
  take_rules();
}

void Interpreter::take_rules() {
  rules_ = dialect_->rules();
  variables_.set_numbers(rules_.system_number);
  control_.set_tool_times(rules_.tool_times);
  control_.set_tool_diameters(rules_.tool_diameters && !environment_.haas_radius_offsets());
}

Interpreter::State Interpreter::read_head(TextSource& source, std::uint32_t program, Heading::Then then) {
  heading_ = {then, &source, program};
  if (chosen_ != nullptr) return head_ended(ProgramDialect::iso);
  reader_.seek(source, {});
  return State::heading;
}

Interpreter::State Interpreter::head_line(Step& step) {
  const std::uint32_t number = reader_.position().line;
  std::string_view line;
  HeadLine head{HeadLine::Kind::closed};
  const LineReader::Status status = reader_.next(line);
  if (status == LineReader::Status::line)
    head = read_head_line(line);
  else if (status != LineReader::Status::end)
    return report_line_status(status, step);
  // Text in front of the tape's %, as Interpreter::pass_leader().
  if (head.kind == HeadLine::Kind::closed && status == LineReader::Status::line && passes_before_head(line))
    return State::heading;
  switch (head.kind) {
    case HeadLine::Kind::open:
      return State::heading;
    case HeadLine::Kind::named:
      return head_ended(head.dialect);
    case HeadLine::Kind::unknown:
      return fail_head(head, number, line);
    case HeadLine::Kind::closed:
      break;
  }
  return head_ended(headless());
}

// Cycles are ISO, and only LinuxCNC has files that hold subroutines.
ProgramDialect Interpreter::headless() const {
  if (heading_.then != Heading::Then::search) return dialect_without_head(*heading_.source, environment_);
  return call_.kind == CallKind::cycle ? ProgramDialect::iso : ProgramDialect::linuxcnc;
}

Interpreter::State Interpreter::head_ended(ProgramDialect dialect) {
  TextSource& source = *heading_.source;
  switch (heading_.then) {
    case Heading::Then::enter:
      return found(source, heading_.program, {}, dialect);
    case Heading::Then::search:
      search_.dialect = dialect;
      reader_.seek(source, {});
      return State::searching;
    case Heading::Then::start:
      break;
  }
  levels_[0].dialect = dialect;
  use_dialect(dialect);
  if (begins_program_ && rules_.returns_to_r) executor_.return_to_r();
  reader_.seek(source, {});
  return State::running;
}

// The alarm is in the text that would be entered.
Interpreter::State Interpreter::fail_head(const HeadLine& head, std::uint32_t number, std::string_view line) {
  Alarm alarm = make_alarm({AlarmNumber::dialect_unknown, head.offset}, line, heading_.program, number);
  alarm.file_name = file_name(heading_.program);
  const std::size_t calls = heading_.then == Heading::Then::start ? 0 : depth_ + 1;
  alarm.calls = static_cast<std::uint8_t>(calls);
  for (std::size_t i = 0; i < calls; ++i)
    alarm.chain[i] = {levels_[i].program, i == depth_ ? call_line_ : levels_[i + 1].call_line,
                      file_name(levels_[i].program)};
  return fail(alarm);
}

Interpreter::State Interpreter::run_line(Step& step) {
  position_ = reader_.position();
  std::string_view line;
  const LineReader::Status status = reader_.next(line);
  line_ = position_.line;
  if (status == LineReader::Status::line) {
    if (line_ == stop_line_ && levels_[depth_].program == 0) {
      stop_line_ = 0;
      reader_.seek(*levels_[depth_].source, position_);
      step = Step::line;
      return state_;
    }
    return execute(line);
  }
  return status == LineReader::Status::end ? end_of_text() : report_line_status(status, step);
}

Interpreter::State Interpreter::execute(std::string_view line) {
  variables_.begin_line();
  control_.begin_line();
  control_.set_place(line_, depth_);
  const State state = execute_block(line);
  if (!control_.needs_value()) control_.end_line();
  return state;
}

Interpreter::State Interpreter::execute_block(std::string_view line) {
  CallLevel& level = levels_[depth_];
  if (const Fault fault = dialect_->read_block(line, options_.block_skip, variables_, block_))
    return level.started ? fail(fault, line) : pass_leader(fault, line);
  if (block_.skipped) return State::running;
  level.taped = block_.head == Head::tape_mark || (level.taped && block_.empty());
  const bool goes_on = !rules_.heads_end_text && depth_ == 0 && block_.head == Head::program;
  if (block_.head != Head::none && level.started && !goes_on) {
    // On other controls : is a main block in the middle of a program.
    if (is_colon_head(line)) return fail({AlarmNumber::colon_in_program, 0}, line);
    return end_of_text();
  }
  if (block_.head == Head::program) {
    level.started = true;
    control_.set_program_number(block_.program_number);
  }
  if (block_.statement != Statement::none || !block_.empty()) ++blocks_;
  if (block_watch_ != nullptr)
    block_watch_->begin(
        {block_, line, level.program, line_, executor_.modal(), executor_.program_position(), level.dialect});
  if (block_.has('N')) control_.set_sequence_number(block_.value('N'));
  if (block_.statement != Statement::none) {
    level.started = true;
    return run_statement(line);
  }
  if (block_.empty()) return State::running;
  level.started = true;
  return execute_words(line);
}

Fault Interpreter::carry_out_requests() { return control_.carry_out(levels_[depth_].program, line_, queue_); }

Interpreter::State Interpreter::execute_words(std::string_view line) {
  if (const Fault fault = carry_out_requests()) return fail(fault, line);
  if (rules_.text_ends_subprograms && depth_ != 0 && !block_.ends_program) return_at_end(block_);
  if (block_.message) {
    message_size_ = text::copy_readable(shown_text(block_, line), message_);
  }
  if (calls_by_code_ && rules_.cycle_m_codes && !levels_[depth_].by_code) {
    if (const auto called = call_by_code(line)) return *called;
  }
  if (block_.refused) return fail(block_.refused, line);
  Call call;
  static constexpr CycleMCodes no_cycles{};
  if (find_call(block_, rules_.cycle_m_codes ? cycle_m_codes_ : no_cycles, call))
    return call_macro(call, line);
  const auto* const modal = modal_calls_.active();
  if (modal != nullptr && modal->call.kind == CallKind::block_macro) {
    if (block_.two_tools) return fail({AlarmNumber::letter_twice, block_.offset(second_tool_word)}, line);
    read_arguments(block_, CallKind::block_macro, executor_.modal().absolute, arguments_);
    return this->call(modal->call, line);
  }
  Flow flow;
  if (const Fault fault = executor_.execute(block_, levels_[depth_].program, line_, queue_, flow))
    return fail(fault, line);
  if (modal == nullptr || flow.kind != Flow::Kind::next || !executor_.moves()) return go(flow, line);
  arguments_ = modal->arguments;
  return this->call(modal->call, line);
}

Interpreter::State Interpreter::go(const Flow& flow, std::string_view line) {
  switch (flow.kind) {
    case Flow::Kind::next:
      return State::running;
    case Flow::Kind::end:
      return State::done;
    case Flow::Kind::go_back:
      if (levels_[depth_].sub != 0) return fail({AlarmNumber::linuxcnc_sub_outside, flow.offset}, line);
      return return_from_subprogram(flow, line);
    case Flow::Kind::call:
      break;
  }
  Call subprogram;
  subprogram.number = flow.subprogram;
  subprogram.repetitions = flow.repetitions;
  subprogram.counted = flow.counted || !rules_.number_counts;
  subprogram.offset = flow.offset;
  subprogram.program_offset = block_.offset(!block_.has('P') && block_.has('Q') ? 'Q' : 'P');
  subprogram.from_label = flow.from_label;
  subprogram.label = flow.label;
  subprogram.label_offset = flow.label_offset;
  return flow.local ? call_locally(subprogram, line) : call(subprogram, line);
}

void Interpreter::set_position(const AxisValues& position, const AxisValues& touched) {
  const bool skipped = executor_.needs_position() && !executor_.homing();
  const bool must_touch = skipped && executor_.state().needs_contact && !options_.assume_contact;
  bool contact = options_.assume_contact;
  if (skipped) {
    for (std::size_t axis = 0; axis < axis_count; ++axis)
      contact |= std::abs(touched[axis] - executor_.position()[axis]) > no_distance;
    executor_.set_position(touched);
    // LinuxCNC means what a word would give.
    const bool linuxcnc = block_.table == CodeTable::linuxcnc;
    variables_.set_skip_position(linuxcnc ? executor_.program_position() : executor_.workpiece_position());
    control_.set_skip_position(variables_.skip_position());
    control_.set_skip_touched(contact);
  }
  executor_.set_position(position);
  if (must_touch && !contact) state_ = fail({AlarmNumber::linuxcnc_no_contact, 0}, {});
}

void Interpreter::answer(double value) {
  control_.answer(value);
  found_.fill({});
}

AxisValues Interpreter::workpiece(const Command& command) const {
  AxisValues tip = command.target;
  if (command.modal.transformation == Transformation::none) tip[Z] -= command.modal.tool_length;
  return executor_.frame().workpiece_from_command(tip);
}

Interpreter::State Interpreter::end_of_text() {
  if (had_leader_ && !levels_[0].started) return fail(not_found_);
  OpenStructures& open = levels_[depth_].open;
  if (rules_.text_closes_else) open.close_divided();
  if (open.size() != 0) {
    line_ = open.top().begin.line;
    return fail({AlarmNumber::begin_without_end, 0}, {});
  }
  if (depth_ != 0 && rules_.text_ends_subprograms) return return_from_subprogram({}, {});
  if (levels_[depth_].sub != 0) return fail({AlarmNumber::linuxcnc_sub_nested, 0}, {});
  if (depth_ != 0) return fail({AlarmNumber::subprogram_without_end, 0}, {});
  if (const Fault fault = executor_.end_program(0, levels_[0].program, line_, queue_)) return fail(fault, {});
  return State::done;
}

}  // namespace trunnion::language
