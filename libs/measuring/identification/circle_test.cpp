// SPDX-License-Identifier: Apache-2.0
#include "identification/circle_test.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <stdexcept>

namespace trunnion::identification {

void check_circle(const circular_tests::CircleMotion& motion,
                  const std::array<servo_analysis::TestedAxis, 3>& linear) {
  for (std::size_t i = 0; i < linear.size(); ++i) {
    const auto& axis = linear[i];
    const bool moves = motion.plane.find(axis.letter) != std::string::npos;
    const double middle = motion.centre[static_cast<Eigen::Index>(i)], reach = moves ? motion.radius : 0;
    if (middle - reach < axis.low || middle + reach > axis.high)
      throw std::runtime_error(
          fmt::format("axis {}: the circle goes from {:.3f} to {:.3f} mm, its travel is {:.3f} .. "
                      "{:.3f}: choose another --at or --radius",
                      axis.letter, middle - reach, middle + reach, axis.low, axis.high));
    if (moves && motion.feed > axis.highest_feed)
      throw std::runtime_error(fmt::format("--feed {:g}: axis {} moves with up to {:g} mm/min", motion.feed,
                                           axis.letter, axis.highest_feed));
  }
}

CircleTest evaluate_circle(const servo_analysis::ChannelMotion& motion, const std::string& plane,
                           const circular_tests::ProgrammedCircle& circle, const CirclePoints& points,
                           const truth::InstrumentTruth& bar) {
  const auto commanded = commanded_points(motion, circular_tests::plane_of(plane));
  const auto turns = circular_tests::turns_on(commanded, circle);
  if (turns.empty()) throw std::runtime_error("the axes have not made a whole turn");
  truth::Instrument instrument(bar);
  CircleTest test;
  test.start = turns.front().start, test.overrun = turns.front().overrun;
  for (const auto& turn : turns) {
    auto& readings = turn.sense > 0 ? test.readings.ccw : test.readings.cw;
    if (!readings.empty()) continue;
    readings = circular_tests::readings_of(points, turn, circle);
    for (auto& reading : readings) reading.deviation = instrument.read(reading.deviation);
    test.feed = std::max(test.feed, circular_tests::feed_reached(commanded, turn, motion.interval));
  }
  if (test.readings.ccw.empty() || test.readings.cw.empty())
    throw std::runtime_error(std::string("the circle was run in one sense only (") +
                             (test.readings.cw.empty() ? "counter-" : "") +
                             "clockwise): a circular test needs both");
  test.report = circular_tests::circle_report(plane, circle.radius, test.readings.ccw, test.readings.cw);
  if (test.feed > 0) test.servo_mismatch = test.report.causes.lag_mismatch / (test.feed / 60) * 1e3;
  return test;
}

}  // namespace trunnion::identification
