// SPDX-License-Identifier: Apache-2.0
#include "truth/touch_probe.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/angle.hpp"

namespace trunnion::truth {

double pre_travel(const TouchProbeTruth& probe, const Vec3& normal) {
  const double across = std::sqrt(normal.x() * normal.x() + normal.y() * normal.y());
  if (across < 1e-9 || probe.lobing == 0) return probe.pre_travel;
  const double direction =
      geometry::arc_tangent(normal.y(), normal.x()) / geometry::radians_per_degree - probe.lobing_phase;
  return probe.pre_travel + probe.lobing * across * geometry::sine_cosine(3 * direction).cosine;
}

std::optional<TouchProbe::Edge> TouchProbe::move(const Solid& solid, const Vec3& from, const Vec3& to,
                                                 double duration) {
  const Vec3 way = to - from;
  const double length = way.norm();
  if (!(length > 0)) return std::nullopt;
  const auto clearance = [&](double at) {
    return signed_distance(solid, from + at / length * way) - truth_.ball_radius;
  };
  // The tip can advance by its clearance without a touch, because a distance changes no faster than the point
  // moves.
  constexpr double close = 1e-9;  // mm
  double at = 0;
  for (int i = 0; i < 10000 && at < length; ++i) {
    const double free = clearance(at);
    if (free <= close) break;
    at += std::max(free, close);
  }
  if (at >= length && clearance(length) > close) return std::nullopt;
  at = std::min(at, length);
  Edge edge;
  edge.contact = from + at / length * way;
  const Vec3 normal = outward(solid, edge.contact);
  const double approach = -normal.dot(way) / length;
  if (approach <= 1e-6) return std::nullopt;  // slides along the surface or leaves it
  double deflection = pre_travel(truth_, normal);
  if (truth_.repeatability > 0) deflection += truth_.repeatability * random_.normal();
  // Along the way the ball goes on until it has moved by the pre-travel against the surface.
  const double opens = at + std::max(0.0, deflection) / approach;
  if (opens > length) return std::nullopt;
  edge.share = opens / length + truth_.delay / duration;
  return edge;
}

}  // namespace trunnion::truth
