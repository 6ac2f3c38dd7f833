// SPDX-License-Identifier: Apache-2.0
// The check at an exact stop (G9, G61): the program continues when every axis of the channel is in position.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "contracts/types.hpp"
#include "machine/axes.hpp"
#include "motion/trajectory.hpp"

namespace trunnion::channel {

/// Parameters 010166 (longest time, 0 = no check) and 10a911 (window). The following error of cycle n is used
/// in cycle n + lead + 1 and no other, so a motion has the same bits however the feedback travelled; a stop
/// takes at least that long.
class ExactStopCheck {
 public:
  void configure(const machine::Parameters& parameters, const machine::ChannelAxes& axes,
                 const std::vector<int>& columns);
  /// Longest standstill in cycles, for motion::Trajectory::set_position_check(); 0 = no check.
  int cycles() const { return cycles_; }
  void on_feedback(const idl::stream::Feedback& feedback);
  /// The axes are at an exact stop, which feedback ends.
  bool checking() const { return checking_; }
  /// Before the setpoint of `cycle` is taken from `trajectory`: ends its standstill when the axes are in
  /// position. False when the longest time has passed; failure() then names the axis.
  bool step(motion::Trajectory& trajectory, std::uint64_t cycle);
  const std::string& failure() const { return failure_; }

 private:
  struct Axis {
    std::uint16_t number = 0;
    std::size_t column = 0;  // in the feedback
    double window = 0;       // mm or deg
    const char* unit = "mm";
  };
  /// What the feedback says of one cycle.
  struct Row {
    std::uint64_t cycle = ~0ull;
    bool in_position = false;
    std::size_t axis = 0;  // the first that is not
    double error = 0;      // its following error
  };
  static constexpr std::size_t rows = 2048;

  std::vector<Axis> axes_;
  std::vector<Row> rows_;
  std::uint64_t lead_ = 0;
  int cycles_ = 0;
  bool checking_ = false;
  std::uint64_t since_ = 0;  // first cycle at the stop
  std::string failure_;
};

}  // namespace trunnion::channel
