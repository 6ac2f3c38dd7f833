// SPDX-License-Identifier: Apache-2.0
// Figures as lines of text and as JSON, in the units in which they are shown.
#pragma once

#include <cstdio>
#include <iostream>
#include <string>

#include "bus/json.hpp"
#include "text/printed.hpp"
#include "truth/pose_report.hpp"

namespace trunnion::cli {

constexpr double um = 1e3, urad = 1e6;  // of mm, of rad

/// As printf.
std::string text(const char* format, auto... values) { return text::printed(format, values...); }

/// The same as a line on standard output, which appears at once.
void print(const char* format, auto... values) { std::cout << text(format, values...) << std::endl; }

inline bus::Json vector_json(const geometry::Vec3& v, double unit = 1) {
  return bus::Json::array({v[0] * unit, v[1] * unit, v[2] * unit});
}

inline bus::Json spread_json(const truth::Spread& spread, double unit) {
  return {{"mean", spread.mean * unit},
          {"percentile_95", spread.percentile_95 * unit},
          {"maximum", spread.maximum * unit}};
}

}  // namespace trunnion::cli
