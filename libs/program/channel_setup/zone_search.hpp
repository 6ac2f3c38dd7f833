// SPDX-License-Identifier: Apache-2.0
// Where a move enters a zone that a program forbids.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>

#include "language/canonical.hpp"
#include "language/stroke_zone.hpp"

namespace trunnion::channel_setup {

using language::AxisValues;

/// The first share (0..1) of the way from `p` to `q` that is in the box of `zone`, each side of it moved
/// outwards by `wider`; nothing when there is none. On a side is not in the box.
inline std::optional<double> entry_of(const AxisValues& p, const AxisValues& q,
                                      const language::StrokeZone& zone, const language::Vector3& wider) {
  constexpr double slack = 1e-6, still = 1e-12;
  double first = 0, last = 1;
  for (std::size_t axis = 0; axis < zone.low.size(); ++axis) {
    if (!zone.bounded[axis]) continue;
    const double low = zone.low[axis] - wider[axis] + slack, high = zone.high[axis] + wider[axis] - slack;
    const double way = q[axis] - p[axis];
    if (std::abs(way) < still) {
      if (!(p[axis] > low && p[axis] < high)) return std::nullopt;
      continue;
    }
    double in = (low - p[axis]) / way, out = (high - p[axis]) / way;
    if (in > out) std::swap(in, out);
    first = std::max(first, in);
    last = std::min(last, out);
    if (!(first < last)) return std::nullopt;
  }
  return first;
}

/// Between two places of a way: their shares of it, and where they are.
struct WayPiece {
  double begin = 0, end = 0;
  AxisValues from{}, to{};
};

/// The share at which the way `at(share)` is first in the box on this piece. It bends as far as its middle is
/// off the straight line; where the box, wider by that, is entered, the halves are looked at.
template <class At>
std::optional<double> entry_of(const At& at, const WayPiece& piece, const language::StrokeZone& zone,
                               int halvings) {
  constexpr double straight = 1e-4;  // mm
  const double half = (piece.begin + piece.end) / 2;
  const AxisValues middle = at(half);
  language::Vector3 bend{};
  for (std::size_t axis = 0; axis < bend.size(); ++axis)
    bend[axis] = std::abs(middle[axis] - (piece.from[axis] + piece.to[axis]) / 2);
  const auto share = entry_of(piece.from, piece.to, zone, bend);
  if (!share) return std::nullopt;
  if (halvings == 0 || std::max({bend[0], bend[1], bend[2]}) < straight)
    return piece.begin + *share * (piece.end - piece.begin);
  const auto first = entry_of(at, WayPiece{piece.begin, half, piece.from, middle}, zone, halvings - 1);
  return first ? first : entry_of(at, WayPiece{half, piece.end, middle, piece.to}, zone, halvings - 1);
}

/// Where the way `at(share)`, machine positions for 0..1, is first in the box of `zone`; `degrees` as in
/// farthest_breach().
template <class At>
std::optional<AxisValues> first_in_zone(const At& at, double degrees, const language::StrokeZone& zone) {
  constexpr double step = 7.5, most_pieces = 65536;
  constexpr int most_halvings = 12;
  const double pieces = degrees > 0 ? std::clamp(std::ceil(degrees / step), 4.0, most_pieces) : 1;
  AxisValues from = at(0);
  for (double k = 1; k <= pieces; ++k) {
    const AxisValues to = at(k / pieces);
    const auto share = entry_of(at, WayPiece{(k - 1) / pieces, k / pieces, from, to}, zone, most_halvings);
    if (share) return at(*share);
    from = to;
  }
  return std::nullopt;
}

}  // namespace trunnion::channel_setup
