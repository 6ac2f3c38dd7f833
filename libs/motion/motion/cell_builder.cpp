// SPDX-License-Identifier: Apache-2.0
#include "motion/cell_builder.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "motion/axis_limits.hpp"

namespace trunnion::motion {
namespace {

using canonical::axis_count;

// What of an axis' limits the path's own curvature may take at the highest speed; the rest accelerates.
constexpr double normal_share = 0.72;
constexpr double bend_share = 0.6;
// The same where every axis is checked by itself: all but rounding, and what a later change of speed needs.
constexpr double top_normal_share = 0.999;
constexpr double top_bend_share = 0.95;
// Of the jerk left, what the product of curvature, speed and acceleration may take.
constexpr double mixed_share = 0.4;
// Through a chain the derivatives vary between the ends of a cell, and only the ends are evaluated.
constexpr double chained_share = 0.995;
// Arcs, radians: the highest speed of a cell is that of its slowest place.
constexpr double arc_cell_angle = 0.025;
// Where a jump of curvature is rounded, as a share of its reach: derivatives are interpolated on a cell.
constexpr double bend_cell_share = 0.25;
// Moves up to this length are dense, mm or degrees.
constexpr double longest_dense = 5;
// Share of a derivative in the middle of a cell by which the interpolation may miss it.
constexpr double most_missed = 0.25;
constexpr double fastest = 1e5;
// Cells of one call: a long path that becomes known at once must not take long in one cycle.
constexpr std::uint64_t most_at_once = 2048;

}  // namespace

void limit_cell(LimitCell& cell, const CellRates& rates, const Limits& limits) {
  double speed = cell.rapid ? fastest : std::min(fastest, cell.feed * highest_override);
  bool curved = false;
  for (std::size_t i = 0; i < axis_count; ++i) {
    const AxisLimits& axis = limits.axes[i];
    const double velocity = cell.rapid ? axis.rapid_velocity : axis.velocity;
    if (rates.first[i] > 0) speed = std::min(speed, velocity / rates.first[i]);
    if (rates.second[i] > 0) {
      speed = std::min(speed, std::sqrt(normal_share * axis.acceleration / rates.second[i]));
      curved = true;
    }
    if (rates.third[i] > 0) {
      speed = std::min(speed, std::cbrt(bend_share * axis.jerk / rates.third[i]));
      curved = true;
    }
  }
  if (rates.curvature > 0 && limits.centripetal_acceleration > 0)
    speed = std::min(speed, std::sqrt(limits.centripetal_acceleration / rates.curvature));
  cell.speed = cell.top = speed;
  cell.uniform = !curved;
  const std::size_t count = curved ? LimitCell::levels : 1;
  for (std::size_t k = 0; k < count; ++k) {
    const double v = speed * LimitCell::shares[k];
    double a = 1e9, j = 1e12;
    for (std::size_t i = 0; i < axis_count; ++i) {
      const AxisLimits& axis = limits.axes[i];
      const double rest = axis.jerk - rates.third[i] * v * v * v;
      if (rates.first[i] > 0) a = std::min(a, (axis.acceleration - rates.second[i] * v * v) / rates.first[i]);
      if (rates.second[i] > 0) a = std::min(a, mixed_share * rest / (3 * rates.second[i] * v));
    }
    for (std::size_t i = 0; i < axis_count; ++i) {
      if (rates.first[i] <= 0) continue;
      const double rest = limits.axes[i].jerk - rates.third[i] * v * v * v - 3 * rates.second[i] * v * a;
      j = std::min(j, rest / rates.first[i]);
    }
    cell.ramps[k] = {a, j};
  }
  for (std::size_t k = count; k < LimitCell::levels; ++k) cell.ramps[k] = cell.ramps[0];
}

namespace {

// Derivatives between the ends of a cell are interpolated. Through a chain that is not exact: by how much the
// middle is missed, the limits are reduced, and where it is missed widely, the axes are not known.
void judge_interpolation(LimitCell& cell, const PathRates& middle,
                         const std::array<std::size_t, LimitCell::most_axes>& moving) {
  double second = 1e-12, third = 1e-12, second_missed = 0, third_missed = 0;
  for (int k = 0; k < cell.known_axes; ++k) {
    const AxisOnCell& axis = cell.axes[static_cast<std::size_t>(k)];
    const std::size_t i = moving[static_cast<std::size_t>(k)];
    const AxisRates q = exact_rates(axis, 0.5, cell.end - cell.at);
    const double a = 1 / static_cast<double>(axis.acceleration), j = 1 / static_cast<double>(axis.jerk);
    second = std::max({second, a * std::abs(middle[1][i]), a * std::abs(static_cast<double>(axis.begin[1]))});
    third = std::max({third, j * std::abs(middle[2][i]), j * std::abs(static_cast<double>(axis.begin[2]))});
    second_missed = std::max(second_missed, a * std::abs(middle[1][i] - q.second));
    third_missed = std::max(third_missed, j * std::abs(middle[2][i] - q.third));
  }
  const double missed = second_missed / second + third_missed / third;
  if (!(missed <= most_missed)) {
    cell.known_axes = 0;
    return;
  }
  for (int k = 0; k < cell.known_axes; ++k) {
    AxisOnCell& axis = cell.axes[static_cast<std::size_t>(k)];
    axis.acceleration /= static_cast<float>(1 + missed);
    axis.jerk /= static_cast<float>(1 + missed);
  }
}

// What the cell keeps of its axes; `by_axis`: they can be checked one by one.
void keep_axes(LimitCell& cell, const PathRates& begins, const PathRates& ends, const CellRates& rates,
               const PathRates* middle, const Limits& limits, bool by_axis) {
  std::array<std::size_t, LimitCell::most_axes> moving{};
  cell.axis_count = cell.known_axes = 0;
  double top = fastest;
  if (rates.curvature > 0 && limits.centripetal_acceleration > 0)
    top = std::min(top, std::sqrt(limits.centripetal_acceleration / rates.curvature));
  cell.reachable = top;
  if (!cell.rapid) top = std::min(top, cell.feed * highest_override);
  std::size_t count = 0;
  for (std::size_t i = 0; i < axis_count; ++i) {
    if (rates.first[i] <= 0 && rates.second[i] <= 0 && rates.third[i] <= 0) continue;
    if (count == LimitCell::most_axes) return;
    const AxisLimits& axis = limits.axes[i];
    moving[count] = i;
    AxisOnCell& kept = cell.axes[count++];
    for (std::size_t n = 0; n < 3; ++n) {
      kept.begin[n] = static_cast<float>(begins[n][i]);
      kept.end[n] = static_cast<float>(ends[n][i]);
    }
    kept.acceleration = static_cast<float>(axis.acceleration);
    kept.jerk = static_cast<float>(axis.jerk);
    const double velocity = cell.rapid ? axis.rapid_velocity : axis.velocity;
    if (rates.first[i] > 0) {
      top = std::min(top, velocity / rates.first[i]);
      cell.reachable = std::min(cell.reachable, velocity / rates.first[i]);
    }
    if (rates.second[i] > 0)
      top = std::min(top, std::sqrt(top_normal_share * axis.acceleration / rates.second[i]));
    if (rates.third[i] > 0) top = std::min(top, std::cbrt(top_bend_share * axis.jerk / rates.third[i]));
  }
  cell.known_axes = static_cast<int>(count);
  if (middle != nullptr) judge_interpolation(cell, *middle, moving);
  if (!by_axis) return;
  cell.axis_count = cell.known_axes;
  cell.top = std::max(cell.speed, top);
}

}  // namespace

double join_speed(const AxisValues& turn, double reach, const Limits& limits) {
  double speed = fastest;
  for (std::size_t i = 0; i < axis_count; ++i) {
    if (turn[i] == 0) continue;
    speed = std::min(speed, std::cbrt(bend_share * limits.axes[i].jerk * reach * reach / std::abs(turn[i])));
  }
  return speed;
}

void CellBuilder::start(const ModeLimits& limits, const geometry::Chain* chain, double tool_length) {
  limits_ = limits;
  for (Limits& mode : limits_)
    for (AxisLimits& axis : mode.axes) {
      const double share = chain != nullptr ? chained_share : 1;
      axis.velocity *= share;
      axis.rapid_velocity *= share;
      axis.acceleration *= share;
      axis.jerk *= share;
    }
  chain_ = chain;
  tool_length_ = tool_length;
  block_ = 0;
  at_ = 0;
  fresh_ = true;
  stop_ = false;
}

PathRates CellBuilder::rates_at(const BlendedPath& path, std::uint64_t block, double s, double inside) const {
  const PathRates rates = path.derivatives(block, s, inside);
  if (chain_ == nullptr) return rates;
  return machine_rates(path.position(block, s), rates, chain_, tool_length_);
}

LimitCell CellBuilder::make(const BlendedPath& path, double from, double to) const {
  const PathBlock& block = path[block_];
  const Limits& limits = limits_[block.mode];
  LimitCell cell;
  cell.at = from;
  cell.end = to;
  cell.feed = block.feed;
  cell.rapid = block.rapid;
  cell.block = block_;
  const double middle = (from + to) / 2, length = to - from;
  PathRates begins = path.derivatives(block_, from, middle), ends;
  const bool bends = path.bend_reach(block_, middle) > 0;
  if (block.path.is_arc() || bends) {
    ends = path.derivatives(block_, to, middle);
  } else {  // a polynomial of the third degree
    ends[2] = begins[2];
    for (std::size_t i = 0; i < axis_count; ++i) {
      ends[1][i] = begins[1][i] + begins[2][i] * length;
      ends[0][i] = begins[0][i] + length * (begins[1][i] + begins[2][i] * (length / 2));
    }
  }
  double bend = 0;
  if (limits.centripetal_acceleration > 0)
    bend = std::max(std::hypot(begins[1][0], begins[1][1], begins[1][2]),
                    std::hypot(ends[1][0], ends[1][1], ends[1][2]));
  if (chain_ != nullptr) {
    begins = machine_rates(path.position(block_, from), begins, chain_, tool_length_);
    ends = machine_rates(path.position(block_, to), ends, chain_, tool_length_);
  }
  CellRates rates;
  for (std::size_t i = 0; i < axis_count; ++i) {
    rates.third[i] = std::max(std::abs(begins[2][i]), std::abs(ends[2][i]));
    rates.second[i] = std::max(std::abs(begins[1][i]), std::abs(ends[1][i]));
    // A function strays from the chord of its ends by at most f'' l^2 / 8.
    rates.first[i] =
        std::max(std::abs(begins[0][i]), std::abs(ends[0][i])) + rates.third[i] * length * length / 8;
  }
  rates.curvature = bend;
  limit_cell(cell, rates, limits);
  PathRates between;
  if (chain_ != nullptr)
    between = machine_rates(path.position(block_, middle), path.derivatives(block_, middle, middle), chain_,
                            tool_length_);
  keep_axes(cell, begins, ends, rates, chain_ != nullptr ? &between : nullptr, limits,
            block.path.is_arc() && !bends && !cell.uniform);
  cell.dense = !block.rapid && (block.path.is_curve() || block.move_length() <= longest_dense);
  return cell;
}

// How long before the end of one stretch the next may begin. At the same time t after its own start and
// before the other's end, the second has gone at most j t^3 / 6 and the first has that much left, and the
// path is left by no more than the smaller of the two. The axes must permit the sum of both motions.
double CellBuilder::overlap_time(const BlendedPath& path, const LimitCell& before,
                                 const LimitCell& after) const {
  if (!before.uniform || !after.uniform || path[before.block].path.unit() != path[after.block].path.unit())
    return 0;
  const PathRates first = rates_at(path, before.block, before.end, (before.at + before.end) / 2);
  const PathRates second = rates_at(path, after.block, after.at, (after.at + after.end) / 2);
  const RampLimits a = before.ramps[0], b = after.ramps[0];
  const BlendRules& rules = path[after.block].rules;
  const auto& axes = limits_[path[after.block].mode].axes;
  double rotary = 0, linear = 1e-9;
  for (std::size_t i = 0; i < axis_count; ++i) {
    const double q1 = std::abs(first[0][i]), q2 = std::abs(second[0][i]);
    if (q1 * a.acceleration + q2 * b.acceleration > axes[i].acceleration * (1 + 1e-9)) return 0;
    if (q1 * a.jerk + q2 * b.jerk > axes[i].jerk * (1 + 1e-9)) return 0;
    double& part = canonical::is_rotary(i) ? rotary : linear;
    part = std::max({part, q1, q2});
  }
  if (path[after.block].path.unit() == LengthUnit::degree) linear = 1e-9;
  double deviation = rules.contour_tolerance / std::max(1.0, linear);
  if (rotary > 0) deviation = std::min(deviation, rules.orientation_tolerance / (1.8 * rotary));
  deviation *= 0.98;
  const double time = std::cbrt(6 * deviation / a.jerk) + std::cbrt(6 * deviation / b.jerk);
  const double longest = std::min(std::cbrt(6 * (before.end - before.at) / a.jerk),
                                  std::cbrt(6 * (after.end - after.at) / b.jerk));
  return std::min(time, longest);
}

// Longest cell at s: arcs by 1.4 degrees, turns of the rotary axes by 2 degrees through a chain.
double CellBuilder::longest(const BlendedPath& path) const {
  const PathBlock& block = path[block_];
  double most = 1e9;
  if (block.path.is_arc() && block.path.curvature() > 0) most = arc_cell_angle / block.path.curvature();
  if (chain_ != nullptr) {
    const auto d = block.path.derivatives(0);
    const double turn = std::hypot(d[0][canonical::A], d[0][canonical::B], d[0][canonical::C]);
    if (turn > 0) most = std::min(most, 2 / turn);
  }
  return most;
}

// End of the cell that begins at `from`, at most `upto`.
double CellBuilder::cell_end(const BlendedPath& path, double from, double upto) const {
  const double knot = std::min(upto, path.next_knot(block_, from));
  double most = longest(path);
  const double reach = path.bend_reach(block_, 0.5 * (from + knot));
  if (reach > 0) most = std::min(most, bend_cell_share * reach);
  return knot - from > most ? from + (knot - from) / std::ceil((knot - from) / most) : knot;
}

void CellBuilder::extend(const BlendedPath& path, CellRing& cells, std::uint64_t keep) {
  const std::uint64_t size_before = cells.size();
  while (block_ < path.settled_blocks() && cells.size() - keep < CellRing::capacity - 64 &&
         cells.size() < size_before + most_at_once) {
    const PathBlock& block = path[block_];
    if (fresh_) {
      at_ = block.at;
      fresh_ = false;
    }
    const bool first = at_ == block.at;
    const double to = cell_end(path, at_, block.end());
    LimitCell cell = make(path, at_, to);
    cell.stop = first && block.stop;
    cell.wait_cycles = cell.stop ? block.wait_cycles : 0;
    cell.position_check = cell.stop && block.position_check;
    if (cell.stop && block.overlap && cells.size() > 0)
      cell.overlap = overlap_time(path, cells[cells.size() - 1], cell);
    cells.push(cell);
    at_ = to;
    if (to >= block.end()) ++block_;
  }
}

void CellBuilder::resume(std::uint64_t block, double s) {
  block_ = block;
  at_ = s;
  fresh_ = stop_ = false;
}

bool CellBuilder::extend_back(const BlendedPath& path, CellRing& cells, std::uint64_t keep,
                              std::uint64_t oldest) {
  const std::uint64_t size_before = cells.size();
  while (true) {
    const PathBlock& block = path[block_];
    // The cells of a block are cut from its start, so they are counted before they get their places in the
    // opposite order.
    std::uint64_t count = 0;
    for (double s = block.at; s < at_; s = cell_end(path, s, at_)) ++count;
    const std::uint64_t room =
        CellRing::capacity - 64 - std::min(CellRing::capacity - 64, cells.size() - keep);
    double from = block.at;
    if (count > room) {
      if (room < most_at_once) return false;
      for (; count > room; --count) from = cell_end(path, from, at_);
    }
    const std::uint64_t first = cells.size();
    double s = from;
    for (std::uint64_t k = 0; k < count; ++k) {
      const double to = cell_end(path, s, at_);
      LimitCell cell = make(path, s, to);
      cell.at = -to;
      cell.end = -s;
      for (AxisOnCell& axis : cell.axes) {
        std::swap(axis.begin, axis.end);
        for (const std::size_t odd : {0, 2})
          axis.begin[odd] = -axis.begin[odd], axis.end[odd] = -axis.end[odd];
      }
      cells[first + count - 1 - k] = cell;
      s = to;
    }
    cells.append(count);
    if (count > 0 && stop_) cells[first].stop = true;
    stop_ = (from == block.at && block.stop) || (stop_ && count == 0);
    at_ = from;
    if (from > block.at) return false;
    if (block_ <= oldest) return true;
    --block_;
    if (cells.size() >= size_before + most_at_once) return false;
  }
}

}  // namespace trunnion::motion
