// SPDX-License-Identifier: Apache-2.0
#include "language/nurbs_curve.hpp"

#include <algorithm>
#include <cmath>

namespace trunnion::language {
namespace {

/// A span is never cut finer than this part of itself, whatever the tolerance.
constexpr double smallest_step = 1.0 / 65536;

double distance_from_chord(const Vector3& a, const Vector3& b, const Vector3& p) {
  const Vector3 d{b[0] - a[0], b[1] - a[1], b[2] - a[2]};
  const Vector3 e{p[0] - a[0], p[1] - a[1], p[2] - a[2]};
  const double square = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
  const double along =
      square > 0 ? std::clamp((d[0] * e[0] + d[1] * e[1] + d[2] * e[2]) / square, 0.0, 1.0) : 0.0;
  return std::hypot(e[0] - along * d[0], e[1] - along * d[1], e[2] - along * d[2]);
}

}  // namespace

void NurbsCurve::start(std::uint32_t order, double tolerance) {
  order_ = order;
  tolerance_ = tolerance;
  active_ = true;
  knot_count_ = point_count_ = 0;
  in_span_ = false;
}

AlarmNumber NurbsCurve::add(double knot, const ControlPoint& point) {
  if (knot_count_ != point_count_) return AlarmNumber::curve_words;
  if (point_count_ == 0) at_ = point.point;
  points_[point_count_ % points_.size()] = point;
  ++point_count_;
  return add_knot(knot);
}

AlarmNumber NurbsCurve::add(double knot) {
  if (point_count_ < order_) return AlarmNumber::curve_control_points;
  return add_knot(knot);
}

AlarmNumber NurbsCurve::add_knot(double value) {
  if (knot_count_ > 0 && value < knot(knot_count_ - 1)) return AlarmNumber::curve_knots;
  // A clamped curve begins at its first control point and ends at its last one: only that is a path.
  const bool first = knot_count_ > 0 && knot_count_ < order_;
  const bool last = knot_count_ > point_count_;
  if ((first || last) && value != knot(knot_count_ - 1)) return AlarmNumber::curve_knots;
  knots_[knot_count_ % knots_.size()] = value;
  ++knot_count_;
  begin_span();
  return AlarmNumber::none;
}

// The newest knot i completes the span that begins at knot i - degree.
void NurbsCurve::begin_span() {
  const std::uint32_t degree = order_ - 1;
  if (knot_count_ < 2 * order_ - 1 || knot_count_ >= point_count_ + order_) return;
  span_ = knot_count_ - 1 - degree;
  const double width = knot(span_ + 1) - knot(span_);
  in_span_ = width > 0;
  u_ = knot(span_);
  step_ = width;
}

bool NurbsCurve::next(Vector3& end) {
  if (!in_span_) {
    if (knot_count_ == point_count_ + order_ && knot_count_ > order_) active_ = false;
    return false;
  }
  const double last = knot(span_ + 1);
  const double smallest = (last - knot(span_)) * smallest_step;
  for (;;) {
    const double to = u_ + step_ < last - smallest ? u_ + step_ : last;
    end = evaluate(to);
    double error = 0;
    for (const double part : {0.25, 0.5, 0.75}) {
      error = std::max(error, distance_from_chord(at_, end, evaluate(u_ + part * (to - u_))));
    }
    const double half = (to - u_) / 2;
    // Knots so close that numbers run out end the cutting too.
    if (error > tolerance_ && step_ > smallest && u_ + half > u_ && u_ + half < to) {
      step_ = half;
      continue;
    }
    u_ = to;
    at_ = end;
    in_span_ = to < last;
    step_ *= 2;
    return true;
  }
}

// De Boor's scheme on homogeneous points.
Vector3 NurbsCurve::evaluate(double u) const {
  std::array<std::array<double, 4>, most_order> d{};
  const std::uint32_t degree = order_ - 1;
  for (std::uint32_t i = 0; i < order_; ++i) {
    const ControlPoint& c = control(span_ - degree + i);
    d[i] = {c.point[0] * c.weight, c.point[1] * c.weight, c.point[2] * c.weight, c.weight};
  }
  for (std::uint32_t level = 1; level <= degree; ++level) {
    for (std::uint32_t i = degree; i >= level; --i) {
      const double low = knot(span_ - degree + i);
      const double high = knot(span_ + 1 + i - level);
      const double part = (u - low) / (high - low);
      for (std::size_t k = 0; k < 4; ++k) d[i][k] = (1 - part) * d[i - 1][k] + part * d[i][k];
    }
  }
  const auto& p = d[degree];
  return {p[0] / p[3], p[1] / p[3], p[2] / p[3]};
}

}  // namespace trunnion::language
