// SPDX-License-Identifier: Apache-2.0
#include "servo_analysis/rtcp_turn.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "servo_analysis/motion_figures.hpp"

namespace trunnion::servo_analysis {
namespace {

constexpr double least_phase = 0.2;           // s
constexpr double tolerated_speed = 0.02;      // of the speed asked for
constexpr double share_of_the_fastest = 0.1;  // slower axes have no lag

}  // namespace

RtcpTurn turn_under_rtcp(std::vector<AxisTrace> traces, double speed) {
  std::size_t begin = 0, end = 0;
  for (const auto& p : constant_phases(traces.back(), least_phase))
    if (std::abs(p.speed - speed) < tolerated_speed * std::abs(speed) && p.end - p.begin > end - begin)
      begin = p.begin, end = p.end;
  if (end == begin)
    throw std::runtime_error("the rotary axis did not reach its feed: choose a longer way or a lower feed");
  for (auto& t : traces)
    for (auto* v :
         {&t.setpoint, &t.feedback, &t.speed_set, &t.speed, &t.torque, &t.excitation, &t.motor, &t.load})
      *v = {v->begin() + static_cast<std::ptrdiff_t>(begin), v->begin() + static_cast<std::ptrdiff_t>(end)};
  RtcpTurn turn;
  turn.rotary = std::move(traces.back());
  traces.pop_back();
  turn.linear = std::move(traces);
  return turn;
}

double linear_way(const RtcpTurn& turn) {
  double moved = 0;
  for (const auto& t : turn.linear)
    for (const double x : t.setpoint) moved = std::max(moved, std::abs(x - t.setpoint[0]));
  return moved;
}

double peak_speed(const AxisTrace& t) {
  double peak = 0;
  for (std::size_t i = 0; i + 1 < t.size(); ++i)
    peak = std::max(peak, std::abs(t.setpoint[i + 1] - t.setpoint[i]) / t.interval);
  return peak;
}

std::vector<AxisLag> lags_of(const RtcpTurn& turn, const std::vector<double>& times,
                             const std::string& letters) {
  double highest = 0;
  for (const auto& t : turn.linear) highest = std::max(highest, peak_speed(t));
  std::vector<AxisLag> lags;
  for (std::size_t i = 0; i < turn.linear.size(); ++i)
    if (peak_speed(turn.linear[i]) > share_of_the_fastest * highest) lags.push_back({letters[i], times[i]});
  lags.push_back({letters.back(), times.back()});
  return lags;
}

}  // namespace trunnion::servo_analysis
