// SPDX-License-Identifier: Apache-2.0
// One diagram as SVG: frame, ticks, labels and curves.
#pragma once

#include <string>
#include <vector>

namespace trunnion::report {

struct Range {
  double low = 0, high = 1;
  double span() const { return high - low; }
};

struct PlotPoint {
  double x = 0, y = 0;
};

/// 1, 2 or 5 times a power of ten: the largest that is not above `value` (> 0).
double round_down(double value);

/// A number for people: no more digits than a step of `step` needs.
std::string tick_text(double value, double step);

class Plot {
 public:
  /// Place of the frame in the picture, in pixels; labels are outside of it. The ranges must have a length.
  Plot(double left, double top, double width, double height, Range x, Range y);

  void title(const std::string& text);
  void labels(const std::string& x, const std::string& y);
  /// Connects the points; outside of the frame nothing shows. `style` is SVG presentation attributes.
  void curve(const std::vector<PlotPoint>& points, const std::string& style);
  /// The frame over grid and curves.
  std::string svg() const;

  double pixel_x(double x) const { return left_ + (x - x_.low) / x_.span() * width_; }
  double pixel_y(double y) const { return top_ + height_ - (y - y_.low) / y_.span() * height_; }

 private:
  std::string grid() const;
  double left_, top_, width_, height_;
  Range x_, y_;
  std::string title_, curves_, x_label_, y_label_;
};

/// `words` for XML and HTML.
std::string escaped(const std::string& words);
std::string text(double x, double y, const std::string& words, const std::string& attributes = "");
std::string line(double x1, double y1, double x2, double y2, const std::string& style);
/// Number in pixels with a hundredth's resolution.
std::string pixel(double value);
std::string document(double width, double height, const std::string& content);

}  // namespace trunnion::report
