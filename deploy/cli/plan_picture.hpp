// SPDX-License-Identifier: Apache-2.0
// plan --plot: a planned motion as a picture, with the places that lose most time.
#pragma once

#include <string>
#include <vector>

#include "analysis/program_run.hpp"
#include "motion_analysis/place_cost.hpp"

namespace trunnion::cli {

/// Keeps some thousand cycles of a motion of any length, equally far apart.
class PlanPicture {
 public:
  explicit PlanPicture(double cycle_seconds) : period_(cycle_seconds) {}

  void add(const analysis::PlannedCycle& cycle);
  /// An SVG document: the tool tip seen along Z, the feed over time, and the places, numbered from the
  /// costliest on.
  std::string svg(const std::string& title, const std::vector<analysis::CostlyPlace>& places) const;

 private:
  struct Shown {
    double time, x, y, feed, programmed;  // s, mm, mm/min
  };
  void thin_out();
  std::vector<Shown> between(double begin, double end) const;

  double period_;
  std::uint64_t stride_ = 1;
  std::vector<Shown> shown_;
};

}  // namespace trunnion::cli
