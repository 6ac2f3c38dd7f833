// SPDX-License-Identifier: Apache-2.0
#include "motion_analysis/place_cost.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "canonical/axes.hpp"

namespace trunnion::analysis {
namespace {

// A cycle counts as slow below this share of the programmed speed.
constexpr double slow_share = 0.98;
constexpr double longest_place = 0.2;  // s

}  // namespace

std::string to_text(const CostlyPlace& place) {
  static constexpr const char* names[] = {"velocity", "acceleration", "jerk"};
  auto lines = std::to_string(place.first_line);
  if (place.last_line != place.first_line) lines += "-" + std::to_string(place.last_line);
  return fmt::format("{}: {:.3f} s lost from {:.3f} s on, axis {} uses {:.0f} % of its {} on average", lines,
                     place.lost, place.begin, canonical::axis_letters[place.axis], 100 * place.use,
                     names[static_cast<std::size_t>(place.limit)]);
}

void PlaceCost::add(const motion::AxisValues& machine, const motion::Setpoint& setpoint) {
  if (count_ == 0) before_.fill(machine);
  ++count_;
  const double share = setpoint.programmed_speed > 0 ? setpoint.path_speed / setpoint.programmed_speed : 1;
  if (setpoint.dwelling || setpoint.at_rest || share >= slow_share) {
    close();
  } else {
    if (cycles_ == 0) {
      place_ = {};
      place_.first_line = setpoint.line;
      place_.begin = static_cast<double>(count_ - 1) * cycle_;
    }
    ++cycles_;
    place_.last_line = setpoint.line;
    place_.lost += cycle_ * (1 - share);
    for (std::size_t i = 0; i < machine.size(); ++i) {
      const double q0 = machine[i], q1 = before_[0][i], q2 = before_[1][i], q3 = before_[2][i];
      const motion::AxisLimits& axis = limits_.axes[i];
      use_[0][i] += std::abs(q0 - q1) / cycle_ / axis.velocity;
      use_[1][i] += std::abs(q0 - 2 * q1 + q2) / (cycle_ * cycle_) / axis.acceleration;
      use_[2][i] += std::abs(q0 - 3 * q1 + 3 * q2 - q3) / (cycle_ * cycle_ * cycle_) / axis.jerk;
    }
    if (static_cast<double>(cycles_) * cycle_ >= longest_place) close();
  }
  before_ = {machine, before_[0], before_[1], before_[2]};
}

void PlaceCost::close() {
  if (cycles_ == 0) return;
  place_.end = place_.begin + static_cast<double>(cycles_) * cycle_;
  for (std::size_t n = 0; n < use_.size(); ++n) {
    for (std::size_t i = 0; i < use_[n].size(); ++i) {
      const double use = use_[n][i] / static_cast<double>(cycles_);
      if (use <= place_.use) continue;
      place_.use = use;
      place_.axis = i;
      place_.limit = static_cast<BindingLimit>(n);
    }
  }
  cycles_ = 0;
  use_ = {};
  const auto at =
      std::upper_bound(places_.begin(), places_.end(), place_,
                       [](const CostlyPlace& a, const CostlyPlace& b) { return a.lost > b.lost; });
  places_.insert(at, place_);
  if (places_.size() > most_places) places_.pop_back();
}

std::vector<CostlyPlace> PlaceCost::finish() {
  close();
  return places_;
}

}  // namespace trunnion::analysis
