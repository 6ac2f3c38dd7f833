// SPDX-License-Identifier: Apache-2.0
#include "program_execution/program_flow.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "canonical/turning_speed.hpp"
#include "language/arc_geometry.hpp"
#include "machine/alarm_constants.hpp"
#include "motion/path_segment.hpp"

namespace trunnion::program_execution {

using language::CommandKind;

namespace {

/// A line of the started program, or of another text with its name; `file` as Alarm::file_name.
std::string place(std::uint32_t program, std::uint32_t line, const language::FileName& file) {
  std::string name;
  if (file.front() != '\0')
    name = std::string(file.data()) + ":";
  else if (program != 0)
    name = std::string(language::ProgramName(program).view()) + ":";
  return name + std::to_string(line);
}

const machine::AlarmDefinition& definition_of(language::AlarmNumber number) {
  return alarm::numbered(static_cast<std::uint32_t>(number));
}

constexpr double least_motion = 0.01;  // mm or degrees

bool is_path(CommandKind kind) {
  return kind == CommandKind::rapid || kind == CommandKind::line || kind == CommandKind::arc;
}

bool moves_axes(CommandKind kind) {
  return is_path(kind) || kind == CommandKind::skip || kind == CommandKind::thread ||
         kind == CommandKind::home;
}

/// What turns the spindle or changes its tool: not on axes whose place is unknown. Clamps and coolant may be
/// needed for the search of the references.
bool needs_references(const language::Command& command) {
  constexpr std::uint32_t clockwise = 3, counterclockwise = 4, tool_change = 6, orientation = 19;
  if (command.kind == CommandKind::tool) return true;
  return command.kind == CommandKind::auxiliary &&
         (command.number == clockwise || command.number == counterclockwise ||
          command.number == tool_change || command.number == orientation);
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
  block_runs_on_ = suppression_used_ = false;
  entry_ = entry;
  search_ = entry.restart.sequence > 0 ? Search::restart : entry.line > 0 ? Search::line : Search::none;
  if (entry.restart.sequence == 0) skips_.clear();
  skips_read_ = 0;
  values_read_ = 0, value_last_ = false;
  lines_at_motion_ = 0, most_lines_ = lines_of_loop;
  place_ = position;
  tapping_ = in_hole_ = text_missing_ = behind_thread_ = false;
  restart_passed_ = restart_in_thread_ = false;
  set_threading(false);
  surface_speed_used_ = initial.spindle_mode == language::SpindleMode::surface;
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

std::string ProgramFlow::zone_error(const AxisValues& from) const {
  const auto* frame = frames_.newest();
  if (machine_ == nullptr || frame == nullptr || !frame->zone().active) return "";
  return machine_->zone_error(from, command_, frame->zone(), offset_.value_or(AxisValues{}));
}

FlowState ProgramFlow::check_way(const AxisValues& from) {
  constexpr auto forbidden = language::AlarmNumber::zone_entered;
  if (const auto error = travel_error(from); !error.empty()) return fail(alarm::travel_limit, error);
  if (const auto error = zone_error(from); !error.empty())
    return fail(forbidden, fmt::format("{}: {}", language::alarm_text(forbidden), error));
  return FlowState::full;
}

FlowState ProgramFlow::push_move() {
  // The drive gives the stream no place before every axis has its reference.
  if (!without_reference_.empty()) return fail_without_reference();
  const auto& from = motion_->end_position();
  if (command_.kind != CommandKind::dwell && command_.kind != CommandKind::read) {
    if (const auto state = check_way(from); state != FlowState::full) return state;
    if (const auto state = ask_guard(from); state != FlowState::full) return state;
  }
  auto move = command_.kind == CommandKind::tap      ? Tapping::line(command_)
              : command_.kind == CommandKind::thread ? thread_line(command_, from)
                                                     : command_;
  if (move.kind == CommandKind::skip) move.kind = CommandKind::line;
  if (move.kind == CommandKind::read) move.kind = CommandKind::dwell;
  const bool own_speed = command_.kind == CommandKind::tap || command_.kind == CommandKind::skip ||
                         command_.kind == CommandKind::thread;
  if (dry_run_feed_ > 0 && !own_speed) {
    move.modal.feed = dry_run_feed_;
    move.modal.feed_mode = language::FeedMode::per_minute;
  } else if (move.modal.feed_mode == language::FeedMode::per_revolution) {
    move.modal.feed *= speed_of_feed(from, move);
    move.modal.feed_mode = language::FeedMode::per_minute;
  }
  const bool taken =
      begins_within() ? motion_->push_from(move, entry_.restart.fraction) : motion_->push(move);
  if (!taken)
    return fail(language::AlarmNumber::feed_not_positive,
                "feed must be above zero (per revolution: with the spindle turning)");
  executing_ = command_.modal;
  if (command_.kind == CommandKind::tap) tap_speed_ = std::max(tap_speed_, stroke_speed(command_));
  have_command_ = false;
  if (on_move) on_move(move);
  return FlowState::full;
}

void ProgramFlow::set_threading(bool threading) {
  threading_ = threading;
  thread_complete_ = false;
  legs_.clear();
  if (threading) legs_.reserve(ThreadPath::most_legs);
}

// The axes are at rest: the guard may take its time.
FlowState ProgramFlow::take_leg() {
  if (!without_reference_.empty()) return fail_without_reference();
  // Behind the last of them another thread would begin, out of phase with this one.
  if (legs_.size() == ThreadPath::most_legs)
    return fail(
        language::AlarmNumber::thread_impossible,
        fmt::format("{}: it has more than {} blocks; end it with G9, or make it of fewer blocks",
                    language::alarm_text(language::AlarmNumber::thread_impossible), ThreadPath::most_legs));
  const auto from = legs_.empty() ? motion_->end_position() : legs_.back().target;
  if (const auto state = check_way(from); state != FlowState::full) return state;
  auto free = ask_guard(from);
  while (free == FlowState::waiting) {
    guard_->begin_call();
    free = ask_guard(from);
  }
  if (free != FlowState::full) return free;
  legs_.push_back(leg_of(command_));
  executing_ = command_.modal;
  have_command_ = false;
  if (on_move) on_move(thread_line(command_, from));
  thread_complete_ = command_.modal.path_control == language::PathControl::exact_stop;
  return FlowState::full;
}

// With G96 the lowest one of the move, so that the feed per revolution is never above F.
double ProgramFlow::speed_of_feed(const AxisValues& from, const language::Command& move) const {
  const auto& modal = move.modal;
  if (modal.spindle_mode != language::SpindleMode::surface) return modal.spindle_speed;
  const auto* frame = frames_.newest();
  const double centre = frame == nullptr ? 0 : frame->total_offset()[language::X];
  double radius = std::max(std::abs(from[language::X] - centre), std::abs(move.target[language::X] - centre));
  if (move.kind == CommandKind::arc) {
    const auto arc = remaining_arc(from);
    for (const double share : language::turning_shares(from, arc, language::X)) {
      if (share < 0) continue;
      const auto point = language::point_on_arc(from, move.target, arc, share);
      radius = std::max(radius, std::abs(point[language::X] - centre));
    }
  }
  return canonical::turning_speed(
      modal.surface_speed, radius,
      canonical::lower_limit(modal.spindle_limit, environment_.highest_spindle_speed()));
}

// The wait before a value is read is made again.
bool ProgramFlow::begins_within() const {
  return entry_.restart.sequence == command_.sequence && entry_.restart.sequence > 0 &&
         command_.kind != CommandKind::read;
}

language::Arc ProgramFlow::remaining_arc(const AxisValues& from) const {
  auto arc = command_.arc;
  if (begins_within())
    arc.sweep = motion::remaining_sweep(from, command_.target, arc, entry_.restart.fraction);
  return arc;
}

FlowState ProgramFlow::ask_guard(const AxisValues& from) {
  if (guard_ == nullptr) return FlowState::full;
  auto move = command_;
  if (move.kind == CommandKind::arc) move.arc = remaining_arc(from);
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

void ProgramFlow::refuse_pending(language::AlarmNumber number, const std::string& why) {
  fail(number, std::string(language::alarm_text(number)) + ": " + why);
}

void ProgramFlow::refuse_thread(language::AlarmNumber number, std::size_t leg) {
  const auto& at = legs_[leg];
  fail(definition_of(number), place(at.program, at.line, interpreter_.file_name(at.program)) + ": " +
                                  std::string(language::alarm_text(number)));
  place_alarm(at.program, at.line);
}

FlowState ProgramFlow::fail(language::AlarmNumber number, std::string_view text) {
  return fail(definition_of(number),
              place(command_.program, command_.line, interpreter_.file_name(command_.program)) + ": " +
                  std::string(text));
}

FlowState ProgramFlow::fail_without_reference() {
  return fail(language::AlarmNumber::axes_without_reference,
              "axes without a reference: " + without_reference_ + ". Home them with G28.2, or in mode REF");
}

// The blocks of a contour with cutter radius compensation, and of a curve, depend on each other: in the
// middle no block by itself gives the position of the tool.
FlowState ProgramFlow::arrive_at_line() {
  const auto& modal = interpreter_.modal();
  if (modal.cutter_side != language::CutterSide::off)
    return fail_search("cutter radius compensation is on here: start before its G41 or G42");
  if (modal.motion == 62) return fail_search("the line is in the middle of a curve (G6.2, G5.2)");
  search_ = Search::none;
  behind_thread_ = coupled_threads_ && command_.kind == CommandKind::thread &&
                   command_.modal.path_control == language::PathControl::continuous;
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
    case language::Step::value:
      return continue_after_read();
    case language::Step::line:
      return arrive_at_line();
    case language::Step::end:
      if (search_ == Search::line) return fail_search("the program ends without reaching this line");
      return FlowState::end;
    case language::Step::alarm: {
      const auto& alarm = interpreter_.alarm();
      auto text = place(alarm.program, alarm.line, alarm.file_name) + ":" + std::to_string(alarm.column) +
                  ": " + alarm.text.data();
      for (std::size_t k = alarm.calls; k-- > 0;)
        text += ", called from " + place(alarm.chain[k].program, alarm.chain[k].line, alarm.chain[k].file);
      fail(definition_of(alarm.number), text);
      placed_alarm_ = alarm;
      return FlowState::alarm;
    }
  }
  return FlowState::waiting;
}

// The axes are at its end, in its frame, and the spindle is coupled no longer.
bool ProgramFlow::pass_done(bool drilling) {
  const bool thread = coupled_threads_ && command_.kind == CommandKind::thread;
  const auto& point = entry_.restart;
  if (search_ != Search::restart || command_.sequence != point.sequence || point.fraction < 1 ||
      !(drilling || thread))
    return false;
  restart_passed_ = true;
  restart_in_thread_ = thread && command_.modal.path_control == language::PathControl::continuous;
  executing_ = command_.modal;
  return true;
}

std::optional<double> ProgramFlow::turning_radius(std::uint32_t sequence, const AxisValues& position) const {
  if (!surface_speed_used_) return std::nullopt;
  const auto* modal = modals_.at(sequence);
  if (modal == nullptr || modal->spindle_mode != language::SpindleMode::surface) return std::nullopt;
  const auto* frame = frames_.at(sequence);
  const double centre = frame == nullptr ? 0 : frame->total_offset()[language::X];
  return std::abs(position[language::X] - centre);
}

// Moves to where the axes are take no time, and motion may make one point of short ones to and fro: a loop of
// these is one without motion.
void ProgramFlow::note_motion() {
  const auto kind = command_.kind;
  bool moves = kind == CommandKind::tap || kind == CommandKind::skip || kind == CommandKind::arc ||
               kind == CommandKind::home || kind == CommandKind::thread || kind == CommandKind::read ||
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
  if (thread_complete_) return FlowState::full;
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
      if (command_.kind == CommandKind::home) home_target_ = command_.target;
      note_motion();
    }
    if (searching()) {
      const bool drilling =
          command_.kind == CommandKind::tap || (in_hole_ && command_.kind == CommandKind::dwell);
      if (search_ == Search::line || command_.sequence < entry_.restart.sequence || pass_done(drilling)) {
        in_hole_ = drilling;
        finish_pending();
        continue;
      }
      // The spindle is no longer coupled to the position in the thread.
      const bool in_thread = !restart_passed_ || (restart_in_thread_ && command_.number == 0);
      if (drilling || (coupled_threads_ && command_.kind == CommandKind::thread && in_thread))
        return fail(language::AlarmNumber::not_resumable);
      search_ = Search::none;
      // A drive that lost its newest cycles repeats the skip moves in them: their results are void.
      drop_later_results();
      const auto& modal = restart_passed_ ? executing_ : command_.modal;
      modals_.clear();
      modals_.add(0, modal);
      motion_->start(entry_.restart.position, modal.transformation, modal.tool_length);
    }
    if (command_.modal.frame != frame_) frames_.add(command_.sequence, interpreter_.frame_of(command_));
    frame_ = command_.modal.frame;
    surface_speed_used_ =
        surface_speed_used_ || command_.modal.spindle_mode == language::SpindleMode::surface;
    suppression_used_ = suppression_used_ || command_.modal.suppressed != 0;
    if (!(*modals_.newest() == command_.modal)) modals_.add(command_.sequence, command_.modal);
    const bool stroke =
        command_.kind == CommandKind::tap || (tapping_ && command_.kind == CommandKind::dwell);
    const bool thread = command_.kind == CommandKind::thread;
    const bool coupled = thread && coupled_threads_;
    const bool continues = coupled && command_.number == 0;
    const bool move =
        is_path(command_.kind) || command_.kind == CommandKind::dwell || stroke || (thread && !coupled);
    if (!tap_in_hole_.empty() && !tapping_ && moves_axes(command_.kind))
      return fail(language::AlarmNumber::tap_removal_thread,
                  fmt::format("{}: {}", language::alarm_text(language::AlarmNumber::tap_removal_thread),
                              tap_in_hole_));
    if (std::exchange(behind_thread_, false) && continues)
      return fail_search("the line continues a thread: start before the first block of it");
    if (threading_ && !continues && !(coupled && legs_.empty())) {
      thread_complete_ = true;
      return FlowState::full;
    }
    if (single_block && block_line_ != 0 && command_.line != block_line_ && !threading_ && !block_runs_on_) {
      motion_->finish();
      return FlowState::block_end;
    }
    block_line_ = command_.line;
    block_runs_on_ = (command_.modal.suppressed & canonical::no_single_block) != 0;
    if (thread && machine_ != nullptr && !machine_->tapping_spindle().axis)
      return fail(language::AlarmNumber::tapping_spindle_missing);
    if (threading_) {
      if (const auto state = take_leg(); state == FlowState::alarm) return state;
      if (thread_complete_) return FlowState::full;
      continue;
    }
    if (!move || stroke != tapping_) {
      if (command_.kind == CommandKind::skip || stroke || coupled) executing_ = command_.modal;
      motion_->finish();
      if (!without_reference_.empty() && needs_references(command_)) return fail_without_reference();
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
