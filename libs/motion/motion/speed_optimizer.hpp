// SPDX-License-Identifier: Apache-2.0
// The least time over a stretch of the path under the limits of speed, acceleration and jerk of every axis.
#pragma once

#include <cstddef>
#include <vector>

#include "motion/speed_window.hpp"

namespace trunnion::motion {

/// Minimises the integral of ds / v over a window by a primal-dual interior point method on the coefficients
/// of b = v^2: every row keeps two slacks and two multipliers, the curvature of the rows of jerk is left out
/// of the Hessian, which then has five diagonals (Nocedal and Wright, Numerical Optimization, chapter 19).
/// The result is checked between the places of its rows; where it uses more than the limits, rows are
/// tightened and the iteration goes on. It depends on its inputs alone, and nothing allocates after
/// construction.
class SpeedOptimizer {
 public:
  SpeedOptimizer();

  /// True when there is a window to solve. `before`: the plan in force from the start on, nullptr if none;
  /// `cells` and it are not needed by the iterations.
  bool begin(const CellRing& cells, const SpeedRequest& request, const SpeedPlan* before);
  /// One share of the work, at most some hundred microseconds. True when it has ended.
  bool work(const CellRing& cells);
  bool running() const { return running_; }
  void cancel() { running_ = false; }
  /// The window was solved within all limits.
  bool solved() const { return solved_; }
  const std::vector<SpeedPiece>& pieces() const { return pieces_; }
  bool drawn() const { return window_.drawn(); }
  bool reaches_end() const { return window_.reaches_end(); }

 private:
  // Two doubles, of |q| <= 1 the sides q <= 1 and -q <= 1.
  using Two = double __attribute__((vector_size(16)));
  struct Side {
    Two slack, factor, value, inverse, change, factor_change;
    double slope[3];
  };
  struct Box {
    double slack, factor, value, inverse, change, factor_change;
  };
  void evaluate();
  bool factorise();
  void step();
  void check(const CellRing& cells);
  void keep_programmed_speed(const CellRing& cells);
  void finish(bool good);

  SpeedWindow window_;
  std::vector<double> b_, hessian_, gradient_, step_, use_;
  std::vector<Side> sides_;
  std::vector<Box> boxes_;
  std::vector<double> root_, gauss_;
  std::vector<SpeedPiece> pieces_;
  double barrier_ = 0, gap_ = 0, objective_ = 0, worst_ = 0;
  std::size_t count_ = 0;
  int iterations_ = 0, rounds_ = 0;
  bool running_ = false, solved_ = false, fresh_ = true;
};

}  // namespace trunnion::motion
