// SPDX-License-Identifier: Apache-2.0
#include "program_execution/tap_in_hole.hpp"

#include <cmath>
#include <cstddef>
#include <cstdio>

namespace trunnion::program_execution {
namespace {

constexpr double beside = 0.1;           // mm from the axis of the hole: another place
constexpr double least_depth = 0.001;    // mm
constexpr double lead_tolerance = 0.01;  // share: a lead as F / S and one as a word are rounded differently
constexpr double in_line = 0.999;        // cosine: 2.6 deg

double product(const language::Vector3& a, const language::Vector3& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

language::Vector3 difference(const language::AxisValues& to, const language::AxisValues& from) {
  return {to[0] - from[0], to[1] - from[1], to[2] - from[2]};
}

}  // namespace

TapInHole TapInHole::of(double lead, const language::AxisValues& from, const language::AxisValues& to) {
  TapInHole tap;
  const auto way = difference(to, from);
  const double length = std::sqrt(product(way, way));
  if (!(length > 0)) return tap;
  tap.lead = lead;
  for (std::size_t i = 0; i < way.size(); ++i) {
    tap.start[i] = from[i];
    tap.direction[i] = way[i] / length;
  }
  return tap;
}

double TapInHole::depth(const language::AxisValues& position) const {
  if (lead == 0) return 0;
  const language::Vector3 offset{position[0] - start[0], position[1] - start[1], position[2] - start[2]};
  const double inside = product(offset, direction);
  const double square = product(offset, offset) - inside * inside;
  return inside > least_depth && square < beside * beside ? inside : 0;
}

std::string TapInHole::words(double depth) const {
  char text[96];
  std::snprintf(text, sizeof text, "%s-hand thread, lead %.6g mm, %.3f mm deep", lead < 0 ? "left" : "right",
                std::abs(lead), depth);
  return text;
}

bool TapInHole::contradicts(const language::AxisValues& from, const language::AxisValues& to,
                            double stroke_lead) const {
  if (!(depth(from) > 0)) return false;
  const auto way = difference(to, from);
  const double length = std::sqrt(product(way, way));
  const bool out = length > least_depth && product(way, direction) <= -in_line * length;
  // The same helix the other way round.
  const bool same_thread = std::abs(stroke_lead + lead) <= lead_tolerance * std::abs(lead);
  return !out || !same_thread;
}

}  // namespace trunnion::program_execution
