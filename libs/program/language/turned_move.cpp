// SPDX-License-Identifier: Apache-2.0
#include "language/turned_move.hpp"

#include <algorithm>
#include <cmath>

namespace trunnion::language {
namespace {

constexpr double radius_step = 1.1;  // from one radius to the next

// Radii of one side of the centre, from `from` to `to`, which take the shares `begin` to `end` of the move.
void divide_side(double from, double to, double begin, double end, double limit_radius, Divisions& out) {
  const auto add = [&](double radius) {
    const double share = begin + (end - begin) * ((radius - from) / (to - from));
    if (out.count < Divisions::most && share > begin && share < end) out.share[out.count++] = share;
  };
  const double least = std::max(std::min(from, to), limit_radius), most = std::max(from, to);
  if (!(least < most)) return;
  if (from > to) {
    for (double radius = from / radius_step; radius > least && out.count < Divisions::most;
         radius /= radius_step)
      add(radius);
    if (least > to) add(least);
  } else {
    if (least > from) add(least);
    for (double radius = least * radius_step; radius < to && out.count < Divisions::most;
         radius *= radius_step)
      add(radius);
  }
}

}  // namespace

Divisions divide_turned_move(double start, double end, double limit_radius) {
  Divisions divisions;
  if (start == end || !(limit_radius > 0)) return divisions;
  const double from = std::abs(start), to = std::abs(end);
  if ((start < 0) == (end < 0) || from == 0 || to == 0) {
    divide_side(from, to, 0, 1, limit_radius, divisions);
    return divisions;
  }
  const double centre = from / (from + to);
  divide_side(from, 0, 0, centre, limit_radius, divisions);
  divide_side(0, to, centre, 1, limit_radius, divisions);
  return divisions;
}

}  // namespace trunnion::language
