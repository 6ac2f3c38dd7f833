// SPDX-License-Identifier: Apache-2.0
#include "motion/blended_path.hpp"

#include <algorithm>
#include <cmath>

#include "motion/blend.hpp"

namespace trunnion::motion {
namespace {

using canonical::axis_count;

// Part of the tolerance that is used; the rest covers rounding.
constexpr double tolerance_share = 0.98;

}  // namespace

double weigh(const AxisValues& change, const BlendRules& rules) {
  double linear = 0, rotary = 0;
  for (std::size_t i = 0; i < axis_count; ++i) {
    (canonical::is_rotary(i) ? rotary : linear) += change[i] * change[i];
  }
  const auto part = [](double square, double tolerance) {
    if (square <= 0) return 0.0;
    return tolerance > 0 ? std::sqrt(square) / tolerance : 1e300;
  };
  return std::max(part(linear, rules.contour_tolerance), part(rotary, rules.orientation_tolerance));
}

void BlendedPath::clear() {
  pushed_ = rated_ = reached_ = settled_blocks_ = 0;
  last_widest_ = 1;
}

void BlendedPath::rate_join(PathBlock& block) const {
  block.turn = block.bend = {};
  block.weight = block.bend_weight = 0;
  if (pushed_ == 0 || block.smooth) return;
  const PathBlock& before = (*this)[pushed_ - 1];
  const auto ends = before.path.derivatives(before.path.length());
  const auto begins = block.path.derivatives(0);
  for (std::size_t i = 0; i < axis_count; ++i) {
    block.turn[i] = begins[0][i] - ends[0][i];
    block.bend[i] = begins[1][i] - ends[1][i];
  }
  block.weight = weigh(block.turn, block.rules);
  const auto is_curved = [](const PathSegment& path) { return path.is_arc() || path.is_curve(); };
  block.bend_weight = is_curved(before.path) || is_curved(block.path) ? weigh(block.bend, block.rules) : 0;
}

void BlendedPath::push(PathBlock block) {
  block.at = end();
  if (pushed_ == 0) block.stop = true;
  block.reach = block.widest = 0;
  (*this)[pushed_++] = block;
}

// Share of the tolerance that all joins around `index` take there when they all reach `reach`. Between two
// joins the sum is convex, so it is largest at a join.
double BlendedPath::usage(std::uint64_t index, double reach) const {
  const double at = (*this)[index].at;
  double sum = 0;
  const auto add = [&](const PathBlock& join) {
    const double rest = reach - std::abs(join.at - at);
    sum += join.weight * rest * rest * rest;
    if (join.bend_weight > 0)
      sum += join.bend_weight * 6 * curvature_blend_height * reach * reach * reach * reach;
  };
  add((*this)[index]);
  for (std::uint64_t k = index + 1; k < pushed_ && !(*this)[k].stop && (*this)[k].at - at < reach; ++k)
    add((*this)[k]);
  for (std::uint64_t k = index; k-- > oldest() && !(*this)[k].stop && at - (*this)[k].at < reach;)
    add((*this)[k]);
  return sum / (6 * reach * reach);
}

// Share of the tolerance that the curves at a join take already.
double BlendedPath::strayed_at(std::uint64_t index) const {
  const double here = (*this)[index].strayed;
  return index > oldest() ? std::max(here, (*this)[index - 1].strayed) : here;
}

// A join has a rounding, or roundings reach a place where a curve has left less of the tolerance: between two
// places the sum of all roundings is convex.
bool BlendedPath::needs_reach(std::uint64_t index) const {
  const PathBlock& block = (*this)[index];
  if (block.stop) return false;
  if (block.is_join()) return true;
  if (!(strayed_at(index) > 0)) return false;
  const double at = block.at;
  int joins = 0;
  for (std::uint64_t k = index + 1; k < pushed_ && joins++ < most_joins; ++k) {
    const PathBlock& other = (*this)[k];
    if (other.stop || other.at - at >= longest_reach) break;
    if (other.is_join()) return true;
  }
  joins = 0;
  for (std::uint64_t k = index; k-- > oldest() && joins++ < most_joins;) {
    const PathBlock& other = (*this)[k];
    if (other.stop || at - other.at >= longest_reach) break;
    if (other.is_join()) return true;
  }
  return false;
}

double BlendedPath::widest_reach(std::uint64_t index) const {
  const double at = (*this)[index].at;
  double most = longest_reach;
  // Not across a stop, and not over more joins than a setpoint may have to sum.
  int joins = 0;
  std::uint64_t k = index + 1;
  for (; k < pushed_ && !(*this)[k].stop && (*this)[k].at - at < most; ++k) {
    if (++joins == most_joins) most = (*this)[k].at - at;
  }
  if (k < pushed_ && (*this)[k].stop) most = std::min(most, (*this)[k].at - at);
  if (k == pushed_) most = std::min(most, end() - at);
  joins = 0;
  for (k = index; k-- > oldest() && at - (*this)[k].at < most;) {
    if ((*this)[k].stop || ++joins == most_joins) most = at - (*this)[k].at;
  }
  if (!(most > 0)) return 0;
  // The usage grows faster than the reach, so scaling the reach down by the usage is always enough.
  const double share = tolerance_share - strayed_at(index);
  if (!(share > 0)) return 0;
  double reach = std::min(most, last_widest_);
  double used = usage(index, reach);
  for (int step = 0; step < 6 && (used > share || (used < 0.8 * share && reach < most)); ++step) {
    const double factor = used > 0 ? std::sqrt(0.92 * share / used) : 4;
    const double next = std::min(most, reach * std::clamp(factor, 0.2, 4.0));
    const double next_used = usage(index, next);
    reach = next;
    used = next_used;
  }
  if (used > share) reach *= share / used;
  return reach;
}

// A join may not reach farther than the tolerance allows at any join it touches.
double BlendedPath::final_reach(std::uint64_t index) const {
  const double at = (*this)[index].at;
  double reach = (*this)[index].widest;
  for (std::uint64_t k = index + 1; k < pushed_ && !(*this)[k].stop; ++k) {
    const double distance = (*this)[k].at - at;
    if (distance >= reach) break;
    if ((*this)[k].widest < reach) reach = std::max((*this)[k].widest, distance);
  }
  for (std::uint64_t k = index; k-- > oldest() && !(*this)[k].stop;) {
    const double distance = at - (*this)[k].at;
    if (distance >= reach) break;
    if ((*this)[k].widest < reach) reach = std::max((*this)[k].widest, distance);
  }
  return reach;
}

void BlendedPath::update(bool ends, double smooth_ahead) {
  // How far ahead of a join the path must be known: its longest reach, a stop, or enough joins.
  const auto is_known = [&](std::uint64_t index, std::uint64_t upto, double known) {
    if (ends && upto == pushed_) return true;
    if (upto > index + most_joins) return true;
    const double limit = upto < pushed_ ? (*this)[upto].at : known;
    if (limit - (*this)[index].at >= longest_reach) return true;
    for (std::uint64_t k = index + 1; k < pushed_ && k <= upto; ++k) {
      if ((*this)[k].stop) return true;
    }
    return false;
  };
  const double smooth_end = end() + smooth_ahead;
  for (; rated_ < pushed_; ++rated_) {
    const bool needed = needs_reach(rated_);
    if (!is_known(rated_, pushed_, needed ? end() : smooth_end)) break;
    PathBlock& block = (*this)[rated_];
    block.widest = longest_reach;
    if (!needed) continue;
    block.widest = widest_reach(rated_);
    last_widest_ = std::max(block.widest, 1e-9);
  }
  for (; reached_ < rated_; ++reached_) {
    PathBlock& block = (*this)[reached_];
    block.reach = 0;
    if (block.stop || !block.is_join()) continue;
    if (!is_known(reached_, rated_, end())) break;
    block.reach = final_reach(reached_);
  }
  // A block is settled when no join at its end or behind it can reach into it any more.
  const auto is_settled = [&](std::uint64_t index) {
    if (ends && reached_ == pushed_) return true;
    if (index + 1 < pushed_ && (*this)[index + 1].stop) return true;
    return index + 1 < reached_ && is_known(index + 1, reached_, smooth_end);
  };
  while (settled_blocks_ < reached_ && is_settled(settled_blocks_)) ++settled_blocks_;
}

template <typename Visit>
void BlendedPath::for_joins(std::uint64_t index, double s, Visit visit) const {
  int joins = 0;
  for (std::uint64_t k = index;; --k) {
    const PathBlock& join = (*this)[k];
    if (join.stop || s - join.at >= longest_reach || joins++ > most_joins) break;
    if (join.reach > 0 && s - join.at < join.reach) visit(join);
    if (k == oldest()) break;
  }
  joins = 0;
  for (std::uint64_t k = index + 1; k < pushed_; ++k) {
    const PathBlock& join = (*this)[k];
    if (join.stop || join.at - s >= longest_reach || joins++ > most_joins) break;
    if (join.reach > 0 && join.at - s < join.reach) visit(join);
  }
}

AxisValues BlendedPath::position(std::uint64_t index, double s) const {
  const PathBlock& block = (*this)[index];
  // The end is met bit for bit, whatever the difference of the coordinates has become.
  AxisValues p = block.path.position(s >= block.end() ? block.path.length() : s - block.at);
  for_joins(index, s, [&](const PathBlock& join) {
    const double x = s - join.at;
    const double turn = direction_blend(x, 0, join.reach)[0];
    for (std::size_t i = 0; i < axis_count; ++i) p[i] += turn * join.turn[i];
    if (join.bend_weight <= 0) return;
    const double bend = curvature_blend(x, x < 0 ? -1 : 1, join.reach)[0];
    for (std::size_t i = 0; i < axis_count; ++i) p[i] += bend * join.bend[i];
  });
  return p;
}

std::array<AxisValues, 3> BlendedPath::derivatives(std::uint64_t index, double s, double inside) const {
  const PathBlock& block = (*this)[index];
  auto d = block.path.derivatives(s - block.at);
  for_joins(index, inside, [&](const PathBlock& join) {
    const double x = s - join.at, side = inside < join.at ? -1 : 1;
    const BlendTerms turn = direction_blend(x, side, join.reach);
    for (std::size_t i = 0; i < axis_count; ++i) {
      d[0][i] += turn[1] * join.turn[i];
      d[1][i] += turn[2] * join.turn[i];
      d[2][i] += turn[3] * join.turn[i];
    }
    if (join.bend_weight <= 0) return;
    const BlendTerms bend = curvature_blend(x, side, join.reach);
    for (std::size_t i = 0; i < axis_count; ++i) {
      d[0][i] += bend[1] * join.bend[i];
      d[1][i] += bend[2] * join.bend[i];
      d[2][i] += bend[3] * join.bend[i];
    }
  });
  return d;
}

double BlendedPath::bend_reach(std::uint64_t index, double s) const {
  double shortest = 0;
  for_joins(index, s, [&](const PathBlock& join) {
    if (join.bend_weight > 0 && (shortest == 0 || join.reach < shortest)) shortest = join.reach;
  });
  return shortest;
}

double BlendedPath::next_knot(std::uint64_t index, double s) const {
  double next = (*this)[index].end();
  const double least = s + 1e-9;
  const auto consider = [&](const PathBlock& join) {
    for (const double knot : {join.at - join.reach, join.at + join.reach}) {
      if (knot > least && knot < next) next = knot;
    }
  };
  int joins = 0;
  for (std::uint64_t k = index;; --k) {
    const PathBlock& join = (*this)[k];
    if (join.stop || s - join.at >= longest_reach || joins++ > most_joins) break;
    consider(join);
    if (k == oldest()) break;
  }
  joins = 0;
  for (std::uint64_t k = index + 1; k < pushed_; ++k) {
    const PathBlock& join = (*this)[k];
    if (join.stop || join.at - next >= longest_reach || joins++ > most_joins) break;
    consider(join);
  }
  return next;
}

}  // namespace trunnion::motion
