#include "motion/corner_limits.hpp"

#include <algorithm>
#include <cmath>

namespace trunnion::motion {
namespace {

using language::axis_count;

// Part of the tolerance that is planned with; the rest covers rounding and the offset of cycles to corners.
constexpr double tolerance_share = 0.95;

double square(double x) { return x * x; }

struct PathRates {
  double linear, rotary;
};

// Size of a change of direction in the frame of the command, linear and rotary apart.
PathRates difference(const AxisValues& a, const AxisValues& b) {
  double linear = 0;
  double rotary = 0;
  for (std::size_t i = 0; i < axis_count; ++i) {
    (i >= language::A && i <= language::C ? rotary : linear) += square(a[i] - b[i]);
  }
  return {std::sqrt(linear), std::sqrt(rotary)};
}

// Weighted sum of the changes of direction around the start of segment `index` at the speed with half window
// h.
double contour_sum(const SegmentRing& ring, std::uint64_t index, double h) {
  double sum = ring[index].turn * h / 4;
  const auto weigh_bend = [&](double bend, double x1, double x2) {
    return bend * h * h / 12 * (std::pow(1 - x1 / h, 3) - std::pow(1 - std::min(x2, h) / h, 3));
  };
  double x = 0;
  for (std::uint64_t i = index; x < h; ++i) {
    const double next = x + ring[i].path.length();
    if (ring[i].bend > 0) sum += weigh_bend(ring[i].bend, x, next);
    x = next;
    if (i + 1 >= ring.size() || ring[i + 1].full_stop) break;
    if (x < h) sum += ring[i + 1].turn * square(h - x) / (4 * h);
  }
  x = 0;
  for (std::uint64_t i = index; i > ring.oldest() && x < h && !ring[i].full_stop; --i) {
    const PlannedSegment& before = ring[i - 1];
    const double next = x + before.path.length();
    if (before.bend > 0) sum += weigh_bend(before.bend, x, next);
    x = next;
    if (x < h && !before.full_stop) sum += before.turn * square(h - x) / (4 * h);
  }
  return sum;
}

}  // namespace

void rate_segment(PlannedSegment& segment, const PlannedSegment* before, const CornerRules& rules) {
  double limit = segment.rapid ? 1e9 : segment.feed * highest_override;
  for (std::size_t i = 0; i < axis_count; ++i) {
    const AxisLimits& axis = rules.limits.axes[i];
    const double velocity = segment.rapid ? axis.rapid_velocity : axis.velocity;
    if (segment.rates.largest[i] > 0) limit = std::min(limit, velocity / segment.rates.largest[i]);
    if (segment.rates.bend[i] > 0) {
      const double normal = normal_share * rules.acceleration_share * axis.acceleration;
      limit = std::min(limit, std::sqrt(normal / segment.rates.bend[i]));
    }
  }
  const double curvature = segment.path.curvature();
  segment.bend = curvature / rules.limits.arc_tolerance;
  if (curvature > 0 && rules.contour_window > 0) {
    limit = std::min(limit, std::sqrt(24 * tolerance_share / segment.bend) / rules.contour_window);
  }
  segment.limit = limit;
  if (before == nullptr) return;
  const PathRates turn =
      difference(segment.path.derivative(0), before->path.derivative(before->path.length()));
  segment.turn = std::max(turn.linear / rules.limits.contour_tolerance,
                          turn.rotary / rules.limits.orientation_tolerance);
}

// The sum is convex in the speed and 0 at 0, so a chord between a speed that keeps the tolerance and one that
// does not meets the tolerance at a speed that keeps it: every step of the search is safe.
double contour_speed(const SegmentRing& ring, std::uint64_t index, double highest, const CornerRules& rules) {
  if (rules.contour_window <= 0) return highest;
  const auto sum_at = [&](double speed) {
    return contour_sum(ring, index, speed * rules.contour_window / 2);
  };
  double above = highest;
  double sum_above = sum_at(above);
  if (sum_above <= tolerance_share) return highest;
  double kept = above * tolerance_share / sum_above;
  for (int k = 0; k < 4; ++k) {
    const double sum_kept = sum_at(kept);
    if (sum_kept > 0.97 * tolerance_share) break;
    const double middle = std::sqrt(kept * above);
    const double sum_middle = sum_at(middle);
    if (sum_middle <= tolerance_share) {
      kept = middle;
      continue;
    }
    above = middle;
    sum_above = sum_middle;
    kept += (above - kept) * (tolerance_share - sum_kept) / (sum_above - sum_kept);
  }
  return kept;
}

double tangential_acceleration(const SegmentRing& ring, std::uint64_t index, const CornerRules& rules) {
  const PlannedSegment& segment = ring[index];
  AxisValues need{};
  for (std::size_t i = 0; i < axis_count; ++i) need[i] = square(segment.limit) * segment.rates.bend[i];
  bool has_corner = false;
  const auto add_corner = [&](const PlannedSegment& first, const PlannedSegment& second) {
    double speed = std::min(first.limit, second.limit);
    if (first.exit_zone > 0) speed = std::min(speed, first.exit_limit);
    if (second.entry_zone > 0) speed = std::min(speed, second.entry_limit);
    const double shorter = std::min(first.path.length(), second.path.length());
    const double rate = speed * std::max(1 / rules.window, speed / shorter);
    for (std::size_t i = 0; i < axis_count; ++i) {
      need[i] += rate * std::abs(second.rates.at_start[i] - first.rates.at_end[i]);
    }
    has_corner = true;
  };
  if (!segment.full_stop && index > ring.oldest()) add_corner(ring[index - 1], segment);
  if (index + 1 < ring.size() && !ring[index + 1].full_stop) add_corner(segment, ring[index + 1]);
  // The speed gained on one of several short segments is still there on the next ones, so all that a window
  // can hold get an acceleration every one of them stands.
  AxisValues largest = segment.rates.largest;
  const double reach = segment.limit * rules.reach_window;
  const auto include = [&](const PlannedSegment& other) {
    for (std::size_t i = 0; i < axis_count; ++i) largest[i] = std::max(largest[i], other.rates.largest[i]);
  };
  if (segment.path.length() < reach) {
    for (std::uint64_t i = index; i > ring.oldest() && !ring[i].full_stop; --i) {
      if (ring[i].at < segment.at - reach) break;
      include(ring[i - 1]);
    }
    for (std::uint64_t i = index + 1; i < ring.size() && !ring[i].full_stop; ++i) {
      if (ring[i].at > segment.end() + reach) break;
      include(ring[i]);
    }
  }
  double acceleration = 1e12;
  for (std::size_t i = 0; i < axis_count; ++i) {
    if (largest[i] <= 0) continue;
    const double budget = rules.acceleration_share * rules.limits.axes[i].acceleration;
    const double least = has_corner ? least_normal_share * budget : 0;
    const double normal = std::clamp(need[i], least, normal_share * budget);
    acceleration = std::min(acceleration, (budget - normal) / largest[i]);
  }
  return acceleration;
}

// With v the speed at this corner, a window that ends behind it saw the first rate at up to v + a1 t1 and the
// second at up to v + a2 t2, t1 + t2 = T, where a1 is the largest acceleration between the two; neither gain
// exceeds the speed limit. The worst split of T gives the axis with the larger a |q'| its time first.
double acceleration_speed(const SegmentRing& ring, std::uint64_t index, double highest,
                          const CornerRules& rules) {
  const PlannedSegment& second = ring[index];
  const double window = rules.window;
  const double second_time = second.limit / second.acceleration;
  double speed = highest;
  double distance = 0;
  double acceleration = 0;
  double fastest = 0;
  for (std::uint64_t k = index; k > ring.oldest() && !ring[k].full_stop; --k) {
    const PlannedSegment& first = ring[k - 1];
    // A window can only hold both ends of this stretch when it is passed within T.
    const double apart = distance / rules.reach_window - acceleration * rules.reach_window / 2;
    if (apart >= speed || (k < index && distance >= fastest * rules.reach_window)) break;
    acceleration = std::max(acceleration, first.acceleration);
    fastest = std::max(fastest, first.limit);
    const double first_time = fastest / acceleration;
    double held = speed;
    for (std::size_t i = 0; i < axis_count; ++i) {
      const double change = std::abs(second.rates.at_start[i] - first.rates.at_end[i]);
      if (change <= 0) continue;
      const double first_rate = acceleration * first.rates.largest[i];
      const double second_rate = second.acceleration * second.rates.largest[i];
      const bool first_leads = first_rate > second_rate;
      const double lead = std::min(window, first_leads ? first_time : second_time);
      const double rest = std::min(window - lead, first_leads ? second_time : first_time);
      const double gain = std::max(first_rate, second_rate) * lead + std::min(first_rate, second_rate) * rest;
      const double bend =
          std::max(square(first.limit) * first.rates.bend[i], square(second.limit) * second.rates.bend[i]);
      const double budget = rules.acceleration_share * rules.limits.axes[i].acceleration;
      held = std::min(held, std::max(0.0, (budget - bend) * window - gain) / change);
    }
    speed = std::min(speed, std::max(held, apart));
    distance += first.path.length();
  }
  return speed;
}

}  // namespace trunnion::motion
