// SPDX-License-Identifier: Apache-2.0
// A smooth curve through, or evenly about, the points of a polyline.
#pragma once

#include <span>
#include <vector>

#include "motion/cubic.hpp"

namespace trunnion::motion {

/// A point of the programmed polyline, and how near to it the curve shall come.
struct Vertex {
  AxisValues at{};
  double u = 0;       ///< length of the polyline up to here, mm
  double linear = 0;  ///< largest distance of the linear axes together, mm, above 0
  double rotary = 0;  ///< of the rotary axes together, degrees, above 0
};

/// A piece of the curve over `length` of the polyline from `u` on.
struct CurveSpan {
  double u = 0, length = 0;
  Cubic curve{};
};

/// Locally weighted smoothing spline: cubic B-spline x(u), twice continuously differentiable and of constant
/// third derivative on each span, that minimises the integral of |x - p|^2 / l^6 + |x'''|^2 over the polyline
/// p(u). The width l is as large as the tubes of the vertices and the curvature permit; below it the polyline
/// is averaged, and a circle is followed with a bias of l^6 / R^5 only. The equations are solved window by
/// window; what is taken of a window stays, and the next window continues it without a step in the second
/// derivative. The first and the last vertex of a curve are met to 1e-9 mm. Pure: the same windows give the
/// same bits. Nothing allocates after construction.
class SmoothingSpline {
 public:
  static constexpr std::size_t most_spans = 2048;
  SmoothingSpline();

  /// A curve begins at the first vertex of the next window.
  void clear();

  /// Fits the curve to `window`, at least two vertices of growing u. It begins at or before taken_to(); where
  /// it `ends`, the curve ends with it.
  void fit(std::span<const Vertex> window, bool ends);

  /// Spans of the last window that do not change any more, to be read before the next fit().
  std::size_t size() const { return taken_ - kept_; }
  CurveSpan operator[](std::size_t index) const;

 private:
  struct Span {
    double u = 0, length = 0, width = 0;
    std::array<AxisValues, 4> moments{};  // of the polyline: integrals of p s^m over s in 0..1
    bool has_moments = false;
    std::array<std::array<double, 4>, 4> basis{};  // power of s by coefficient
  };

  void begin(std::span<const Vertex> window);
  void append(std::span<const Vertex> window);
  void choose_axes(std::span<const Vertex> window);
  double knot(std::ptrdiff_t index) const;
  void set_basis(std::size_t index);
  void set_moments(Span& span, std::span<const Vertex> window) const;
  void solve(std::span<const Vertex> window, bool ends);
  void add_span(std::size_t index, std::span<const Vertex> window, bool ends);
  Cubic cubic(std::size_t index) const;
  bool refine(std::span<const Vertex> window);
  double excess(std::size_t index, std::span<const Vertex> window, std::size_t& vertex) const;
  double bend(std::size_t index) const;
  void grade();
  bool split();

  std::vector<Span> spans_, next_;        // the first kept_ of spans_ are those before the window
  std::vector<AxisValues> coefficients_;  // index..index+3 belong to span index
  std::vector<AxisValues> right_;
  std::vector<std::array<double, 4>> band_;
  std::vector<double> wanted_;        // widths
  std::vector<AxisValues> tangents_;  // X Y Z, at the starts of spans and at the end
  std::size_t kept_ = 0, taken_ = 0;
  double end_ = 0;  // of the spans
  bool begun_ = false;
  std::array<std::size_t, canonical::axis_count> axes_{};  // that move
  std::array<bool, canonical::axis_count> moves_{};
  std::size_t axis_count_ = 0;
};

}  // namespace trunnion::motion
