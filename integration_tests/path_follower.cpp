// SPDX-License-Identifier: Apache-2.0
#include "path_follower.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

namespace trunnion::integration {

double PathFollower::distance(const std::vector<double>& row, std::size_t piece) const {
  const auto& a = reference_[piece];
  const auto& b = reference_[std::min(piece + 1, reference_.size() - 1)];
  double along = 0, length = 0;
  for (std::size_t i = 0; i < row.size(); ++i) {
    along += (row[i] - a[i]) * (b[i] - a[i]);
    length += (b[i] - a[i]) * (b[i] - a[i]);
  }
  const double t = length > 0 ? std::clamp(along / length, 0.0, 1.0) : 0.0;
  double squares = 0;
  for (std::size_t i = 0; i < row.size(); ++i) {
    const double d = row[i] - a[i] - t * (b[i] - a[i]);
    squares += d * d;
  }
  return std::sqrt(squares);
}

bool PathFollower::search(const std::vector<double>& row, std::size_t from, std::size_t to,
                          double tolerance) {
  // Of places that are equally near, which there are where the path turns back on itself, the next in time.
  constexpr double equal = 1e-9;
  const auto off = [&](std::size_t i) { return i > place_ ? i - place_ - 1 : place_ + 1 - i; };
  double best = std::numeric_limits<double>::max();
  std::size_t at = from;
  for (std::size_t i = from; i < to; ++i) {
    const double d = distance(row, i);
    if (d < best - equal || (d <= best + equal && off(i) < off(at))) best = std::min(best, d), at = i;
  }
  if (best > tolerance) return false;
  if (at < place_) back_ = std::max(back_, place_ - at);
  place_ = at;
  largest_ = std::max(largest_, best);
  return true;
}

bool PathFollower::follow(const std::vector<double>& row, double tolerance, std::size_t ahead) {
  constexpr std::size_t near = 4, far_back = 512;
  const auto end = [&](std::size_t cycles) { return std::min(reference_.size(), place_ + cycles); };
  const auto begin = [&](std::size_t cycles) { return place_ - std::min(place_, cycles); };
  // The ordinary case first: a narrow search, which must be nearly exact to be trusted.
  return search(row, begin(near), end(near), tolerance / 100) ||
         search(row, begin(near), end(ahead), tolerance) ||
         search(row, begin(far_back), end(ahead), tolerance);
}

bool PathFollower::arrived(double tolerance) const {
  const auto& last = reference_.back();
  for (std::size_t r = place_ + 1; r < reference_.size(); ++r)
    for (std::size_t i = 0; i < last.size(); ++i)
      if (std::abs(reference_[r][i] - last[i]) > tolerance) return false;
  return true;
}

Judgement judge(const Rows& rows, const Rows& reference, double tolerance, bool whole) {
  constexpr std::size_t ahead = 64;
  Judgement judgement;
  PathFollower follower(reference);
  std::size_t unseen = 0;
  for (std::size_t r = 0; r < rows.size() && judgement.problem.empty(); ++r) {
    if (rows[r].empty()) {
      ++unseen, ++judgement.unseen;
      continue;
    }
    if (!follower.follow(rows[r], tolerance, ahead + unseen))
      judgement.problem = "row " + std::to_string(r) + " of " + std::to_string(rows.size()) + ", after " +
                          std::to_string(unseen) + " unseen, is not on the path near cycle " +
                          std::to_string(follower.place()) + " of " + std::to_string(reference.size()) +
                          ": " + text_of(rows[r]) + " instead of " + text_of(reference[follower.place()]);
    unseen = 0;
  }
  if (judgement.problem.empty() && whole && !follower.arrived(tolerance))
    judgement.problem = "only cycle " + std::to_string(follower.place()) + " of " +
                        std::to_string(reference.size()) + " is reached";
  judgement.largest = follower.largest();
  judgement.back = follower.farthest_back();
  return judgement;
}

bool same_rows(const Rows& a, const Rows& b, double tolerance) {
  if (a.size() != b.size()) return false;
  for (std::size_t r = 0; r < a.size(); ++r)
    for (std::size_t i = 0; i < a[r].size(); ++i)
      if (!(std::abs(a[r][i] - b[r][i]) <= tolerance)) return false;
  return true;
}

std::string text_of(const std::vector<double>& row) {
  std::string text;
  char number[32];
  for (const double value : row) {
    std::snprintf(number, sizeof number, "%s%.4f", text.empty() ? "" : " ", value);
    text += number;
  }
  return text;
}

}  // namespace trunnion::integration
