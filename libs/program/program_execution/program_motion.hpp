// SPDX-License-Identifier: Apache-2.0
// What the moves of a whole program go to.
#pragma once

#include "motion/limits.hpp"
#include "motion/move_taker.hpp"
#include "motion/programmed_move.hpp"

namespace trunnion::program_execution {

using canonical::AxisValues;

class ProgramFlow;

/// Takes the moves that a ProgramReader reads, and carries them out when it can.
class ProgramMotion {
 public:
  virtual ~ProgramMotion() = default;
  virtual motion::MoveTaker& moves() = 0;
  /// `flow` is about to give moves; `tapping`: as strokes of a tap.
  virtual void prepare(ProgramFlow& flow, bool tapping) = 0;
  /// All moves are done.
  virtual bool at_rest() const = 0;
  /// One cycle, while it is not at rest. False ends the reading.
  virtual bool step() = 0;
  /// Where the axes are, in the frame of the newest MoveTaker::start().
  virtual const AxisValues& position() const = 0;
  /// Other limits, from the next MoveTaker::start() on.
  virtual void set_limits(const motion::Limits& limits) = 0;
};

/// Moves nothing: each move that motion would take is done at once.
class MotionlessProgram final : public ProgramMotion, private motion::MoveTaker {
 public:
  /// Judges the numbers of each move.
  MotionlessProgram(const motion::Limits& limits, double cycle_seconds)
      : limits_(&limits), cycle_seconds_(cycle_seconds) {}
  /// Takes every move.
  MotionlessProgram() = default;

  motion::MoveTaker& moves() override { return *this; }
  void prepare(ProgramFlow&, bool) override {}
  bool at_rest() const override { return true; }
  bool step() override { return true; }
  const AxisValues& position() const override { return end_; }
  void set_limits(const motion::Limits&) override {}

 private:
  void start(const AxisValues& position, canonical::Transformation transformation, double) override {
    end_ = position;
    transformed_ = transformation == canonical::Transformation::rtcp;
  }
  bool can_accept() const override { return true; }
  bool push(const canonical::Command& command) override { return push_from(command, 0); }
  bool push_from(const canonical::Command& command, double fraction) override {
    if (limits_ != nullptr &&
        !motion::programmed_move(command, end_, fraction, *limits_, transformed_, cycle_seconds_))
      return false;
    if (command.kind != canonical::CommandKind::dwell) end_ = command.target;
    return true;
  }
  void finish() override {}
  const AxisValues& end_position() const override { return end_; }

  const motion::Limits* limits_ = nullptr;
  double cycle_seconds_ = 0;
  AxisValues end_{};
  bool transformed_ = false;
};

}  // namespace trunnion::program_execution
