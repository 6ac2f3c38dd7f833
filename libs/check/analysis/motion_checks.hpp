// SPDX-License-Identifier: Apache-2.0
// Warnings that the moves of a program give.
#pragma once

#include <optional>

#include "analysis/block_checks.hpp"
#include "analysis/motion_tracker.hpp"
#include "analysis/warnings.hpp"

namespace trunnion::analysis {

class MotionChecks {
 public:
  /// `lengths_known`: the tool table of `environment` is that of the machine. All must outlive the checks;
  /// `blocks` has seen the block of each command.
  MotionChecks(const language::Environment& environment, bool lengths_known, const BlockChecks& blocks,
               Warnings& warnings);

  /// `from` is where the command begins, in its frame; `motion` what it moves, if it does.
  void see(const language::Command& command, const language::AxisValues& from,
           const std::optional<Motion>& motion);
  /// The program has ended, `whole` without an alarm.
  void end(bool whole);

 private:
  WarningPlace place(const language::Command& command) const;
  void check_stated(const language::Command& command);
  void check_feed(const language::Command& command);
  void check_spindle(const language::Command& command);
  void check_length(const language::Command& command, double down);
  void check_tip(const language::Command& command, const language::AxisValues& from);
  void check_rapid(const language::Command& command, const language::AxisValues& from, const Motion& motion);
  void note_cut(const language::Command& command, const language::AxisValues& from, const Motion& motion);

  const language::Environment& environment_;
  const BlockChecks& blocks_;
  Warnings& warnings_;
  bool lengths_known_ = false, several_rotary_ = false;
  bool ended_ = false;  // by M30 or M2
  bool head_checked_ = false, first_feed_seen_ = false, probes_ = false;
  std::optional<WarningPlace> without_spindle_;
  std::uint16_t tool_ = 0;
  bool length_seen_ = false;  // since this tool is in the spindle
  bool cut_ = false;
  std::uint8_t cut_offset_ = 0;
  double cut_level_ = 0;  // mm above the zero of the workpiece: the highest one of a move at feed
};

}  // namespace trunnion::analysis
