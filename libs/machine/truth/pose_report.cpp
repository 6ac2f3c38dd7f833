// SPDX-License-Identifier: Apache-2.0
#include "truth/pose_report.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <stdexcept>
#include <vector>

#include "canonical/axes.hpp"
#include "geometry/angle.hpp"
#include "geometry/random_source.hpp"

namespace trunnion::truth {
namespace {

using canonical::axis_letters;
constexpr double most = 1e6;  // mm or deg

[[noreturn]] void fail(std::size_t line, std::size_t column, const std::string& text) {
  throw std::runtime_error(std::to_string(line) + ":" + std::to_string(column + 1) + ": " + text);
}

Spread spread_of(std::vector<double>& values) {
  Spread spread;
  std::sort(values.begin(), values.end());
  for (const double value : values) spread.mean += value / static_cast<double>(values.size());
  // The smallest value that 95 % of all do not exceed.
  const std::size_t rank = (values.size() * 95 + 99) / 100;
  spread.percentile_95 = values[rank - 1];
  spread.maximum = values.back();
  return spread;
}

void append(std::string& text, const Vec3& v, double unit, int decimals) {
  for (const double value : v) {
    char out[64];
    std::snprintf(out, sizeof out, "%.*f", decimals, value * unit);
    const std::string_view shown = out;
    // No sign on what is zero to these decimals.
    const bool zero = shown.find_first_not_of("-0.") == std::string_view::npos;
    if (!text.empty()) text += ' ';
    text += zero && shown[0] == '-' ? shown.substr(1) : shown;
  }
}

}  // namespace

PoseReport::PoseReport(TrueGeometry geometry, geometry::Chain model, const machine::MachineOutline& machine)
    : geometry_(std::move(geometry)), model_(std::move(model)), machine_(machine) {}

bool PoseReport::has(std::size_t axis) const { return axis < 3 || model_.turns(axis - 3); }

std::optional<PoseAnswer> PoseReport::answer(const std::string& line, std::size_t number) {
  std::array<double, axis_count> positions{};
  std::array<bool, axis_count> given{};
  bool any = false;
  for (std::size_t i = 0; i < line.size();) {
    if (line[i] == '#' || line[i] == ';') break;
    if (line[i] == ' ' || line[i] == '\t' || line[i] == '\r') {
      ++i;
      continue;
    }
    const auto axis = axis_letters.find(line[i]);
    if (axis == std::string_view::npos || !has(axis)) {
      std::string names;
      for (std::size_t k = 0; k < axis_count; ++k)
        if (has(k)) names += axis_letters[k];
      fail(number, i, "expected a word of one of the axes " + names + ", for example X10.5");
    }
    if (given[axis])
      fail(number, i, std::string("axis ").append(1, axis_letters[axis]).append(" is there twice"));
    const std::size_t end = std::min(line.find_first_of(" \t\r#;XYZABCUVW", i + 1), line.size());
    const char* first = line.data() + i + 1;
    if (first + 1 < line.data() + end && *first == '+' && first[1] != '-') ++first;
    const auto [stop, error] = std::from_chars(first, line.data() + end, positions[axis]);
    if (error != std::errc() || stop != line.data() + end || !std::isfinite(positions[axis]))
      fail(number, i + 1, "'" + line.substr(i + 1, end - i - 1) + "' is not a number");
    if (std::abs(positions[axis]) > most)
      fail(number, i + 1, line.substr(i + 1, end - i - 1) + " is not within -1000000 .. 1000000");
    given[axis] = any = true;
    i = end;
  }
  if (!any) return std::nullopt;
  if (previous_)
    for (std::size_t k = 0; k < axis_count; ++k)
      if (positions[k] != (*previous_)[k]) approach_[k] = positions[k] > (*previous_)[k] ? 1 : -1;
  previous_ = positions;
  MachinePose pose;
  pose.positions = positions;
  pose.approach = approach_;
  pose.tool_length = tool_length;
  pose.temperatures = temperatures;
  return at(pose);
}

PoseAnswer PoseReport::at(const MachinePose& machine) const {
  PoseAnswer answer;
  answer.commanded = machine;
  answer.actual = true_pose(machine);
  const auto angles = geometry::angles_of(machine.positions.data());
  answer.deviation.tip =
      answer.actual.tip -
      model_.tip_from_machine({machine.positions[0], machine.positions[1], machine.positions[2]}, angles,
                              machine.tool_length);
  answer.deviation.axis = answer.actual.axis - model_.tool_direction_in_workpiece(angles);
  return answer;
}

ToolPose PoseReport::true_pose(const MachinePose& machine) const {
  if (!compensation) return geometry_.pose(machine);
  const auto correction = compensation->correction(machine);
  auto moved = machine;
  for (std::size_t k = 0; k < axis_count; ++k) moved.positions[k] += correction.added[k];
  return geometry_.pose(moved);
}

std::vector<MachinePose> PoseReport::random_poses(std::size_t count, std::uint64_t seed) const {
  geometry::RandomSource random(seed);
  std::vector<MachinePose> poses;
  for (std::size_t n = 0; n < count; ++n) {
    MachinePose& pose = poses.emplace_back();
    for (std::size_t k = 0; k < axis_count; ++k) {
      const double share = random.uniform();
      pose.approach[k] = random.uniform() < 0.5 ? -1 : 1;
      if (!has(k) || !machine_.axes[k].present) continue;
      double low = machine_.axes[k].low, high = machine_.axes[k].high;
      if (k > 2 && high - low > 360) low = -180, high = 180;
      pose.positions[k] = low + share * (high - low);
    }
    pose.tool_length = tool_length;
    pose.temperatures = temperatures;
  }
  return poses;
}

DeviationSummary PoseReport::summary(std::size_t count, std::uint64_t seed) const {
  std::vector<double> tips, angles;
  DeviationSummary summary;
  summary.count = count;
  if (count == 0) return summary;
  for (const auto& pose : random_poses(count, seed)) {
    const auto answer = at(pose);
    tips.push_back(answer.deviation.tip.norm());
    angles.push_back(
        geometry::angle_between(answer.actual.axis, Vec3(answer.actual.axis - answer.deviation.axis)));
  }
  summary.tip = spread_of(tips);
  summary.axis = spread_of(angles);
  return summary;
}

std::string text_of(const PoseAnswer& answer) {
  std::string text;
  append(text, answer.actual.tip, 1, 6);
  append(text, answer.actual.axis, 1, 9);
  append(text, answer.deviation.tip, 1e3, 3);
  append(text, answer.deviation.axis, 1e6, 3);
  return text;
}

}  // namespace trunnion::truth
