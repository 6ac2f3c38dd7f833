// SPDX-License-Identifier: Apache-2.0
#include "touch_probe/touch_probe.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "geometry/angle.hpp"

namespace trunnion::touch_probe {

double pre_travel(const TouchProbeTruth& probe, const Vec3& normal) {
  const double across = std::sqrt(normal.x() * normal.x() + normal.y() * normal.y());
  if (across < 1e-9 || probe.lobing == 0) return probe.pre_travel;
  const double direction =
      geometry::arc_tangent(normal.y(), normal.x()) / geometry::radians_per_degree - probe.lobing_phase;
  return probe.pre_travel + probe.lobing * across * geometry::sine_cosine(3 * direction).cosine;
}

TouchProbe::TouchProbe(const TouchProbeTruth& truth, std::vector<Solid> solids)
    : truth_(truth), solids_(std::move(solids)), random_(truth.seed) {
  draw();
}

void TouchProbe::draw() { noise_ = truth_.repeatability > 0 ? truth_.repeatability * random_.normal() : 0; }

// Of the ball's surface from the nearest solid.
double TouchProbe::distance(const Vec3& ball, const Solid*& nearest) const {
  double least = std::numeric_limits<double>::max();
  nearest = nullptr;
  for (const Solid& solid : solids_) {
    const double value = signed_distance(solid, ball) - truth_.ball_radius;
    if (value < least) least = value, nearest = &solid;
  }
  return least;
}

// How far the ball is from where the contact opens, in the direction of the surface; below zero beyond it.
double TouchProbe::margin(const Vec3& ball, const ProbePose& pose) const {
  const Solid* nearest = nullptr;
  const double free = distance(ball, nearest);
  if (nearest == nullptr) return free;
  if (early(touches_ + 1)) return free - truth_.early;
  double deflection = truth_.pre_travel;
  // The direction only matters near the surface.
  if (truth_.lobing != 0 && free < 1 + truth_.lobing) {
    const Vec3 normal = outward(*nearest, ball);
    deflection = pre_travel(
        truth_, {normal.dot(pose.across), normal.dot(pose.axis.cross(pose.across)), normal.dot(pose.axis)});
  }
  return free + std::max(0.0, deflection + noise_);
}

void TouchProbe::place(const ProbePose& pose) {
  margin_ = margin(pose.ball, pose);
  open_ = signal_ = margin_ <= 0;
  waiting_ = false;
  ball_ = {pose.ball.x(), pose.ball.y(), pose.ball.z()};
}

// The share of the motion after which the contact opens; above 1: it does not. A distance changes no faster
// than the ball moves, so the ball can advance by its margin; then the interval is halved.
double TouchProbe::contact_share(const Vec3& from, const ProbePose& pose) const {
  const Vec3 way = pose.ball - from;
  const double length = way.norm();
  const auto margin_at = [&](double at) { return margin(from + at / length * way, pose); };
  constexpr double close = 1e-9;  // mm
  double before = 0, at = 0, free = margin_;
  for (int i = 0; i < 100 && free > close; ++i) {
    before = at;
    at += free;
    if (at >= length) break;
    free = margin_at(at);
  }
  at = std::min(at, length);
  free = margin_at(at);
  if (free > close) {
    if (margin_at(length) > 0) return 2;
    before = at, at = length;
  }
  for (int i = 0; i < 60 && free < -close; ++i) {
    const double middle = (before + at) / 2;
    const double value = margin_at(middle);
    if (value > 0)
      before = middle;
    else
      at = middle, free = value;
  }
  return at / length;
}

std::optional<double> TouchProbe::move(const ProbePose& pose, double duration) {
  const Vec3 from(ball_[0], ball_[1], ball_[2]);
  const double start_margin = margin_, length = (pose.ball - from).norm();
  const double end_margin = margin(pose.ball, pose);
  double begins = 0;  // s: from then on the delay runs
  // A faulty probe that would be early at once waits for the next approach.
  if (!open_ && start_margin > 0 && (end_margin <= 0 || start_margin < length)) {
    const double share = length > 0 ? contact_share(from, pose) : 2;
    if (share <= 1) {
      open_ = true;
      ++touches_;
      waiting_ = truth_.no_signal_from == 0 || touches_ < truth_.no_signal_from;
      remaining_ = truth_.delay;
      begins = share * duration;
    }
  }
  margin_ = end_margin;
  ball_ = {pose.ball.x(), pose.ball.y(), pose.ball.z()};
  std::optional<double> edge;
  if (waiting_) {
    remaining_ -= duration - begins;
    if (remaining_ <= 0) {
      waiting_ = false;
      signal_ = true;
      edge = std::clamp((duration + remaining_) / duration, std::numeric_limits<double>::min(), 1.0);
    }
  }
  const Solid* nearest = nullptr;
  if (open_ && !stuck() && distance(pose.ball, nearest) > reseat + (early(touches_) ? truth_.early : 0)) {
    open_ = waiting_ = signal_ = false;
    draw();
    margin_ = margin(pose.ball, pose);
  }
  return edge;
}

}  // namespace trunnion::touch_probe
