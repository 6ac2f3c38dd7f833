// Simulated skip inputs: switches at a fixed place of an axis, with the latch that a drive has for a probe.
#pragma once

#include <array>
#include <vector>

#include "contracts/types.hpp"
#include "machine/axes.hpp"
#include "servo_axis.hpp"

namespace trunnion::drive {

class SkipInputs {
 public:
  /// `axes` are the columns of the servos. Throws as Parameters::get() does.
  void configure(const machine::Parameters& parameters, const std::vector<machine::AxisInfo>& axes);
  /// One period is over. Within it every axis is taken to have moved evenly, so a position is latched more
  /// finely than by the period. The first call only learns where the axes are.
  void step(const std::vector<ServoAxis>& servos);
  /// What has come on since the last call, as having come before `cycle`, appended to `out`, which takes no
  /// more than its topic can carry: a bouncing contact is no news.
  void report(std::uint64_t cycle, std::vector<idl::stream::SkipEdge>& out);

 private:
  struct Input {
    int column = -1;
    double position = 0;
    double side = 1;
  };
  std::array<Input, 4> inputs_;
  std::vector<double> load_, encoder_;  // at the end of the period before
  std::vector<idl::stream::SkipEdge> edges_;
};

}  // namespace trunnion::drive
