// SPDX-License-Identifier: Apache-2.0
// Takes commands from the interpreter and gives them to motion; stops where something else has to happen
// first. The channel, the planner without a cluster and the checks all run programs through it: motions agree
// bit for bit, and so do alarms.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "channel_setup/channel_setup.hpp"
#include "language/interpreter.hpp"
#include "machine/alarm_definition.hpp"
#include "motion/move_taker.hpp"
#include "program_execution/auxiliary_memory.hpp"
#include "program_execution/command_trail.hpp"
#include "program_execution/move_guard.hpp"
#include "program_execution/skip_result.hpp"
#include "program_execution/tapping.hpp"
#include "program_execution/thread_path.hpp"

namespace trunnion::program_execution {

using language::AxisValues;

enum class FlowState {
  full,       ///< motion has as much ahead as it can hold: continue stepping
  waiting,    ///< the text has to arrive first: do not step, or the motion would depend on when it does
  command,    ///< pending() needs the axes at rest and is carried out by the caller
  block_end,  ///< single block: the block's motion is all there is
  loop,       ///< lines_of_loop and more lines without a motion: at rest read_on() continues with them
  found,      ///< the line to start from comes next: executing() and position() are the state it begins in
  end,        ///< program finished
  alarm,      ///< alarm(), alarm_text(); until the next start()
};

/// The point of a program from which a restart continues.
struct RestartPoint {
  std::uint32_t sequence = 0;  ///< command being executed; 0 = from the beginning
  double fraction = 0;         ///< of it that is done
  AxisValues position{};       ///< where the path was left, in the frame of that command
};

/// Where a program begins: at a restart point, before a line, or at its top.
struct Entry {
  RestartPoint restart;
  std::uint32_t line = 0;  ///< from 1; 0 = none
};

/// Lines without a motion before which motion does not go on; behind them the path ends with a stop, since
/// the program may repeat them for ever. Fewer than can be read while the lead lasts.
inline constexpr std::uint64_t lines_of_loop = 20000;

class ProgramFlow {
 public:
  /// `machine` must outlive the flow.
  explicit ProgramFlow(channel_setup::ChannelSetup& machine, language::InterpreterOptions options = {})
      : environment_(machine), machine_(&machine), interpreter_(machine, options) {}
  /// Of a machine without travel: no offset may be set.
  explicit ProgramFlow(language::Environment& environment, language::InterpreterOptions options = {})
      : environment_(environment), interpreter_(environment, options) {}

  /// Sees every move as motion has got it, pending() as the program has it; may be empty.
  std::function<void(const language::Command&)> on_move;

  /// Looks at every move before motion gets it, and must outlive the flow; null: nobody does.
  void set_guard(MoveGuard* guard) { guard_ = guard; }

  /// What holds for the next start.
  void set_block_skip(language::SkipLevels levels) { interpreter_.set_block_skip(levels); }
  /// Feeds of the program are replaced by this one, mm/min; 0 = they are not.
  void set_dry_run_feed(double feed) { dry_run_feed_ = feed; }
  /// Machine coordinates that are added to the path, or may be: travel is checked with them, and extent() is
  /// kept. Nothing when there are none.
  void set_offset(const std::optional<AxisValues>& offset) { offset_ = offset; }

  /// Names of the axes that have no reference: a move, a turn of the spindle and a tool change are then
  /// alarms. Empty: all have theirs.
  void set_without_reference(std::string_view axes) { without_reference_.assign(axes); }
  /// What the operator is told of a tap that is in its hole, where the axes are at the start: then no move
  /// but its removal may begin. Empty: there is none, or it has come out.
  void set_tap_in_hole(std::string words) { tap_in_hole_ = std::move(words); }
  /// As Interpreter::set_parts().
  void set_parts(double parts) { interpreter_.set_parts(parts); }
  /// As Interpreter::set_homed().
  void set_homed(std::optional<std::uint16_t> axes) { interpreter_.set_homed(axes); }

  /// Ends a program where `watch` finds that it repeats for ever: Interpreter::watch_loops().
  void watch_loops(language::EndlessLoop* watch) { interpreter_.watch_loops(watch); }

  /// As Interpreter::watch_blocks().
  void watch_blocks(language::BlockWatch* watch) { interpreter_.watch_blocks(watch); }

  /// `motion` takes the moves and must be at rest at `position`, in the frame of `initial`; it and `text`
  /// must outlive the run, which ends with the next start(). A restart needs the variables the program began
  /// with, because it interprets the program again.
  void start(motion::MoveTaker& motion, language::TextSource& text, const AxisValues& position,
             const language::ModalState& initial, const language::VariableStore& variables,
             const Entry& entry = {}, language::Beginning beginning = language::Beginning::program);
  bool started() const { return motion_ != nullptr; }
  /// Only after start(). Reads until one of the states is reached, at most some thousand commands.
  FlowState fill(bool single_block);
  /// The command fill() stopped at, and done with it.
  const language::Command& pending() const { return command_; }
  void finish_pending() {
    auxiliaries_.pass(command_);
    have_command_ = false;
  }
  /// FlowState::loop: the next fill() reads some thousand lines more.
  void read_on() { most_lines_ = lines_without_motion() + lines_per_read; }
  /// Read since the newest command that moves an axis or lets time pass.
  std::uint64_t lines_without_motion() const { return interpreter_.lines() - lines_at_motion_; }
  /// The lines being read may repeat for ever.
  bool loops() const { return lines_without_motion() >= lines_of_loop; }
  /// Single block: the next block may begin.
  void next_block() { block_line_ = 0; }

  /// Gives the pending move to motion as the last one before a stop. FlowState::alarm, or full.
  FlowState push_pending();
  /// The pending command cannot be carried out: FlowState::alarm.
  void refuse_pending(language::AlarmNumber number);
  /// `why` follows the text of the alarm.
  void refuse_pending(language::AlarmNumber number, const std::string& why);
  /// Rigid tapping has started or ended: strokes and the dwells between them are moves meanwhile.
  void set_tapping(bool tapping) { tapping_ = tapping, tap_speed_ = 0; }
  /// The highest speed of the spindle in the strokes that motion has got since, 1/min.
  double tap_speed() const { return tap_speed_; }
  /// Threads follow the spindle: FlowState::command comes before one; else they are lines that motion gets.
  void set_coupled_threads(bool coupled) { coupled_threads_ = coupled; }
  /// Called at rest, with a thread pending: fill() then collects it, and those that continue it, in legs() up
  /// to another command, an exact stop or the most legs, and gives motion nothing. Off: legs() are done.
  void set_threading(bool threading);
  const std::vector<ThreadLeg>& legs() const { return legs_; }
  /// One of them cannot be cut: FlowState::alarm.
  void refuse_thread(language::AlarmNumber number, std::size_t leg);
  /// Where the pending skip move ended; the interpreter continues from there. A restart of the program reads
  /// the results again.
  void skip_ended(const SkipResult& result) { skips_.push_back(result); }
  /// The pending search for references has ended at `position`; the interpreter continues from there. A
  /// restart of the program reads it again, as the results of skip moves.
  void home_ended(const AxisValues& position);
  /// The pending call of a cycle was answered.
  void cycle_answered(double value) {
    interpreter_.answer(value);
    finish_pending();
  }
  /// Where time has passed for the pending reading of a value: what the drive says. A restart of the program
  /// reads it again.
  void value_read(double value);
  /// While a call of a cycle is pending: the local variables of the macro that calls, the line of the started
  /// program, and the modal state it is called in.
  const std::array<language::Value, language::local_variables>& locals() const {
    return interpreter_.locals();
  }
  std::uint32_t main_line() const { return interpreter_.main_line(); }
  const std::vector<SkipResult>& skips() const { return skips_; }
  /// The results a program had before this process; after start().
  void set_skips(std::vector<SkipResult> skips) { skips_ = std::move(skips); }

  const language::Interpreter& interpreter() const { return interpreter_; }
  const language::ModalState& modal() const { return interpreter_.modal(); }
  /// Where the blocks read so far end, in the frame of modal().
  const AxisValues& position() const { return interpreter_.position(); }
  /// The variables as the program has left them.
  const language::VariableStore& variables() const { return interpreter_.variables(); }
  /// The time the program's clock variables show from now on, in cycles of the machine's stream.
  void set_cycle(std::uint64_t cycle) {
    const double milliseconds = static_cast<double>(cycle) * machine_->cycle_seconds() * 1000;
    interpreter_.set_time({milliseconds, milliseconds / 3.6e6, 0, 0});
  }
  /// The coordinate frames in which the commands since the start were programmed.
  const FrameTrail& frames() const { return frames_; }
  /// Their modal states; behind start() or a found line that in which the program begins.
  const ModalTrail& modals() const { return modals_; }
  /// A command since the start, or the state it began in, had a constant surface speed (G96).
  bool surface_speed_used() const { return surface_speed_used_; }
  /// A command since the start keeps something from acting on it (ModalState::suppressed).
  bool suppression_used() const { return suppression_used_; }
  /// mm from the centre of the spindle, X = 0 of the workpiece, of `position` in the command `sequence`;
  /// nothing without G96.
  std::optional<double> turning_radius(std::uint32_t sequence, const AxisValues& position) const;
  /// Of the newest command handed to motion.
  const language::ModalState& executing() const { return executing_; }
  /// The spindle and coolant functions of the commands that are done or were skipped.
  const AuxiliaryMemory& auxiliaries() const { return auxiliaries_; }
  /// Machine coordinates the moves handed to motion go through, since the start with an offset.
  const channel_setup::AxisBox& extent() const { return extent_; }
  /// Of FlowState::alarm; its number is 0 before.
  const machine::AlarmDefinition& alarm() const { return *alarm_; }
  std::uint32_t alarm_number() const { return alarm_ == nullptr ? 0 : alarm_->number; }
  const std::string& alarm_text() const { return alarm_text_; }
  /// The alarm with its place, of all kinds; the column is 0 when no text is at fault but what it makes the
  /// machine do, and then the chain of calls is not known.
  const language::Alarm& placed_alarm() const { return placed_alarm_; }
  /// Commands up to the restart point, or the line, are being skipped.
  bool searching() const { return search_ != Search::none; }
  /// The last FlowState::waiting was for the text; otherwise fill() has only done enough for one call.
  bool text_missing() const { return text_missing_; }

 private:
  static constexpr std::uint64_t lines_per_read = 8000;
  enum class Search : std::uint8_t { none, restart, line };
  void note_motion();
  /// Empty, or the line of the axis that the pending move would take out of its travel.
  std::string travel_error(const AxisValues& from);
  /// Empty, or how it would come where the zone of its frame forbids.
  std::string zone_error(const AxisValues& from) const;
  /// Full: neither travel nor zone stops the pending move. Else alarm.
  FlowState check_way(const AxisValues& from);
  FlowState push_move();
  /// 1/min that a feed per revolution of `move` from `from` counts with.
  double speed_of_feed(const AxisValues& from, const language::Command& move) const;
  /// The pending command is that of the restart, which begins in the middle of it.
  bool begins_within() const;
  /// The circle of the pending arc, from where it begins.
  language::Arc remaining_arc(const AxisValues& from) const;
  FlowState fail_without_reference();
  /// Full: motion may have the pending move. Waiting: the guard has not finished. Else alarm.
  FlowState ask_guard(const AxisValues& from);
  FlowState take_step(language::Step step);
  FlowState take_leg();
  /// Nothing of a stroke or a thread is left to do at the restart point: the search passes it.
  bool pass_done(bool drilling);
  FlowState arrive_at_line();
  FlowState fail(const machine::AlarmDefinition& alarm, const std::string& text);
  FlowState fail(language::AlarmNumber number, std::string_view text);
  FlowState fail(language::AlarmNumber number) { return fail(number, language::alarm_text(number)); }
  FlowState fail_search(const std::string& why);
  void place_alarm(std::uint32_t program, std::uint32_t line);
  FlowState continue_after_skip();
  FlowState fail_after_cycle();
  FlowState continue_after_read();
  void drop_later_results();
  language::Environment& environment_;
  const channel_setup::ChannelSetup* machine_ = nullptr;
  motion::MoveTaker* motion_ = nullptr;  // of the run
  MoveGuard* guard_ = nullptr;
  language::Interpreter interpreter_;
  language::Command command_;
  language::ModalState executing_;
  FrameTrail frames_;
  ModalTrail modals_;
  std::uint32_t frame_ = 0;  // of the newest of them
  AuxiliaryMemory auxiliaries_;
  channel_setup::AxisBox extent_;
  std::optional<AxisValues> offset_;
  double dry_run_feed_ = 0;
  bool have_command_ = false;
  std::uint32_t block_line_ = 0;
  bool block_runs_on_ = false;  // single block does not stop behind it (#3003)
  Entry entry_;
  Search search_ = Search::none;
  bool restart_passed_ = false;     // the stroke or thread of the restart point is done
  bool restart_in_thread_ = false;  // and what continues it would be the same thread
  bool tapping_ = false, in_hole_ = false, text_missing_ = false;
  double tap_speed_ = 0;
  bool coupled_threads_ = false, threading_ = false, thread_complete_ = false;
  bool behind_thread_ = false;  // the line to start from may continue one
  std::vector<ThreadLeg> legs_;
  bool surface_speed_used_ = false, suppression_used_ = false;
  std::uint64_t lines_at_motion_ = 0, most_lines_ = lines_of_loop;
  AxisValues place_{};        // where the newest motion ends
  AxisValues home_target_{};  // of the newest search for references
  std::string without_reference_, tap_in_hole_;
  std::vector<SkipResult> skips_;
  std::size_t skips_read_ = 0;
  double values_read_ = 0;   // of the equal values that the next result is
  bool value_last_ = false;  // the result before it is one of equal values

  const machine::AlarmDefinition* alarm_ = nullptr;
  std::string alarm_text_;
  language::Alarm placed_alarm_;
};

}  // namespace trunnion::program_execution
