// SPDX-License-Identifier: Apache-2.0
#include "machine_tests/spindle_sync_samples.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace trunnion::machine_tests {

using idl::stream::Feedback;

namespace {

constexpr double least_turning = 1;  // 1/min
constexpr double spare_dwell = 0.1;  // s: the first cycles may come before the report of the coupling

}  // namespace

void SpindleSyncSamples::add(const Feedback& feedback) {
  const std::size_t spindles = feedback.spindles.size();
  const double now = static_cast<double>(feedback.tick) * interval_;
  if (feedback.count > 0) {
    if (next_ != 0 && feedback.first != next_) lost_ = true;
    next_ = feedback.first + feedback.count;
  }
  for (std::size_t row = 0; row < feedback.count && (row + 1) * spindles <= feedback.spindle_angle.size();
       ++row) {
    const auto begin = feedback.spindle_angle.begin() + static_cast<std::ptrdiff_t>(row * spindles);
    const double age = static_cast<double>(feedback.count - 1 - row) * interval_;
    moments_.push_back({now - age, true, {begin, begin + static_cast<std::ptrdiff_t>(spindles)}});
  }
  if (feedback.count == 0 && (moments_.empty() || now > moments_.back().time + interval_ / 2)) {
    Moment moment{now, false, {}};
    for (const auto& spindle : feedback.spindles) moment.angles.push_back(spindle.angle);
    moments_.push_back(std::move(moment));
  }
  if (!moments_.empty()) reports_.push_back({moments_.size() - 1, feedback.spindles});
}

servo_analysis::SpindleSyncRecord SpindleSyncSamples::record(std::size_t master, std::size_t slave) const {
  servo_analysis::SpindleSyncRecord out;
  out.interval = interval_;
  const auto has = [&](const auto& values) { return std::max(master, slave) < values.size(); };
  for (const auto& moment : moments_) {
    auto& angles = out.angles.emplace_back();
    angles.time = moment.time, angles.cycle = moment.cycle;
    if (has(moment.angles)) angles.master = moment.angles[master], angles.slave = moment.angles[slave];
  }
  for (const auto& report : reports_) {
    if (!has(report.spindles)) continue;
    const auto& state = report.spindles[slave];
    auto& entry = out.reports.emplace_back();
    entry.at = report.at;
    entry.follows = state.master == static_cast<int>(master);
    entry.reference = report.spindles[master].reference;
    entry.error = state.synchronization_error, entry.correction = state.correction;
  }
  return out;
}

std::string spindle_sync_obstacle(const std::vector<machine::AxisInfo>& spindles, const Feedback& feedback,
                                  const idl::plc::Outputs& outputs) {
  if (spindles.size() < 2)
    return fmt::format("the machine has {} of the two spindles that are needed (10a001 = 10)",
                       spindles.size());
  if (feedback.spindles.size() < spindles.size() || feedback.spindle_speed.size() < spindles.size())
    return "the drive does not report the state of the spindles";
  if (feedback.mode == idl::stream::DriveMode::OFF)
    return "the drives are off: release the emergency stop, reset, then test again";
  for (const auto& channel : feedback.channels)
    if (channel.active)
      return fmt::format("channel {} executes a program or moves axes: end that first", channel.channel);
  const auto name = [&](std::size_t number) {
    return number < spindles.size() ? "spindle " + spindles[number].name
                                    : "spindle number " + std::to_string(number + 1);
  };
  if (!outputs.spindle_couplings.empty()) {
    const auto& coupling = outputs.spindle_couplings.front();
    return fmt::format("{} follows {} already: end that first", name(coupling.slave), name(coupling.master));
  }
  for (std::size_t i = 0; i < spindles.size(); ++i)
    if (std::abs(feedback.spindle_speed[i]) > least_turning)
      return fmt::format("{} turns with {:.0f} 1/min: stop it first", name(i), feedback.spindle_speed[i]);
  std::size_t homed = 0, other = 0;
  for (std::size_t i = 0; i < spindles.size(); ++i) {
    if (feedback.spindles[i].homed)
      ++homed;
    else
      other = i;
  }
  if (homed < 2)
    return fmt::format("{} has not passed its index mark since the start: turn it once, then stop it",
                       name(other));
  return {};
}

std::string spindle_sync_program(const SpindleSyncOrders& orders, double speed, double next, double settling,
                                 double record) {
  const auto dwell = [](double time) { return fmt::format("G4 P{}\n", std::lround(time * 1e3)); };
  auto program =
      fmt::format("S{:g}\n{}\n{}\n", speed, orders.start, orders.on) + dwell(settling + record + spare_dwell);
  if (next > 0) program += fmt::format("S{:g}\n", next) + dwell(2 * settling);
  return program + spindle_stop_program(orders);
}

std::string spindle_stop_program(const SpindleSyncOrders& orders) {
  return fmt::format("{}\n{}\nM30\n", orders.stop, orders.off);
}

}  // namespace trunnion::machine_tests
