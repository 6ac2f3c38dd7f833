// SPDX-License-Identifier: Apache-2.0
// Where on a move an axis goes farthest beyond its travel.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include "language/environment.hpp"

namespace trunnion::channel_setup {

using language::AxisValues;

/// Travel of an axis of the channel.
struct Travel {
  double negative = 0, positive = 0;
  /// How far `position` is beyond, mm or degrees; not above 0 within.
  double excess(double position) const { return std::max(position - positive, negative - position); }
};

/// The axis that goes farthest beyond its travel, and where it is then. `at(share)` gives machine positions
/// for 0..1; `degrees` is how far all rotary axes and the angle of an arc turn on the way, 0 when the axes go
/// straight, so that the end is farthest. Extremes between the places looked at are searched for where they
/// could be out of travel.
template <class At>
std::optional<language::TravelBreach> farthest_breach(
    const At& at, double degrees, const std::vector<std::uint8_t>& axes,
    const std::array<Travel, language::axis_count>& travels) {
  constexpr double slack = 1e-6, step = 7.5, most_places = 65536;
  const double places = degrees > 0 ? std::clamp(std::ceil(degrees / step), 4.0, most_places) : 1;
  std::optional<language::TravelBreach> worst;
  double most = slack;
  const auto look = [&](std::uint8_t axis, double position) {
    const double excess = travels[axis].excess(position);
    if (!(excess > most)) return;
    most = excess;
    worst = {static_cast<language::Axis>(axis), position};
  };
  // Golden section between two places, beyond whose middle one the excess is largest.
  const auto search = [&](std::uint8_t axis, double low, double high) {
    constexpr double part = 0.6180339887498949;
    const auto excess = [&](double share) { return travels[axis].excess(at(share)[axis]); };
    double a = high - part * (high - low), b = low + part * (high - low);
    double at_a = excess(a), at_b = excess(b);
    for (int k = 0; k < 40; ++k) {
      const bool left = at_a > at_b;
      (left ? high : low) = left ? b : a;
      (left ? b : a) = left ? a : b;
      (left ? at_b : at_a) = left ? at_a : at_b;
      double& open = left ? a : b;
      open = left ? high - part * (high - low) : low + part * (high - low);
      (left ? at_a : at_b) = excess(open);
    }
    look(axis, at(low)[axis]);
  };
  AxisValues before = at(0), here = before;
  for (double k = 1; k <= places; ++k) {
    const AxisValues next = at(k / places);
    for (const auto axis : axes) {
      look(axis, next[axis]);
      if (k < 2) continue;
      const double bend = std::abs(before[axis] - 2 * here[axis] + next[axis]);
      const double excess = std::max({travels[axis].excess(before[axis]), travels[axis].excess(here[axis]),
                                      travels[axis].excess(next[axis])});
      if (excess + 0.5 * bend > slack) search(axis, (k - 2) / places, k / places);
    }
    before = here;
    here = next;
  }
  return worst;
}

}  // namespace trunnion::channel_setup
