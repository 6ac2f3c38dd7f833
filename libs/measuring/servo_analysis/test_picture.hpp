// SPDX-License-Identifier: Apache-2.0
// What the picture of a servo test shows.
#pragma once

#include <string>
#include <variant>
#include <vector>

#include "servo_analysis/contour_figures.hpp"
#include "servo_analysis/frequency_response.hpp"

namespace trunnion::servo_analysis {

struct CurvePoint {
  double x = 0, y = 0;
};

struct Curve {
  std::string name;
  std::vector<CurvePoint> points;
};

struct Diagram {
  std::string x, y;  ///< labels
  std::vector<Curve> curves;
};

struct BodeDiagram {
  Response closed, open;
};

struct TestPicture {
  std::string title;
  std::variant<Diagram, BodeDiagram, RoundnessFigures> content;
};

/// Values of a trace over its time, s, in a unit of which one of theirs has `unit`.
Curve over_time(const std::string& name, const std::vector<double>& values, double interval, double unit);

/// a less b, of the same number.
std::vector<double> difference(const std::vector<double>& a, const std::vector<double>& b);

}  // namespace trunnion::servo_analysis
