// SPDX-License-Identifier: Apache-2.0
#include "report/polyline.hpp"

#include <algorithm>
#include <limits>

namespace trunnion::report {

void Polyline::build() {
  boxes_.clear();
  if (pieces_.empty()) return;
  std::vector<Box> level;
  for (std::size_t i = 0; i < pieces_.size(); i += leaf) {
    Box box{begin_of(i), begin_of(i)};
    for (std::size_t k = i; k < std::min(i + leaf, pieces_.size()); ++k) {
      box.low = box.low.cwiseMin(pieces_[k].end);
      box.high = box.high.cwiseMax(pieces_[k].end);
    }
    level.push_back(box);
  }
  while (level.size() > 1) {
    std::vector<Box> above;
    for (std::size_t i = 0; i < level.size(); i += 2) {
      Box box = level[i];
      if (i + 1 < level.size()) {
        box.low = box.low.cwiseMin(level[i + 1].low);
        box.high = box.high.cwiseMax(level[i + 1].high);
      }
      above.push_back(box);
    }
    boxes_.push_back(std::move(level));
    level = std::move(above);
  }
  boxes_.push_back(std::move(level));
}

void Polyline::try_piece(const Vec3& point, std::size_t piece, Nearest& best, double& squared) const {
  const Vec3& a = begin_of(piece);
  const Vec3 d = pieces_[piece].end - a;
  const double length = d.squaredNorm();
  const double t = length > 0 ? std::clamp((point - a).dot(d) / length, 0.0, 1.0) : 0.0;
  const Vec3 foot = a + t * d;
  const double here = (point - foot).squaredNorm();
  if (here < squared) {
    squared = here;
    best.point = foot;
    best.piece = piece;
  }
}

void Polyline::search(const Vec3& point, std::size_t level, std::size_t node, Nearest& best,
                      double& squared) const {
  const auto gap = [&](std::size_t at, std::size_t index) {
    const Box& box = boxes_[at][index];
    return (point - point.cwiseMax(box.low).cwiseMin(box.high)).squaredNorm();
  };
  if (level == 0) {
    for (std::size_t k = node * leaf; k < std::min((node + 1) * leaf, pieces_.size()); ++k)
      try_piece(point, k, best, squared);
    return;
  }
  const std::size_t left = 2 * node, right = left + 1;
  const bool two = right < boxes_[level - 1].size();
  const double gap_left = gap(level - 1, left);
  const double gap_right = two ? gap(level - 1, right) : std::numeric_limits<double>::infinity();
  const bool left_first = gap_left <= gap_right;
  for (const bool left_now : {left_first, !left_first})
    if ((left_now ? gap_left : gap_right) < squared)
      search(point, level - 1, left_now ? left : right, best, squared);
}

Nearest Polyline::nearest(const Vec3& point, std::size_t guess) const {
  Nearest best;
  best.point = start_;
  double squared = (point - start_).squaredNorm();
  if (!pieces_.empty()) {
    const std::size_t from = guess > 2 ? guess - 2 : 0;
    for (std::size_t k = from; k < std::min(guess + 8, pieces_.size()); ++k)
      try_piece(point, k, best, squared);
    search(point, boxes_.size() - 1, 0, best, squared);
  }
  best.distance = std::sqrt(squared);
  return best;
}

}  // namespace trunnion::report
