#include "language/interpreter.hpp"

#include <charconv>
#include <string_view>

namespace trunnion::language {
namespace {

/// Lines read in one call of next() before it gives the thread back.
constexpr int lines_per_call = 1000;

/// "O" and at least four digits.
class ProgramName {
 public:
  explicit ProgramName(std::uint32_t number) {
    char digits[10] = {};
    const auto end = std::to_chars(digits, digits + sizeof digits, number).ptr;
    text_[size_++] = 'O';
    for (auto missing = 4 - (end - digits); missing > 0; --missing) text_[size_++] = '0';
    for (const char* digit = digits; digit != end; ++digit) text_[size_++] = *digit;
  }
  std::string_view view() const { return {text_, size_}; }

 private:
  char text_[16] = {};
  std::size_t size_ = 0;
};

}  // namespace

const Dialect& Interpreter::iso_dialect() {
  static const IsoDialect dialect;
  return dialect;
}

Interpreter::Interpreter(Environment& environment, InterpreterOptions options, const Dialect& dialect)
    : environment_(environment), dialect_(dialect), options_(options), executor_(environment) {}

void Interpreter::start(TextSource& text, const AxisValues& position, const ModalState& initial) {
  executor_.start(position, initial);
  queue_.clear();
  alarm_ = Alarm{};
  depth_ = 0;
  found_.fill({});
  next_found_ = 0;
  frames_[0] = Frame{};
  frames_[0].source = &text;
  reader_.reset();
  reader_.seek(text, frames_[0].top);
  state_ = State::running;
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
    if (state_ == State::done) return Step::end;
    if (state_ == State::failed) return Step::alarm;
    if (lines == lines_per_call) return Step::working;
    queue_.clear();
    Step step = Step::working;
    state_ = state_ == State::searching ? search_line(step) : run_line(step);
    if (step == Step::pending) return step;
  }
  command = queue_.pop();
  return Step::command;
}

Interpreter::State Interpreter::report_line_status(LineReader::Status status, Step& step) {
  line_ = reader_.position().line;
  if (status == LineReader::Status::failed) return fail({AlarmNumber::text_unreadable, 0}, {});
  if (status == LineReader::Status::too_long) return fail({AlarmNumber::line_too_long, 0}, {});
  step = Step::pending;
  return state_;
}

Interpreter::State Interpreter::fail(const Fault& fault, std::string_view line) {
  alarm_ = make_alarm(fault, line, frames_[depth_].program, line_);
  return State::failed;
}

Interpreter::State Interpreter::run_line(Step& step) {
  const std::uint32_t number = reader_.position().line;
  std::string_view line;
  const LineReader::Status status = reader_.next(line);
  line_ = number;
  if (status == LineReader::Status::line) return execute(line);
  if (status == LineReader::Status::end) return end_of_text();
  return report_line_status(status, step);
}

Interpreter::State Interpreter::execute(std::string_view line) {
  Frame& frame = frames_[depth_];
  if (const Fault fault = dialect_.read_block(line, block_)) return fail(fault, line);
  if (block_.skip && options_.block_skip) return State::running;
  if (block_.head != Head::none && frame.begun) return end_of_text();
  if (block_.head == Head::program) frame.begun = true;
  if (block_.empty()) return State::running;
  frame.begun = true;
  Flow flow;
  if (const Fault fault = executor_.execute(block_, frame.program, line_, queue_, flow))
    return fail(fault, line);
  return go(flow, line);
}

Interpreter::State Interpreter::go(const Flow& flow, std::string_view line) {
  switch (flow.kind) {
    case Flow::Kind::next:
      return State::running;
    case Flow::Kind::end:
      return State::done;
    case Flow::Kind::go_back:
      return return_from_subprogram();
    case Flow::Kind::call:
      break;
  }
  if (depth_ == max_nesting) return fail({AlarmNumber::nesting_too_deep, flow.offset}, line);
  call_ = flow;
  after_call_ = reader_.position();
  for (const Found& known : found_) {
    if (known.caller == frames_[depth_].source && known.number == flow.subprogram) return enter(known);
  }
  not_found_ =
      make_alarm({AlarmNumber::subprogram_missing, block_.offset('P')}, line, frames_[depth_].program, line_);
  reader_.seek(*frames_[depth_].source, {});
  return State::searching;
}

Interpreter::State Interpreter::search_line(Step& step) {
  const TextPosition position = reader_.position();
  TextSource& source = *frames_[depth_].source;
  std::string_view line;
  const LineReader::Status status = reader_.next(line);
  if (status == LineReader::Status::line) {
    if (dialect_.program_head(line) != call_.subprogram) return State::searching;
    return found(source, frames_[depth_].program, position);
  }
  if (status != LineReader::Status::end) return report_line_status(status, step);
  TextSource* const other = environment_.subprogram(ProgramName(call_.subprogram).view());
  if (other != nullptr) return found(*other, call_.subprogram, {});
  alarm_ = not_found_;
  return State::failed;
}

Interpreter::State Interpreter::found(TextSource& source, std::uint32_t program, TextPosition top) {
  Found& entry = found_[next_found_];
  next_found_ = (next_found_ + 1) % found_.size();
  entry = {frames_[depth_].source, call_.subprogram, &source, program, top};
  return enter(entry);
}

Interpreter::State Interpreter::enter(const Found& target) {
  frames_[depth_].resume = after_call_;
  Frame& frame = frames_[++depth_];
  frame = Frame{};
  frame.source = target.source;
  frame.program = target.program;
  frame.top = target.top;
  frame.remaining = call_.repetitions - 1;
  reader_.seek(*frame.source, frame.top);
  return State::running;
}

Interpreter::State Interpreter::return_from_subprogram() {
  Frame& frame = frames_[depth_];
  if (depth_ == 0 || frame.remaining > 0) {
    if (depth_ != 0) --frame.remaining;
    frame.begun = false;
    reader_.seek(*frame.source, frame.top);
    return State::running;
  }
  --depth_;
  reader_.seek(*frames_[depth_].source, frames_[depth_].resume);
  return State::running;
}

Interpreter::State Interpreter::end_of_text() {
  if (depth_ != 0) return fail({AlarmNumber::subprogram_without_end, 0}, {});
  if (const Fault fault = executor_.end_program(0, frames_[0].program, line_, queue_)) return fail(fault, {});
  return State::done;
}

}  // namespace trunnion::language
