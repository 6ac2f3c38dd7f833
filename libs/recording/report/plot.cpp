// SPDX-License-Identifier: Apache-2.0
#include "report/plot.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace trunnion::report {
namespace {

double step_of(const Range& range, double pixels) { return round_down(2.2 * range.span() * 60 / pixels); }

}  // namespace

std::string escaped(const std::string& words) {
  std::string out;
  for (const char c : words) {
    if (c == '&')
      out += "&amp;";
    else if (c == '<')
      out += "&lt;";
    else if (c == '>')
      out += "&gt;";
    else if (c == '"')
      out += "&quot;";
    else
      out += c;
  }
  return out;
}

double round_down(double value) {
  const double power = std::pow(10, std::floor(std::log10(value)));
  const double digit = value / power * (1 + 1e-12);
  return (digit >= 5 ? 5 : digit >= 2 ? 2 : 1) * power;
}

std::string tick_text(double value, double step) {
  char buffer[40];
  const int digits = std::clamp(static_cast<int>(-std::floor(std::log10(step) + 1e-9)), 0, 9);
  std::snprintf(buffer, sizeof buffer, "%.*f", digits, value == 0 ? 0.0 : value);
  return buffer;
}

std::string pixel(double value) {
  char buffer[40];
  std::snprintf(buffer, sizeof buffer, "%.2f", value);
  return buffer;
}

std::string text(double x, double y, const std::string& words, const std::string& attributes) {
  return "<text x=\"" + pixel(x) + "\" y=\"" + pixel(y) + "\" " + attributes + ">" + escaped(words) +
         "</text>\n";
}

std::string line(double x1, double y1, double x2, double y2, const std::string& style) {
  return "<line x1=\"" + pixel(x1) + "\" y1=\"" + pixel(y1) + "\" x2=\"" + pixel(x2) + "\" y2=\"" +
         pixel(y2) + "\" " + style + "/>\n";
}

std::string document(double width, double height, const std::string& content) {
  const std::string size = "width=\"" + pixel(width) + "\" height=\"" + pixel(height) + "\"";
  return "<svg xmlns=\"http://www.w3.org/2000/svg\" " + size + " viewBox=\"0 0 " + pixel(width) + " " +
         pixel(height) +
         "\" font-family=\"Helvetica, Arial, 'DejaVu Sans', sans-serif\" font-size=\"13\" "
         "fill=\"#24292f\">\n<rect " +
         size + " fill=\"#ffffff\"/>\n" + content + "</svg>\n";
}

Plot::Plot(double left, double top, double width, double height, Range x, Range y)
    : left_(left), top_(top), width_(width), height_(height), x_(x), y_(y) {}

void Plot::title(const std::string& words) {
  title_ = text(left_, top_ - 12, words, "font-size=\"15\" font-weight=\"bold\"");
}

void Plot::labels(const std::string& x, const std::string& y) {
  x_label_ = text(left_ + width_ / 2, top_ + height_ + 40, x, "text-anchor=\"middle\"");
  const double cx = left_ - 56, cy = top_ + height_ / 2;
  y_label_ =
      text(cx, cy, y, "text-anchor=\"middle\" transform=\"rotate(-90 " + pixel(cx) + " " + pixel(cy) + ")\"");
}

void Plot::curve(const std::vector<PlotPoint>& points, const std::string& style) {
  if (points.empty()) return;
  std::string list;
  for (const auto& p : points) {
    // Far outside points would lose their digits; the clip path does not show them anyway.
    list +=
        pixel(std::clamp(pixel_x(p.x), -1e5, 1e5)) + "," + pixel(std::clamp(pixel_y(p.y), -1e5, 1e5)) + " ";
  }
  list.pop_back();
  curves_ += "<polyline fill=\"none\" stroke-linejoin=\"round\" " + style + " points=\"" + list + "\"/>\n";
}

std::string Plot::grid() const {
  std::string out;
  const double sx = step_of(x_, width_), sy = step_of(y_, height_);
  const char* faint = "stroke=\"#e4e7eb\"";
  for (double k = std::ceil(x_.low / sx - 1e-9); k * sx <= x_.high + 1e-9 * sx; ++k) {
    const double px = pixel_x(k * sx);
    out += line(px, top_, px, top_ + height_, faint);
    out += text(px, top_ + height_ + 18, tick_text(k * sx, sx), "text-anchor=\"middle\" fill=\"#57606a\"");
  }
  for (double k = std::ceil(y_.low / sy - 1e-9); k * sy <= y_.high + 1e-9 * sy; ++k) {
    const double py = pixel_y(k * sy);
    out += line(left_, py, left_ + width_, py, faint);
    out += text(left_ - 8, py + 4.5, tick_text(k * sy, sy), "text-anchor=\"end\" fill=\"#57606a\"");
  }
  return out;
}

std::string Plot::svg() const {
  const std::string box = "x=\"" + pixel(left_) + "\" y=\"" + pixel(top_) + "\" width=\"" + pixel(width_) +
                          "\" height=\"" + pixel(height_) + "\"";
  const std::string clip = "clip" + pixel(left_) + "_" + pixel(top_);
  return "<clipPath id=\"" + clip + "\"><rect " + box + "/></clipPath>\n" + grid() + "<g clip-path=\"url(#" +
         clip + ")\">\n" + curves_ + "</g>\n<rect " + box + " fill=\"none\" stroke=\"#8c959f\"/>\n" + title_ +
         x_label_ + y_label_;
}

}  // namespace trunnion::report
