// SPDX-License-Identifier: Apache-2.0
#include "machine_tests/test_requests.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <stdexcept>

#include "machine/gantry_pairs.hpp"
#include "machine/parameter_constants.hpp"
#include "servo_analysis/motion_figures.hpp"

namespace trunnion::machine_tests {
namespace {

constexpr double longest_test = 600;  // s

}  // namespace

idl::servo::TestRequest samples_of(const std::vector<std::uint16_t>& axes, std::uint16_t decimation) {
  idl::servo::TestRequest r;
  r.axes = axes;
  r.in_motion = true;
  r.duration = longest_test;
  r.decimation = decimation;
  return r;
}

idl::servo::TestRequest without_feedforward(const machine::Parameters& parameters,
                                            idl::servo::TestRequest request) {
  const std::size_t count = request.axes.size();
  for (const auto& pair : machine::gantry_pairs(parameters))
    for (std::size_t i = 0; i < count; ++i)
      if (request.axes[i] == pair.master) request.axes.push_back(pair.slave);
  for (const auto axis : request.axes)
    for (const auto& share : {parameter::velocity_feedforward, parameter::acceleration_feedforward})
      request.trial.push_back({share.number(axis), 0, parameters.get(share, axis)});
  return request;
}

double feed_without_feedforward(const machine::Parameters& parameters, const std::vector<std::uint16_t>& axes,
                                const std::vector<double>& speeds, double feed) {
  double share = 1;
  for (std::size_t i = 0; i < axes.size(); ++i)
    share = std::min(
        share, servo_analysis::bearable_share(speeds[i], parameters.get(parameter::position_gain, axes[i]),
                                              parameters.get(parameter::following_error_limit, axes[i])));
  return share * feed;
}

double feed_of(const servo_analysis::TestedAxis& axis, std::optional<double> wanted, double standard) {
  const double feed = wanted.value_or(standard);
  if (!(feed > 0) || feed > axis.highest_feed)
    throw std::runtime_error(fmt::format("feed {:g}: axis {} moves with up to {:g} {}", feed, axis.letter,
                                         axis.highest_feed, axis.speed_unit()));
  return feed;
}

}  // namespace trunnion::machine_tests
