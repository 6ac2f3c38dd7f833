// SPDX-License-Identifier: Apache-2.0
#include "machine_tests/servo_test_parts.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "machine/parameter_constants.hpp"
#include "servo_analysis/contour_figures.hpp"
#include "servo_analysis/rtcp_turn.hpp"

namespace trunnion::machine_tests {

using servo_analysis::Curve;
using servo_analysis::difference;
using servo_analysis::over_time;
using servo_analysis::per_minute;

// Judged without feed-forward, which hides the loop: with it the following error is small at any gain.
TestReport test_position(ServoSession& session, const TestOptions& o) {
  const auto& a = only_axis(session, o);
  const double feed = feed_of(a, o.feed, 1000);
  const auto trace = stroke(session, a, feed);
  const auto f = moved_figures(trace);
  const auto gain = parameter::position_gain.number(a.number);
  const double slower = feed_without_feedforward(session.parameters(), {a.number}, {feed / per_minute}, feed);
  const double settling = servo_analysis::settling_time(session.parameters().at(gain));
  const auto loop =
      run_without_feedforward(session, samples_of({a.number}, 2), stroke_program(a, slower, 0.5 + settling))
          .front();
  const auto bare = moved_figures(loop, settling);
  auto r = report_of("position",
                     servo_analysis::position_findings(a, feed, f, slower, bare,
                                                       machine::Catalogue::instance().find(gain)->maximum));
  r.picture = picture_of(
      session, a, "following error",
      {"s",
       a.turns ? "mdeg" : "um",
       {over_time("following error", difference(trace.setpoint, trace.feedback), trace.interval, 1e3),
        over_time("without feed-forward", difference(loop.setpoint, loop.feedback), loop.interval, 1e3)}});
  return r;
}

TestReport test_speed(ServoSession& session, const TestOptions& o) {
  const auto& a = only_axis(session, o);
  const auto trace = stroke(session, a, feed_of(a, o.feed, std::min(3000.0, a.highest_feed)));
  auto r = report_of("speed", servo_analysis::speed_findings(a, moved_figures(trace)));
  const auto command = difference(trace.speed_set, trace.excitation);
  r.picture = picture_of(session, a, "speed loop",
                         {"s",
                          a.speed_unit(),
                          {over_time("setpoint", command, trace.interval, per_minute),
                           over_time("speed", trace.speed, trace.interval, per_minute)}});
  return r;
}

TestReport test_overshoot(ServoSession& session, const TestOptions& o) {
  const auto& a = only_axis(session, o);
  const bool full = session.parameters().integer(parameter::full_closed_loop, a.number) != 0;
  std::vector<std::pair<double, servo_analysis::MotionFigures>> moved;
  std::vector<Curve> curves;
  for (const double feed : servo_analysis::overshoot_feeds) {
    if (feed > a.highest_feed) continue;
    const auto trace = stroke(session, a, feed);
    moved.emplace_back(feed, moved_figures(trace));
    curves.push_back(over_time("F" + std::to_string(static_cast<int>(feed)),
                               difference(trace.speed, difference(trace.speed_set, trace.excitation)),
                               trace.interval, per_minute));
  }
  auto r = report_of("overshoot", servo_analysis::overshoot_findings(a, moved, full));
  r.picture = picture_of(session, a, "speed less its setpoint", {"s", a.speed_unit(), std::move(curves)});
  return r;
}

TestReport test_roundness(ServoSession& session, const TestOptions& o) {
  if (o.axes.size() != 2) throw std::runtime_error("this test is of two axes: --axis X --axis Y");
  const auto &a = session.axis(o.axes[0]), &b = session.axis(o.axes[1]);
  const double feed = feed_of(a, o.feed, 1000);
  const auto samples = samples_of({a.number, b.number}, 8);
  const auto result = session.run(samples, circle_program(a, b, o.radius, feed));
  if (result.traces.size() != 2) throw std::runtime_error("the drive gave no samples of the motion");
  const auto f = servo_analysis::roundness(result.traces[0], result.traces[1]);
  // Feed-forward hides gains that differ.
  const double speed = feed / per_minute;
  const double slower =
      feed_without_feedforward(session.parameters(), {a.number, b.number}, {speed, speed}, feed);
  const auto loops = run_without_feedforward(session, samples, circle_program(a, b, o.radius, slower));
  const auto bare = servo_analysis::roundness(loops[0], loops[1]);
  auto r = report_of("roundness", servo_analysis::roundness_findings(a.letter, b.letter, f, bare));
  r.picture = {session.machine() + ": roundness " + a.letter + b.letter, f};
  return r;
}

TestReport test_rtcp(ServoSession& session, const TestOptions& o) {
  const auto& rotary = only_axis(session, o);
  if (!rotary.turns) throw std::runtime_error("this test is of a rotary axis: --axis C");
  const double feed = feed_of(rotary, o.feed, 1000), sense = std::copysign(1 / per_minute, o.end - o.start);
  std::vector<std::uint16_t> numbers;
  std::string letters;
  for (const auto& a : session.axes())
    if (!a.turns && numbers.size() < 3) numbers.push_back(a.number), letters += a.letter;
  numbers.push_back(rotary.number), letters += rotary.letter;
  const auto samples = samples_of(numbers, 8);
  servo_analysis::RtcpMotion rtcp;
  rtcp.letter = rotary.letter, rtcp.start = o.start, rtcp.end = o.end, rtcp.tool = o.tool;
  rtcp.feed = feed, rtcp.positioning = 3000;
  auto result = session.run(samples, rtcp_program(rtcp));
  if (result.traces.size() != numbers.size())
    throw std::runtime_error("the drive gave no samples of the motion");
  const auto turn = servo_analysis::turn_under_rtcp(std::move(result.traces), sense * feed);
  if (linear_way(turn) < 1)
    throw std::runtime_error(
        "the linear axes do not move: move the tool away from the centre of the rotary axis");
  // Feed-forward hides gains that differ. Lags are times, so a lower feed shows them as well.
  std::vector<double> speeds;
  for (const auto& t : turn.linear) speeds.push_back(servo_analysis::peak_speed(t));
  speeds.push_back(feed / per_minute);
  const double slower = feed_without_feedforward(session.parameters(), numbers, speeds, feed);
  rtcp.feed = rtcp.positioning = slower;
  const auto bare_turn = servo_analysis::turn_under_rtcp(
      run_without_feedforward(session, samples, rtcp_program(rtcp)), sense * slower);
  const auto f = servo_analysis::simultaneous_motion(turn.linear, turn.rotary);
  const auto bare = servo_analysis::simultaneous_motion(bare_turn.linear, bare_turn.rotary);
  auto r = report_of("rtcp", servo_analysis::rtcp_findings(f, lags_of(bare_turn, bare.lags, letters)));
  std::vector<Curve> curves;
  for (std::size_t i = 0; i < turn.linear.size(); ++i)
    curves.push_back(over_time("linear axis " + std::to_string(i + 1),
                               difference(turn.linear[i].setpoint, turn.linear[i].feedback),
                               turn.rotary.interval, 1e3));
  r.picture = picture_of(session, rotary, "following errors under RTCP", {"s", "um", std::move(curves)});
  return r;
}

}  // namespace trunnion::machine_tests
