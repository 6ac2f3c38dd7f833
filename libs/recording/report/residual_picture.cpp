// SPDX-License-Identifier: Apache-2.0
#include "report/residual_picture.hpp"

#include <algorithm>
#include <vector>

#include "report/plot.hpp"

namespace trunnion::report {

std::string residual_picture(const calibration::KinematicsResult& result, const std::string& title) {
  constexpr double um = 1e3;  // of mm
  Range y{0, 0};
  for (const auto& pose : result.poses)
    for (int i = 0; i < 3; ++i)
      y = {std::min({y.low, um * pose.difference[i], um * pose.residual[i]}),
           std::max({y.high, um * pose.difference[i], um * pose.residual[i]})};
  const double margin = std::max(0.1 * y.span(), 0.1);
  Plot plot(80, 70, 640, 320, {0, static_cast<double>(result.poses.size() + 1)},
            {y.low - margin, y.high + margin});
  plot.labels("pose", "um");
  constexpr const char* colours[]{"#cf222e", "#1a7f37", "#0969da"};
  for (int i = 0; i < 3; ++i) {
    std::vector<PlotPoint> before, after;
    for (std::size_t k = 0; k < result.poses.size(); ++k) {
      before.push_back({static_cast<double>(k + 1), um * result.poses[k].difference[i]});
      after.push_back({static_cast<double>(k + 1), um * result.poses[k].residual[i]});
    }
    const std::string stroke = std::string("stroke=\"") + colours[i] + "\"";
    plot.curve(before, stroke + " stroke-width=\"1\" stroke-dasharray=\"4 3\"");
    plot.curve(after, stroke + " stroke-width=\"1.6\"");
  }
  return document(
      760, 450,
      text(80, 24, escaped(title), "font-size=\"15\" font-weight=\"600\"") +
          text(80, 44, "X red, Y green, Z blue; dashed: difference before, line: residual after") +
          plot.svg());
}

}  // namespace trunnion::report
