// SPDX-License-Identifier: Apache-2.0
// Where a planned motion loses time against its programmed feed, and which limit is the cause.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "motion/interpolation.hpp"
#include "motion/limits.hpp"

namespace trunnion::analysis {

enum class BindingLimit : std::uint8_t { velocity, acceleration, jerk };

/// Cycles in a row in which the motion is slower than programmed, cut at about 0.2 s.
struct CostlyPlace {
  std::uint32_t first_line = 0, last_line = 0;
  double begin = 0;      ///< s since the start of the program
  double end = 0;        ///< likewise
  double lost = 0;       ///< s more than the same path takes at the programmed feed
  std::size_t axis = 0;  ///< index of the axis whose limit is used most
  BindingLimit limit = BindingLimit::jerk;
  double use = 0;  ///< mean share of that limit that is used there
};

/// One line of text: lines of the program, time lost and since when in s, the axis and the share of its
/// limit.
std::string to_text(const CostlyPlace& place);

/// Follows setpoints, one per cycle, and keeps the ten places that cost most.
class PlaceCost {
 public:
  static constexpr std::size_t most_places = 10;

  /// Jerk limits as the mode leaves them; `cycle_seconds` above 0.
  PlaceCost(const motion::Limits& limits, double cycle_seconds) : limits_(limits), cycle_(cycle_seconds) {}

  /// Axes of the next cycle after the transformation, and its setpoint.
  void add(const motion::AxisValues& machine, const motion::Setpoint& setpoint);
  /// The motion has ended.
  std::vector<CostlyPlace> finish();

 private:
  void close();

  motion::Limits limits_;
  double cycle_;
  std::array<motion::AxisValues, 4> before_{};
  std::uint64_t count_ = 0;
  CostlyPlace place_;
  std::size_t cycles_ = 0;  // of the place
  std::array<motion::AxisValues, 3> use_{};
  std::vector<CostlyPlace> places_;
};

}  // namespace trunnion::analysis
