// SPDX-License-Identifier: Apache-2.0
#include "motion/smoothing_spline.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace trunnion::motion {
namespace {

double point_distance(const AxisValues& a, const AxisValues& b) {
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

AxisValues place(const Cubic& c, double t) { return shifted(c, t)[0]; }

std::vector<Vertex> vertices_of(const std::vector<AxisValues>& points, double tube) {
  std::vector<Vertex> vertices;
  double u = 0;
  for (std::size_t k = 0; k < points.size(); ++k) {
    if (k > 0) u += point_distance(points[k], points[k - 1]);
    vertices.push_back({points[k], u, tube, tube});
  }
  return vertices;
}

std::vector<AxisValues> random_curve(std::uint64_t seed, int count) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> unit(-1, 1);
  std::vector<AxisValues> points{{}};
  double direction = 0, bend = 0;
  for (int k = 1; k < count; ++k) {
    bend += 0.02 * unit(random);
    direction += 0.1 * std::tanh(bend);
    AxisValues p = points.back();
    p[0] += 0.1 * std::cos(direction);
    p[1] += 0.1 * std::sin(direction);
    p[2] += 0.01 * unit(random);
    p[canonical::A] += 0.3 * std::sin(direction);
    points.push_back(p);
  }
  return points;
}

// All spans of a curve whose windows have `size` vertices more each time.
std::vector<CurveSpan> fit_in_windows(SmoothingSpline& spline, const std::vector<Vertex>& vertices,
                                      std::size_t size) {
  std::vector<CurveSpan> spans;
  spline.clear();
  for (std::size_t to = size; spans.empty() || to < vertices.size() + size; to += size) {
    const bool ends = to >= vertices.size();
    std::size_t from = 0;
    const double taken = spans.empty() ? 0 : spans.back().u + spans.back().length;
    while (from + 1 < vertices.size() && vertices[from + 1].u <= taken) ++from;
    spline.fit(std::span(vertices).subspan(from, std::min(to, vertices.size()) - from), ends);
    for (std::size_t k = 0; k < spline.size(); ++k) spans.push_back(spline[k]);
  }
  return spans;
}

TEST(SmoothingSpline, a_straight_line_stays_one) {
  std::vector<AxisValues> points;
  for (int k = 0; k <= 40; ++k) points.push_back({3 + 0.3 * k, 0.4 * k, 7});
  SmoothingSpline spline;
  for (const CurveSpan& span : fit_in_windows(spline, vertices_of(points, 1e-4), 50)) {
    const AxisValues p = place(span.curve, span.length / 3);
    const double u = span.u + span.length / 3;  // 0.5 mm for each step
    EXPECT_LE(point_distance(p, {3 + 0.6 * u, 0.8 * u, 7}), 1e-8);
  }
}

TEST(SmoothingSpline, is_continuous_to_the_second_derivative_also_from_window_to_window) {
  SmoothingSpline spline;
  for (const std::uint64_t seed : {1, 2, 3, 4, 5}) {
    const auto vertices = vertices_of(random_curve(seed, 900), 0.004);
    const auto spans = fit_in_windows(spline, vertices, 200);
    ASSERT_GT(spans.size(), 20U);
    for (std::size_t k = 1; k < spans.size(); ++k) {
      const Cubic before = shifted(spans[k - 1].curve, spans[k - 1].length), &here = spans[k].curve;
      ASSERT_NEAR(spans[k].u, spans[k - 1].u + spans[k - 1].length, 1e-9);
      for (std::size_t i = 0; i < 6; ++i) {
        ASSERT_NEAR(before[0][i], here[0][i], 1e-9);
        ASSERT_NEAR(before[1][i], here[1][i], 1e-8);
        ASSERT_NEAR(before[2][i], here[2][i], 1e-6);
      }
    }
  }
}

TEST(SmoothingSpline, meets_its_first_and_last_vertex_and_keeps_the_tube_between) {
  SmoothingSpline spline;
  for (const std::uint64_t seed : {6, 7, 8}) {
    const auto vertices = vertices_of(random_curve(seed, 500), 0.004);
    const auto spans = fit_in_windows(spline, vertices, 200);
    EXPECT_LE(point_distance(spans.front().curve[0], vertices.front().at), 1e-7);
    EXPECT_LE(point_distance(place(spans.back().curve, spans.back().length), vertices.back().at), 1e-7);
    std::size_t leg = 0;
    for (const CurveSpan& span : spans) {
      for (double t = 0; t < span.length; t += 0.01) {
        while (leg + 2 < vertices.size() && vertices[leg + 1].u <= span.u + t) ++leg;
        const double share = (span.u + t - vertices[leg].u) / (vertices[leg + 1].u - vertices[leg].u);
        AxisValues p{};
        for (std::size_t i = 0; i < 9; ++i)
          p[i] = vertices[leg].at[i] + share * (vertices[leg + 1].at[i] - vertices[leg].at[i]);
        ASSERT_LE(point_distance(place(span.curve, t), p), 0.004 * (1 + 1e-6));
      }
    }
  }
}

TEST(SmoothingSpline, the_bound_of_the_deviation_is_never_below_a_sample_of_it) {
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> unit(-1, 1);
  for (int n = 0; n < 2000; ++n) {
    Cubic curve{};
    AxisValues start{}, slope{};
    for (std::size_t i = 0; i < 6; ++i) {
      for (auto& row : curve) row[i] = unit(random);
      start[i] = unit(random);
      slope[i] = unit(random);
    }
    const double length = 0.1 + std::abs(unit(random));
    const CurveDeviation bound = deviation_bound(curve, start, slope, length);
    double linear = 0, rotary = 0;
    for (int k = 0; k <= 50; ++k) {
      const double t = length * k / 50;
      const AxisValues p = place(curve, t);
      double l = 0, r = 0;
      for (std::size_t i = 0; i < 6; ++i) {
        const double d = p[i] - start[i] - slope[i] * t;
        (i < 3 ? l : r) += d * d;
      }
      linear = std::max(linear, std::sqrt(l));
      rotary = std::max(rotary, std::sqrt(r));
    }
    ASSERT_LE(linear, bound.linear * (1 + 1e-12));
    ASSERT_LE(rotary, bound.rotary * (1 + 1e-12));
  }
}

}  // namespace
}  // namespace trunnion::motion
