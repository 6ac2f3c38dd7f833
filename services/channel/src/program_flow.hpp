// Pulls commands out of the interpreter and feeds them to motion; stops where something else has to happen
// first.
#pragma once

#include <optional>

#include "language/interpreter.hpp"
#include "motion/trajectory.hpp"
#include "setup/channel_setup.hpp"
#include "skip_move.hpp"
#include "tapping.hpp"

namespace trunnion::channel {

using language::AxisValues;

enum class FlowState {
  full,       ///< motion has as much ahead as it can hold: go on stepping
  waiting,    ///< the text has to arrive first: do not step, or the motion would depend on when it does
  command,    ///< pending() needs the axes at rest and somebody's attention
  block_end,  ///< single block: the block's motion is all there is
  end,        ///< program finished
  alarm,      ///< alarm_number(), alarm_text()
};

/// The point of a program at which a restart goes on.
struct RestartPoint {
  std::uint32_t sequence = 0;  ///< command being executed; 0 = from the beginning
  double fraction = 0;         ///< of it that is done
  AxisValues position{};       ///< where the path was left, in the frame of that command
};

class ProgramFlow {
 public:
  ProgramFlow(setup::ChannelSetup& machine, motion::Trajectory*& trajectory)
      : machine_(machine), trajectory_(trajectory), interpreter_(machine) {}

  /// `position` in the frame of `initial`. The trajectory must be at rest there. A restart needs the
  /// variables the program began with, for it interprets it again.
  void start(language::TextSource& text, const AxisValues& position, const language::ModalState& initial,
             const language::VariableStore& variables, const RestartPoint& restart = {});
  FlowState fill(bool single_block);
  /// The command fill() stopped at, and done with it.
  const language::Command& pending() const { return command_; }
  void finish_pending() { have_command_ = false; }
  /// Single block: the next block may begin.
  void next_block() { block_line_ = 0; }

  /// Hands the pending move to motion, whose last it is. FlowState::alarm, or full.
  FlowState push_pending();
  /// The pending command cannot be carried out: fill() gives FlowState::alarm from now on.
  void refuse_pending(language::AlarmNumber number);
  /// Rigid tapping has been begun or ended: strokes and the dwells between them are moves meanwhile.
  void set_tapping(bool tapping) { tapping_ = tapping; }
  /// Where the pending skip move ended; the interpreter goes on from there. A restart of the program reads
  /// the results again.
  void skip_ended(const SkipResult& result) { skips_.push_back(result); }
  const std::vector<SkipResult>& skips() const { return skips_; }
  /// The results a program had before this process; after start().
  void set_skips(std::vector<SkipResult> skips) { skips_ = std::move(skips); }

  const language::ModalState& modal() const { return interpreter_.modal(); }
  /// The variables as the program has left them.
  const language::VariableStore& variables() const { return interpreter_.variables(); }
  /// What the program's clocks show from now on, in cycles of the stream.
  void set_cycle(std::uint64_t cycle) {
    const double milliseconds = static_cast<double>(cycle) * machine_.cycle_seconds() * 1000;
    interpreter_.set_time({milliseconds, milliseconds / 3.6e6, 0, 0});
  }
  /// Of the newest command handed to motion.
  const language::ModalState& executing() const { return executing_; }
  std::uint32_t alarm_number() const { return alarm_number_; }
  const std::string& alarm_text() const { return alarm_text_; }
  /// Commands up to the restart point are being skipped.
  bool searching() const { return searching_; }

 private:
  FlowState push_move();
  FlowState fail(language::AlarmNumber number);
  setup::ChannelSetup& machine_;
  motion::Trajectory*& trajectory_;
  language::Interpreter interpreter_;
  language::Command command_;
  language::ModalState executing_;
  bool have_command_ = false;
  std::uint32_t block_line_ = 0;
  RestartPoint restart_;
  bool searching_ = false;
  bool tapping_ = false, in_hole_ = false, refused_ = false;
  std::vector<SkipResult> skips_;
  std::size_t skips_read_ = 0;

  std::uint32_t alarm_number_ = 0;
  std::string alarm_text_;
};

}  // namespace trunnion::channel
