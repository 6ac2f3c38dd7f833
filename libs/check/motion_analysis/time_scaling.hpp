// SPDX-License-Identifier: Apache-2.0
// The least time in which axes limited in velocity, acceleration and jerk can make a motion that is given.
#pragma once

#include <cstddef>
#include <vector>

#include "canonical/axes.hpp"
#include "motion/limits.hpp"

namespace trunnion::analysis {

using canonical::AxisValues;

/// One sample of the given motion, at the end of a cycle.
struct MotionSample {
  AxisValues machine{};  ///< axes after the transformation, mm and degrees
  double share = 0;      ///< of the programmed speed that the motion has, 0: no programmed speed
  bool rapid = false;    ///< velocity limits are those of rapid traverse
};

/// Another speed on the path of a motion. With the given motion q(T) and b = (dT/dt)^2 every axis has
///   q' sqrt(b),   q'' b + q' b' / 2,   (q''' b + 3/2 q'' b' + q' b'' / 2) sqrt(b).
/// The integral of dT / sqrt(b) is minimised under the limits of every axis and the programmed speed: a
/// sequence of convex problems, since 1 / sqrt(b) in the row of jerk is replaced by its tangent, which lies
/// below it, each by a logarithmic barrier and Newton's method. Every iterate keeps all rows, b = 1 is the
/// motion itself. Derivatives are central differences of the samples, so a detail shorter than three cycles
/// is smoothed. It shares no code with the planner.
/// `samples`: one per cycle of `cycle` seconds, at least eight; `begin`: b at every one of them, from which
/// the search begins. The first two keep it when the motion `continues` another one, the last two unless it
/// `ends` with them. Returns b at every sample. Where the given motion does not keep the limits, b is
/// reduced; b changes by at most a tenth in a cycle.
std::vector<double> least_time_scaling(const std::vector<MotionSample>& samples, const motion::Limits& limits,
                                       double cycle, std::vector<double> begin, bool continues, bool ends);

/// The same for a motion of any length in constant memory: windows that overlap. The path between two
/// standstills is one section; the time at a standstill does not count. Where the motion keeps its programmed
/// speed, only both ends are solved, as far as the axes need to stop and more: no motion is faster there.
class LeastTime {
 public:
  LeastTime(const motion::Limits& limits, double cycle) : limits_(limits), cycle_(cycle) {}
  /// The sample of the next cycle.
  void add(const MotionSample& sample);
  /// Seconds so far; the motion has ended.
  double finish();

 private:
  void solve(bool ends);
  void solve_up_to_constant_speed();
  std::size_t margin() const;
  void count(const std::vector<double>& b, std::size_t samples);
  bool add_at_constant_speed(const MotionSample& sample);

  motion::Limits limits_;
  double cycle_;
  std::vector<MotionSample> window_;
  std::vector<double> before_;  // b where the window overlaps the one before
  double time_ = 0;
  std::size_t resting_ = 0;
  std::size_t constant_ = 0;      // samples in a row with the programmed speed
  bool between_windows_ = false;  // the programmed speed has lasted so long that nothing is solved
  std::size_t margin_ = 0;        // samples solved at an end of such a stretch and used
  std::size_t known_ = 0;         // first samples of the window that have the programmed speed for certain
};

}  // namespace trunnion::analysis
