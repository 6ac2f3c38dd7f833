// SPDX-License-Identifier: Apache-2.0
#include "motion/smoothing_spline.hpp"

#include <algorithm>
#include <cmath>

namespace trunnion::motion {
namespace {

using canonical::axis_count;

// Widths, mm: of a new span, as a part of the window, and at most.
constexpr double first_width = 0.1, widest = 3, narrowest = 4e-3;
// A width outside its tube becomes narrower by what it is outside, within these factors, in each round.
constexpr double fastest_step = 0.3, slowest_step = 0.9, least_change = 0.98;
constexpr int most_refinements = 40;
// On a circle the curve is off by l^6 / R^5: mm that it may be.
constexpr double circle_bias = 1e-4;
// How fast the width may change along the curve: by its own size and by this share of the way.
constexpr double width_slope = 0.6;
// Share of a window that is taken, and the widths that have to lie between its end and what is taken.
constexpr double taken_share = 0.7, widths_ahead = 5;
// Spans that the taken ones have knots of.
constexpr std::size_t shared_spans = 3;
constexpr double end_weight = 1e5;

}  // namespace

SmoothingSpline::SmoothingSpline() {
  spans_.reserve(most_spans + 1);
  next_.reserve(most_spans + 1);
  coefficients_.reserve(most_spans + 4);
  right_.reserve(most_spans + 4);
  band_.reserve(most_spans + 4);
  wanted_.reserve(most_spans + 1);
  tangents_.reserve(most_spans + 2);
}

void SmoothingSpline::clear() {
  spans_.clear();
  coefficients_.clear();
  kept_ = taken_ = 0;
  begun_ = false;
  moves_ = {};
}

CurveSpan SmoothingSpline::operator[](std::size_t index) const {
  const Span& span = spans_[kept_ + index];
  return {span.u, span.length, cubic(kept_ + index)};
}

// What was taken before stays as far as the next spans need its knots and coefficients.
void SmoothingSpline::begin(std::span<const Vertex> window) {
  if (!begun_) {
    begun_ = true;
    end_ = window.front().u;
  }
  const std::size_t kept = std::min(taken_, shared_spans), dropped = taken_ - kept;
  spans_.erase(spans_.begin(), spans_.begin() + static_cast<std::ptrdiff_t>(dropped));
  coefficients_.erase(coefficients_.begin(), coefficients_.begin() + static_cast<std::ptrdiff_t>(dropped));
  kept_ = taken_ = kept;
}

void SmoothingSpline::append(std::span<const Vertex> window) {
  const double to = window.back().u, from = kept_ < spans_.size() ? spans_[kept_].u : end_;
  if (!(to > end_)) return;
  const double width = std::clamp((to - from) * first_width, narrowest, widest);
  const std::size_t room = most_spans - spans_.size();
  const double count =
      std::clamp(std::round((to - end_) / width), 1.0, static_cast<double>(std::max<std::size_t>(room, 1)));
  const double length = (to - end_) / count;
  for (double k = 0; k < count; ++k) {
    Span span;
    span.u = end_ + k * length;
    span.length = length;
    span.width = width;
    spans_.push_back(span);
  }
  end_ = to;
}

// Axes that have moved since the curve began; the others stay where they are.
void SmoothingSpline::choose_axes(std::span<const Vertex> window) {
  axis_count_ = 0;
  for (std::size_t i = 0; i < axis_count; ++i) {
    for (const Vertex& vertex : window) moves_[i] = moves_[i] || vertex.at[i] != window.front().at[i];
    if (moves_[i]) axes_[axis_count_++] = i;
  }
  coefficients_.resize(spans_.size() + 3);
  for (std::size_t i = 0; i < axis_count; ++i) {
    if (moves_[i]) continue;
    for (AxisValues& coefficient : coefficients_) coefficient[i] = window.front().at[i];
  }
}

double SmoothingSpline::knot(std::ptrdiff_t index) const {
  const auto count = static_cast<std::ptrdiff_t>(spans_.size());
  if (index < 0) return spans_.front().u + static_cast<double>(index) * spans_.front().length;
  if (index < count) return spans_[static_cast<std::size_t>(index)].u;
  return end_ + static_cast<double>(index - count) * spans_.back().length;
}

// The four B-splines on a span as polynomials of s in 0..1, by the six knots about it.
void SmoothingSpline::set_basis(std::size_t index) {
  const auto k = static_cast<std::ptrdiff_t>(index);
  const double a = knot(k - 2), b = knot(k - 1), c = knot(k), d = knot(k + 1), e = knot(k + 2),
               f = knot(k + 3);
  const double h = d - c, first = h * h / ((d - b) * (d - a)), last = h * h / ((f - c) * (e - c));
  const double over = 1 / ((e - b) * (d - b));
  const double second = (c - b) * (c - b) * over, slope = 3 * h * (c - b) * over, bend = 3 * h * h * over;
  const double third = -bend / 3 - last - h * h / ((e - c) * (e - b));
  spans_[index].basis = {{{first, 1 - first - second, second, 0},
                          {-3 * first, 3 * first - slope, slope, 0},
                          {3 * first, -3 * first - bend, bend, 0},
                          {-first, first - third - last, third, last}}};
}

namespace {

// The vertex at or before u, from a guess on.
std::size_t leg_at(std::span<const Vertex> window, double u, std::size_t guess) {
  std::size_t k = std::min(guess, window.size() - 2);
  while (k > 0 && window[k].u > u) --k;
  while (k + 2 < window.size() && window[k + 1].u <= u) ++k;
  return k;
}

std::size_t leg_at(std::span<const Vertex> window, double u) {
  const auto after =
      std::upper_bound(window.begin(), window.end(), u, [](double x, const Vertex& v) { return x < v.u; });
  const auto index = static_cast<std::size_t>(after - window.begin());
  return std::min(index > 0 ? index - 1 : 0, window.size() - 2);
}

}  // namespace

// Three places of Gauss on each leg are exact: a line by a third power is of the fourth degree.
void SmoothingSpline::set_moments(Span& span, std::span<const Vertex> window) const {
  constexpr std::array<double, 3> place{0.1127016653792583, 0.5, 0.8872983346207417},
      weight{5.0 / 18, 8.0 / 18, 5.0 / 18};
  span.moments = {};
  const double end = span.u + span.length;
  double from = span.u;
  for (std::size_t k = leg_at(window, from); from < end; ++k) {
    const bool last = k + 2 >= window.size() || window[k + 1].u >= end;
    const double to = last ? end : window[k + 1].u, whole = window[k + 1].u - window[k].u;
    for (std::size_t n = 0; n < 3; ++n) {
      const double u = from + (to - from) * place[n], share = (u - window[k].u) / whole;
      const double s = (u - span.u) / span.length, part = weight[n] * (to - from) / span.length;
      for (std::size_t j = 0; j < axis_count_; ++j) {
        const std::size_t i = axes_[j];
        double value = part * (window[k].at[i] + share * (window[k + 1].at[i] - window[k].at[i]));
        for (AxisValues& moment : span.moments) {
          moment[i] += value;
          value *= s;
        }
      }
    }
    if (last) break;
    from = to;
  }
  span.has_moments = true;
}

// What a span adds to the normal equations, by rows of its four coefficients.
void SmoothingSpline::add_span(std::size_t index, std::span<const Vertex> window, bool ends) {
  Span& span = spans_[index];
  if (!span.has_moments) set_moments(span, window);
  set_basis(index);
  const auto& basis = span.basis;
  const double h3 = span.length * span.length * span.length, l3 = span.width * span.width * span.width;
  const double near = span.length / (l3 * l3), smooth = 36 / (h3 * h3) * span.length;
  std::array<std::array<double, 4>, 4> product{};  // of the powers of s with the coefficients
  for (std::size_t m = 0; m < 4; ++m)
    for (std::size_t j = 0; j < 4; ++j)
      for (std::size_t n = 0; n < 4; ++n) product[m][j] += basis[n][j] / static_cast<double>(m + n + 1);
  const std::size_t row = index - kept_;
  for (std::size_t j = 0; j < 4; ++j) {
    for (std::size_t i = j; i < 4; ++i) {
      double sum = 0;
      for (std::size_t m = 0; m < 4; ++m) sum += basis[m][i] * product[m][j];
      band_[row + j][i - j] += near * sum + smooth * basis[3][i] * basis[3][j];
    }
    for (std::size_t n = 0; n < axis_count_; ++n) {
      const std::size_t axis = axes_[n];
      double sum = 0;
      for (std::size_t m = 0; m < 4; ++m) sum += basis[m][j] * span.moments[m][axis];
      right_[row + j][axis] += near * sum;
    }
  }
  const auto meet = [&](const std::array<double, 4>& values, const AxisValues& place) {
    const double weight = end_weight * std::max(near, smooth);
    for (std::size_t j = 0; j < 4; ++j) {
      for (std::size_t i = j; i < 4; ++i) band_[row + j][i - j] += weight * values[i] * values[j];
      for (std::size_t n = 0; n < axis_count_; ++n)
        right_[row + j][axes_[n]] += weight * values[j] * place[axes_[n]];
    }
  };
  if (index == 0 && kept_ == 0) meet(basis[0], window.front().at);
  if (ends && index + 1 == spans_.size()) {
    std::array<double, 4> last{};
    for (const auto& power : basis)
      for (std::size_t j = 0; j < 4; ++j) last[j] += power[j];
    meet(last, window.back().at);
  }
}

// Symmetric equations with three diagonals beside the main one, without pivots. The first three coefficients
// of a curve that continues are those of the spans taken before.
void SmoothingSpline::solve(std::span<const Vertex> window, bool ends) {
  const std::size_t count = spans_.size() - kept_ + 3, fixed = kept_ > 0 ? 3 : 0;
  band_.assign(count, {});
  right_.assign(count, {});
  for (std::size_t k = kept_; k < spans_.size(); ++k) add_span(k, window, ends);
  AxisValues* const x = coefficients_.data() + kept_;
  for (std::size_t j = 0; j < fixed; ++j)
    for (std::size_t d = 1; d < 4; ++d) {
      if (j + d < fixed || j + d >= count) continue;
      for (std::size_t n = 0; n < axis_count_; ++n) right_[j + d][axes_[n]] -= band_[j][d] * x[j][axes_[n]];
    }
  for (std::size_t j = fixed; j < count; ++j) {
    const double inverse = 1 / band_[j][0];
    for (std::size_t r = 1; r < 4 && j + r < count; ++r) {
      const double factor = band_[j][r] * inverse;
      for (std::size_t c = r; c < 4 && j + c < count; ++c) band_[j + r][c - r] -= factor * band_[j][c];
      for (std::size_t n = 0; n < axis_count_; ++n) right_[j + r][axes_[n]] -= factor * right_[j][axes_[n]];
    }
    band_[j][0] = inverse;
  }
  for (std::size_t j = count; j-- > fixed;)
    for (std::size_t n = 0; n < axis_count_; ++n) {
      const std::size_t i = axes_[n];
      double sum = right_[j][i];
      for (std::size_t r = 1; r < 4 && j + r < count; ++r) sum -= band_[j][r] * x[j + r][i];
      x[j][i] = sum * band_[j][0];
    }
}

Cubic SmoothingSpline::cubic(std::size_t index) const {
  const Span& span = spans_[index];
  Cubic curve{};
  for (std::size_t i = 0; i < axis_count; ++i) {
    if (!moves_[i]) {
      curve[0][i] = coefficients_[index][i];
      continue;
    }
    double scale = 1;
    for (std::size_t m = 0; m < 4; ++m) {
      double sum = 0;
      for (std::size_t j = 0; j < 4; ++j) sum += span.basis[m][j] * coefficients_[index + j][i];
      curve[m][i] = scale * sum;
      scale /= span.length;
    }
  }
  return curve;
}

// By what factor a span leaves the tube of the vertices, at most. `vertex` is a guess of where it begins.
double SmoothingSpline::excess(std::size_t index, std::span<const Vertex> window, std::size_t& vertex) const {
  const Span& span = spans_[index];
  const Cubic curve = cubic(index);
  const double end = span.u + span.length;
  vertex = leg_at(window, span.u, vertex);
  double worst = 0, from = span.u;
  for (std::size_t k = vertex;; ++k) {
    const bool last = k + 2 >= window.size() || window[k + 1].u >= end;
    const double to = last ? end : window[k + 1].u, whole = window[k + 1].u - window[k].u;
    const double h = to - from, t = from - span.u, share = (from - window[k].u) / whole;
    std::array<double, 4> linear{}, rotary{};  // squares at the Bezier points
    for (std::size_t n = 0; n < axis_count_; ++n) {
      const std::size_t i = axes_[n];
      const double way = window[k + 1].at[i] - window[k].at[i];
      const double c3 = curve[3][i] * h * h * h, c2 = (curve[2][i] + 3 * t * curve[3][i]) * h * h;
      const double c1 = (curve[1][i] + t * (2 * curve[2][i] + 3 * t * curve[3][i]) - way / whole) * h;
      const double c0 = curve[0][i] + t * (curve[1][i] + t * (curve[2][i] + t * curve[3][i])) -
                        (window[k].at[i] + share * way);
      auto& squares = canonical::is_rotary(i) ? rotary : linear;
      const std::array<double, 4> points{c0, c0 + c1 / 3, c0 + (2 * c1 + c2) / 3, c0 + c1 + c2 + c3};
      for (std::size_t m = 0; m < 4; ++m) squares[m] += points[m] * points[m];
    }
    const double tube = std::max(window[k].linear, window[k + 1].linear);
    const double turn = std::max(window[k].rotary, window[k + 1].rotary);
    for (std::size_t m = 0; m < 4; ++m) {
      worst = std::max(worst, linear[m] / (tube * tube));
      worst = std::max(worst, rotary[m] / (turn * turn));
    }
    if (last) break;
    from = to;
  }
  return std::sqrt(worst);
}

// Curvature of X Y Z over a span and its neighbours, 1/mm.
double SmoothingSpline::bend(std::size_t index) const {
  const std::size_t from = index > kept_ ? index - 1 : index, to = std::min(index + 2, spans_.size());
  const AxisValues &a = tangents_[from - kept_], &b = tangents_[to - kept_];
  return std::hypot(b[0] - a[0], b[1] - a[1], b[2] - a[2]) /
         (spans_[to - 1].u + spans_[to - 1].length - spans_[from].u);
}

// Narrower widths where a tube or the curvature asks for them. True when the equations have to be solved
// again.
bool SmoothingSpline::refine(std::span<const Vertex> window) {
  const std::size_t count = spans_.size();
  wanted_.resize(count);
  tangents_.resize(count - kept_ + 1);
  const auto tangent = [&](std::size_t place, const Cubic& curve, double t) {
    AxisValues direction{};
    for (std::size_t i = 0; i < 3; ++i)
      direction[i] = curve[1][i] + t * (2 * curve[2][i] + 3 * t * curve[3][i]);
    const double size = std::max(std::hypot(direction[0], direction[1], direction[2]), 1e-6);
    for (std::size_t i = 0; i < 3; ++i) direction[i] /= size;
    tangents_[place] = direction;
  };
  std::size_t vertex = leg_at(window, spans_[kept_].u);
  for (std::size_t k = kept_; k < count; ++k) {
    const double outside = excess(k, window, vertex);
    wanted_[k] = spans_[k].width * (outside > 1 ? std::clamp(1 / outside, fastest_step, slowest_step) : 1);
    const Cubic curve = cubic(k);
    tangent(k - kept_, curve, 0);
    if (k + 1 == count) tangent(count - kept_, curve, spans_[k].length);
  }
  for (std::size_t k = kept_; k < count; ++k) {
    // A curve with noise on it has a curvature of its own at short spans: not more than one step at a time.
    const double width = spans_[k].width, curvature = std::max(bend(k), 1e-6);
    const double most =
        std::pow(circle_bias / (curvature * curvature * curvature * curvature * curvature), 1.0 / 6);
    constexpr double bend_step = 0.7, clear = 1.1;
    if (width > clear * most && wanted_[k] > bend_step * width)
      wanted_[k] = std::max(most, bend_step * width);
  }
  grade();
  return split();
}

void SmoothingSpline::grade() {
  const auto limit = [&](std::size_t k, std::size_t neighbour) {
    wanted_[k] = std::min(wanted_[k], 2 * wanted_[neighbour] +
                                          width_slope * 0.5 * (spans_[k].length + spans_[neighbour].length));
  };
  for (std::size_t k = kept_ + 1; k < spans_.size(); ++k) limit(k, k - 1);
  for (std::size_t k = spans_.size() - 1; k-- > kept_;) limit(k, k + 1);
}

// Spans no longer than their width, where taken spans do not have knots of them.
bool SmoothingSpline::split() {
  bool changed = false;
  const std::size_t free = kept_ > 0 ? kept_ + shared_spans : 0;
  next_.assign(spans_.begin(), spans_.begin() + static_cast<std::ptrdiff_t>(kept_));
  for (std::size_t k = kept_; k < spans_.size(); ++k) {
    Span& span = spans_[k];
    if (wanted_[k] < least_change * span.width) {
      changed = true;
      span.width = wanted_[k];
    }
    std::size_t parts = 1;
    const std::size_t rest = spans_.size() - k;
    while (k >= free && span.length / static_cast<double>(parts) > span.width &&
           next_.size() + 2 * parts + rest < most_spans)
      parts *= 2;
    if (parts == 1) {
      next_.push_back(span);
      continue;
    }
    changed = true;
    Span part = span;
    part.has_moments = false;
    part.length = span.length / static_cast<double>(parts);
    for (std::size_t n = 0; n < parts; ++n) {
      part.u = span.u + static_cast<double>(n) * part.length;
      next_.push_back(part);
    }
  }
  spans_.swap(next_);
  return changed;
}

void SmoothingSpline::fit(std::span<const Vertex> window, bool ends) {
  begin(window);
  append(window);
  for (int round = 0; round < most_refinements; ++round) {
    choose_axes(window);
    solve(window, ends);
    if (round + 1 == most_refinements || !refine(window)) break;
  }
  const std::size_t count = spans_.size();
  if (ends) {
    taken_ = count;
    return;
  }
  const double from = spans_[kept_].u, limit = from + taken_share * (end_ - from);
  taken_ = kept_;
  while (taken_ < count && spans_[taken_].u + spans_[taken_].length <= limit &&
         spans_[taken_].u + spans_[taken_].length + widths_ahead * spans_[taken_].width <= end_)
    ++taken_;
  taken_ = std::clamp(taken_, kept_ + 1, std::max(kept_ + 1, count - shared_spans));
}

}  // namespace trunnion::motion
