// SPDX-License-Identifier: Apache-2.0
#include "core/planned_path.hpp"

#include <algorithm>
#include <utility>

namespace trunnion::gateway {

void PlannedPath::add(const PathPoint& point) {
  take(point);
  while (kept_.size() >= most_) {
    tolerance_ *= 2;
    whole_ = false;
    const auto newest = newest_;
    for (const auto& one : std::exchange(kept_, {})) take(one);
    take(newest);
  }
}

void PlannedPath::keep(const PathPoint& point) {
  kept_.push_back(point);
  direction_.setZero();
  reach_ = 0;
}

void PlannedPath::take(const PathPoint& point) {
  if (kept_.empty()) {
    newest_ = point;
    return keep(point);
  }
  const bool another = point.line != newest_.line || point.rapid != newest_.rapid;
  if (another && whole_ && newest_.seconds > kept_.back().seconds) keep(newest_);
  const Eigen::Vector3d way = point.tip - kept_.back().tip;
  if (direction_.isZero()) {
    if (way.norm() > tolerance_) direction_ = way.normalized(), reach_ = way.norm();
  } else {
    const double along = way.dot(direction_);
    if (along < reach_ - tolerance_ || (way - along * direction_).norm() > tolerance_) {
      keep(newest_);
      const Eigen::Vector3d next = point.tip - newest_.tip;
      if (next.norm() > tolerance_) direction_ = next.normalized(), reach_ = next.norm();
    } else {
      reach_ = std::max(reach_, along);
    }
  }
  newest_ = point;
}

std::vector<PathPoint> PlannedPath::points() const {
  auto points = kept_;
  if (!points.empty() && newest_.seconds > points.back().seconds) points.push_back(newest_);
  return points;
}

}  // namespace trunnion::gateway
