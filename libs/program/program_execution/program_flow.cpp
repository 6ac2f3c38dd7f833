// SPDX-License-Identifier: Apache-2.0
#include "program_execution/program_flow.hpp"

#include <algorithm>
#include <cmath>

#include "machine/alarm_constants.hpp"
#include "motion/path_segment.hpp"

namespace trunnion::program_execution {

using language::CommandKind;

namespace {

/// A line of the started program, or of another text with its name.
std::string place(std::uint32_t program, std::uint32_t line) {
  std::string name;
  if (program != 0) name = std::string(language::ProgramName(program).view()) + ":";
  return name + std::to_string(line);
}

const machine::AlarmDefinition& definition_of(language::AlarmNumber number) {
  return alarm::numbered(static_cast<std::uint32_t>(number));
}

constexpr double least_motion = 0.01;  // mm or degrees

bool is_path(CommandKind kind) {
  return kind == CommandKind::rapid || kind == CommandKind::line || kind == CommandKind::arc;
}

}  // namespace

void ProgramFlow::start(motion::MoveTaker& motion, language::TextSource& text, const AxisValues& position,
                        const language::ModalState& initial, const language::VariableStore& variables,
                        const Entry& entry, language::Beginning beginning) {
  motion_ = &motion;
  if (guard_ != nullptr) guard_->begin_run();
  interpreter_.start(text, position, initial, variables, beginning);
  interpreter_.stop_before_line(entry.line);
  have_command_ = false;
  block_line_ = 0;
  entry_ = entry;
  search_ = entry.restart.sequence > 0 ? Search::restart : entry.line > 0 ? Search::line : Search::none;
  if (entry.restart.sequence == 0) skips_.clear();
  skips_read_ = 0;
  lines_at_motion_ = 0, most_lines_ = lines_of_loop;
  place_ = position;
  tapping_ = in_hole_ = text_missing_ = false;
  executing_ = initial;
  frames_.clear();
  modals_.clear();
  modals_.add(0, initial);
  auxiliaries_.clear();
  const bool rtcp = initial.transformation == language::Transformation::rtcp;
  extent_ = channel_setup::AxisBox::of(rtcp ? environment_.machine_from_tip(position, initial.tool_length)
                                            : position);
  alarm_ = nullptr;
  alarm_text_.clear();
  placed_alarm_ = {};
}

// The text behind the place, as far as there is room.
void ProgramFlow::place_alarm(std::uint32_t program, std::uint32_t line) {
  placed_alarm_ = {};
  placed_alarm_.number = static_cast<language::AlarmNumber>(alarm_number());
  placed_alarm_.program = program;
  placed_alarm_.line = line;
  std::string_view words(alarm_text_);
  if (const auto colon = words.find(": "); colon != std::string_view::npos) words.remove_prefix(colon + 2);
  std::copy_n(words.begin(), std::min(words.size(), placed_alarm_.text.size() - 1),
              placed_alarm_.text.begin());
}

FlowState ProgramFlow::fail(const machine::AlarmDefinition& alarm, const std::string& text) {
  alarm_ = &alarm;
  alarm_text_ = text;
  place_alarm(command_.program, command_.line);
  motion_->finish();
  return FlowState::alarm;
}

FlowState ProgramFlow::fail_search(const std::string& why) {
  fail(alarm::search_failed, std::to_string(entry_.line) + ": " + why);
  place_alarm(0, entry_.line);
  return FlowState::alarm;
}

std::string ProgramFlow::travel_error(const AxisValues& from) {
  if (machine_ == nullptr) return "";
  if (!offset_) return machine_->travel_error(from, command_);
  const auto extent = channel_setup::extent_of(from, command_, machine_->chain());
  auto error = machine_->travel_error(extent, *offset_, command_.line);
  if (error.empty()) extent_.include(extent);
  return error;
}

FlowState ProgramFlow::push_move() {
  const auto& from = motion_->end_position();
  if (command_.kind != CommandKind::dwell) {
    if (const auto error = travel_error(from); !error.empty()) return fail(alarm::travel_limit, error);
    if (const auto state = ask_guard(from); state != FlowState::full) return state;
  }
  auto move = command_.kind == CommandKind::tap ? Tapping::line(command_) : command_;
  if (move.kind == CommandKind::skip) move.kind = CommandKind::line;
  if (dry_run_feed_ > 0 && command_.kind != CommandKind::tap && command_.kind != CommandKind::skip) {
    move.modal.feed = dry_run_feed_;
    move.modal.feed_mode = language::FeedMode::per_minute;
  } else if (move.modal.feed_mode == language::FeedMode::per_revolution) {
    move.modal.feed *= move.modal.spindle_speed;
    move.modal.feed_mode = language::FeedMode::per_minute;
  }
  const bool partly = entry_.restart.sequence == command_.sequence && entry_.restart.sequence > 0;
  const bool taken = partly ? motion_->push_from(move, entry_.restart.fraction) : motion_->push(move);
  if (!taken)
    return fail(language::AlarmNumber::feed_not_positive,
                "feed must be above zero (per revolution: with the spindle turning)");
  executing_ = command_.modal;
  have_command_ = false;
  if (on_move) on_move(move);
  return FlowState::full;
}

// The circle of a restart in the middle of an arc is what is left of it.
FlowState ProgramFlow::ask_guard(const AxisValues& from) {
  if (guard_ == nullptr) return FlowState::full;
  auto move = command_;
  if (entry_.restart.sequence == command_.sequence && entry_.restart.sequence > 0 &&
      move.kind == CommandKind::arc)
    move.arc.sweep = motion::remaining_sweep(from, move.target, move.arc, entry_.restart.fraction);
  switch (guard_->check(from, move)) {
    case MoveGuard::Verdict::free:
      return FlowState::full;
    case MoveGuard::Verdict::unfinished:
      return FlowState::waiting;
    case MoveGuard::Verdict::contact:
      break;
  }
  return fail(alarm::bodies_would_meet, guard_->contact_text());
}

// The axes are at rest: the guard may take its time.
FlowState ProgramFlow::push_pending() {
  auto state = FlowState::waiting;
  while (state == FlowState::waiting) {
    if (guard_ != nullptr) guard_->begin_call();
    state = push_move();
  }
  motion_->finish();
  return state;
}

void ProgramFlow::refuse_pending(language::AlarmNumber number) { fail(number); }

FlowState ProgramFlow::fail(language::AlarmNumber number, std::string_view text) {
  return fail(definition_of(number), place(command_.program, command_.line) + ": " + std::string(text));
}

// A skip move has ended, now or before the restart: the interpreter continues from where it ended.
FlowState ProgramFlow::continue_after_skip() {
  if (search_ == Search::line)
    return fail_search("line " + std::to_string(command_.line) +
                       " measures (G31), and what follows depends on it");
  if (skips_read_ == skips_.size()) return fail(language::AlarmNumber::not_resumable);
  interpreter_.set_position(skips_[skips_read_].stopped, skips_[skips_read_].touched);
  ++skips_read_;
  return FlowState::full;
}

// A call that is only searched for a restart or a line is not answered again: the service has gone on.
FlowState ProgramFlow::fail_after_cycle() {
  if (search_ == Search::line)
    return fail_search(
        "a cycle of another service is called before it, and what follows depends on its answer");
  return fail(language::AlarmNumber::not_resumable,
              "a program behind a cycle of another service cannot be resumed: reset and start again");
}

// The blocks of a contour with cutter radius compensation, and of a curve, depend on each other: in the
// middle no block by itself gives the position of the tool.
FlowState ProgramFlow::arrive_at_line() {
  const auto& modal = interpreter_.modal();
  if (modal.cutter_side != language::CutterSide::off)
    return fail_search("cutter radius compensation is on here: start before its G41 or G42");
  if (modal.motion == 62) return fail_search("the line is in the middle of a curve (G6.2)");
  search_ = Search::none;
  executing_ = modal;
  modals_.clear();
  modals_.add(0, modal);
  const bool rtcp = modal.transformation == language::Transformation::rtcp;
  extent_ = channel_setup::AxisBox::of(rtcp ? environment_.machine_from_tip(position(), modal.tool_length)
                                            : position());
  return FlowState::found;
}

// Handles a step that may have brought no command. Full: continue.
FlowState ProgramFlow::take_step(language::Step step) {
  switch (step) {
    case language::Step::command:
      have_command_ = true;
      return FlowState::full;
    case language::Step::working:
      return FlowState::waiting;
    case language::Step::pending:
      text_missing_ = true;
      return FlowState::waiting;
    case language::Step::position:
      return continue_after_skip();
    case language::Step::answer:
      return fail_after_cycle();
    case language::Step::line:
      return arrive_at_line();
    case language::Step::end:
      if (search_ == Search::line) return fail_search("the program ends without reaching this line");
      return FlowState::end;
    case language::Step::alarm: {
      const auto& alarm = interpreter_.alarm();
      auto text =
          place(alarm.program, alarm.line) + ":" + std::to_string(alarm.column) + ": " + alarm.text.data();
      for (std::size_t k = alarm.calls; k-- > 0;)
        text += ", called from " + place(alarm.chain[k].program, alarm.chain[k].line);
      fail(definition_of(alarm.number), text);
      placed_alarm_ = alarm;
      return FlowState::alarm;
    }
  }
  return FlowState::waiting;
}

// Moves to where the axes are take no time, and motion may make one point of short ones to and fro: a loop of
// these is one without motion.
void ProgramFlow::note_motion() {
  const auto kind = command_.kind;
  bool moves = kind == CommandKind::tap || kind == CommandKind::skip || kind == CommandKind::arc ||
               (kind == CommandKind::dwell && command_.dwell_seconds > 0);
  for (std::size_t i = 0; i < place_.size() && is_path(kind); ++i)
    moves = moves || std::abs(command_.target[i] - place_[i]) > least_motion;
  if (moves || kind == CommandKind::transformation) place_ = command_.target;
  if (!moves) return;
  lines_at_motion_ = interpreter_.lines();
  most_lines_ = lines_of_loop;
}

FlowState ProgramFlow::fill(bool single_block) {
  text_missing_ = false;
  if (alarm_ != nullptr) return FlowState::alarm;
  if (guard_ != nullptr) guard_->begin_call();
  // A long search for the restart point must leave time for messages.
  constexpr int most_commands = 4096;
  const auto last_line = interpreter_.lines() + lines_of_loop;
  for (int i = 0; i < most_commands; ++i) {
    if (!searching() && !motion_->can_accept()) return FlowState::full;
    if (!have_command_) {
      if (lines_without_motion() >= most_lines_) {
        motion_->finish();
        return FlowState::loop;
      }
      if (interpreter_.lines() >= last_line) return FlowState::waiting;
      const auto step = interpreter_.next(command_);
      if (step == language::Step::working) continue;
      if (const auto state = take_step(step); state != FlowState::full) return state;
      if (!have_command_) continue;
      note_motion();
    }
    if (searching()) {
      const bool drilling =
          command_.kind == CommandKind::tap || (in_hole_ && command_.kind == CommandKind::dwell);
      if (search_ == Search::line || command_.sequence < entry_.restart.sequence) {
        in_hole_ = drilling;
        finish_pending();
        continue;
      }
      // The spindle is no longer coupled to the position in the thread.
      if (drilling) return fail(language::AlarmNumber::not_resumable);
      search_ = Search::none;
      // A drive that lost its newest cycles repeats the skip moves in them: their results are void.
      skips_.resize(skips_read_);
      modals_.clear();
      modals_.add(0, command_.modal);
      motion_->start(entry_.restart.position, command_.modal.transformation, command_.modal.tool_length);
    }
    if (command_.modal.frame != frame_) frames_.add(command_.sequence, interpreter_.frame_of(command_));
    frame_ = command_.modal.frame;
    if (!(*modals_.newest() == command_.modal)) modals_.add(command_.sequence, command_.modal);
    const bool stroke =
        command_.kind == CommandKind::tap || (tapping_ && command_.kind == CommandKind::dwell);
    const bool move = is_path(command_.kind) || command_.kind == CommandKind::dwell || stroke;
    if (single_block && block_line_ != 0 && command_.line != block_line_) {
      motion_->finish();
      return FlowState::block_end;
    }
    block_line_ = command_.line;
    if (!move || stroke != tapping_) {
      if (command_.kind == CommandKind::skip || stroke) executing_ = command_.modal;
      motion_->finish();
      return command_.kind == CommandKind::end && command_.number == 0 ? FlowState::end : FlowState::command;
    }
    const auto state = push_move();
    if (state == FlowState::alarm) return state;
    // The same moves are checked in the same cycles whatever the computer's speed: motion goes on
    // meanwhile.
    if (state == FlowState::waiting) return FlowState::full;
  }
  return FlowState::waiting;
}

}  // namespace trunnion::program_execution
