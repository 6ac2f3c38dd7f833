// SPDX-License-Identifier: Apache-2.0
// Figures as lines of text and as JSON, in the units in which they are shown.
#pragma once

#include <fmt/core.h>

#include <iostream>
#include <utility>

#include "bus/json.hpp"
#include "truth/pose_report.hpp"

namespace trunnion::cli {

constexpr double um = 1e3, urad = 1e6;  // of mm, of rad

/// A line on standard output, which appears at once.
template <class... Values>
void print(fmt::format_string<Values...> format, Values&&... values) {
  std::cout << fmt::format(format, std::forward<Values>(values)...) << std::endl;
}

inline bus::Json vector_json(const geometry::Vec3& v, double unit = 1) {
  return bus::Json::array({v[0] * unit, v[1] * unit, v[2] * unit});
}

inline bus::Json spread_json(const truth::Spread& spread, double unit) {
  return {{"mean", spread.mean * unit},
          {"percentile_95", spread.percentile_95 * unit},
          {"maximum", spread.maximum * unit}};
}

}  // namespace trunnion::cli
