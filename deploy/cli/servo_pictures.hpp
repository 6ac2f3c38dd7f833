// SPDX-License-Identifier: Apache-2.0
// Pictures of servo tests, SVG.
#pragma once

#include <string>
#include <vector>

#include "report/plot.hpp"
#include "servo_analysis/contour_figures.hpp"
#include "servo_analysis/frequency_response.hpp"
#include "servo_analysis/friction.hpp"

namespace trunnion::cli {

struct PictureCurve {
  std::string name;
  std::vector<report::PlotPoint> points;
};

/// One diagram with a legend; at most 4000 points of each curve are drawn.
std::string curves_picture(const std::string& title, const std::string& x, const std::string& y,
                           const std::vector<PictureCurve>& curves);
struct PictureDiagram {
  std::string x, y;  ///< labels
  std::vector<PictureCurve> curves;
};
/// Several diagrams below each other.
std::string stacked_picture(const std::string& title, const std::vector<PictureDiagram>& diagrams);
/// Magnitude in dB and phase over the logarithm of the frequency.
std::string bode_picture(const std::string& title, const servo_analysis::Response& closed,
                         const servo_analysis::Response& open);
/// Deviation of a circle in polar coordinates, magnified.
std::string roundness_picture(const std::string& title, const servo_analysis::RoundnessFigures& figures);

/// Values of a trace over its time, s.
PictureCurve over_time(const std::string& name, const std::vector<double>& values, double interval,
                       double unit);

}  // namespace trunnion::cli
