// SPDX-License-Identifier: Apache-2.0
#include "servo_test_parts.hpp"

#include <algorithm>
#include <cmath>

#include "figures.hpp"
#include "machine/parameter_constants.hpp"
#include "servo_analysis/contour_figures.hpp"
#include "servo_analysis/rtcp_turn.hpp"
#include "servo_pictures.hpp"

namespace trunnion::cli {

using servo_analysis::AxisTrace;
using servo_analysis::per_minute;

bool TestReport::reached() const {
  return std::all_of(figures.begin(), figures.end(), [](const auto& f) { return f.reached(); });
}

// Judged without feed-forward, which hides the loop: with it the following error is small at any gain.
TestReport test_position(ServoSession& session, const TestOptions& o) {
  const auto& a = only_axis(session, o);
  const double feed = feed_of(a, o, 1000);
  const auto trace = stroke(session, a, feed);
  const auto f = moved_figures(trace);
  const auto gain = parameter::position_gain.number(a.number);
  const double slower = feed_without_feedforward(session, {a.number}, {feed / per_minute}, feed);
  const double settling = servo_analysis::settling_time(session.parameters().at(gain));
  const auto loop =
      run_without_feedforward(session, samples_of({a.number}, 2), stroke_program(a, slower, 0.5 + settling))
          .front();
  const auto bare = moved_figures(loop, settling);
  TestReport r;
  r.test = "position";
  // 0.2 mm is the limit at 1000 mm/min; the error of a loop without feed-forward is in proportion to the
  // speed. A gain that no loop can have is no measured one.
  r.figures = {{"following error", std::abs(f.following_error), a.length_unit(), {}, 0.2 * feed / 1000},
               {"largest following error", f.following_peak, a.length_unit(), {}, {}},
               {"following error without feed-forward",
                std::abs(bare.following_error),
                a.length_unit(),
                {},
                0.2 * slower / 1000},
               {"Kv", bare.velocity_gain, "1/s", least_position_gain,
                machine::Catalogue::instance().find(gain)->maximum}};
  r.notes.push_back(text("Kv is speed over following error without feed-forward at %.0f %s", slower,
                         a.speed_unit().c_str()));
  r.notes.push_back(
      "at 1000 mm/min 0.2 mm is Kv 83 1/s and 0.1 mm, the best, 167 1/s: a larger error needs a higher "
      "position gain (10a900, PA0)");
  r.picture = curves_picture(
      picture_title(session, a, "following error"), "s", a.turns ? "mdeg" : "um",
      {over_time("following error", difference(trace.setpoint, trace.feedback), trace.interval, 1e3),
       over_time("without feed-forward", difference(loop.setpoint, loop.feedback), loop.interval, 1e3)});
  return r;
}

TestReport test_speed(ServoSession& session, const TestOptions& o) {
  const auto& a = only_axis(session, o);
  const auto trace = stroke(session, a, feed_of(a, o, std::min(3000.0, a.highest_feed)));
  const auto f = moved_figures(trace);
  TestReport r;
  r.test = "speed";
  const double mean = (f.acceleration_peak + f.deceleration_peak) / 2;
  r.figures = {{"speed ripple", f.ripple * per_minute, a.speed_unit(), {}, 10},
               {"overshoot", f.overshoot * per_minute, a.speed_unit(), {}, {}},
               {"acceleration peak, positive", f.acceleration_peak, a.length_unit() + "/s2", {}, {}},
               {"acceleration peak, negative", f.deceleration_peak, a.length_unit() + "/s2", {}, {}}};
  if (mean > 0)
    r.figures.push_back({"difference of the peaks",
                         100 * std::abs(f.acceleration_peak - f.deceleration_peak) / mean,
                         "%",
                         {},
                         {}});
  std::vector<double> command = difference(trace.speed_set, trace.excitation);
  r.picture = curves_picture(picture_title(session, a, "speed loop"), "s", a.speed_unit(),
                             {over_time("setpoint", command, trace.interval, per_minute),
                              over_time("speed", trace.speed, trace.interval, per_minute)});
  return r;
}

TestReport test_overshoot(ServoSession& session, const TestOptions& o) {
  const auto& a = only_axis(session, o);
  const bool full = session.parameters().integer(parameter::full_closed_loop, a.number) != 0;
  TestReport r;
  r.test = "overshoot";
  std::vector<PictureCurve> curves;
  for (const double feed : servo_analysis::overshoot_feeds) {
    if (feed > a.highest_feed) continue;
    const auto trace = stroke(session, a, feed);
    const auto f = moved_figures(trace);
    const double limit = full && feed <= 500 ? 100 : 40;
    const auto name = "F" + std::to_string(static_cast<int>(feed));
    r.figures.push_back({"overshoot at " + name, f.overshoot * per_minute, a.speed_unit(), {}, limit});
    curves.push_back(over_time(name, difference(trace.speed, difference(trace.speed_set, trace.excitation)),
                               trace.interval, per_minute));
  }
  r.notes.push_back(
      "above the limit: lower the speed gain (10a901, PA2) or acceleration and jerk of the axis");
  r.picture =
      curves_picture(picture_title(session, a, "speed less its setpoint"), "s", a.speed_unit(), curves);
  return r;
}

TestReport test_roundness(ServoSession& session, const TestOptions& o) {
  if (o.axes.size() != 2) throw std::runtime_error("this test is of two axes: --axis X --axis Y");
  const auto &a = session.axis(o.axes[0]), &b = session.axis(o.axes[1]);
  const double feed = feed_of(a, o, 1000);
  const auto samples = samples_of({a.number, b.number}, 8);
  const auto result = session.run(samples, circle_program(a, b, o.radius, feed));
  if (result.traces.size() != 2) throw std::runtime_error("the drive gave no samples of the motion");
  const auto f = servo_analysis::roundness(result.traces[0], result.traces[1]);
  // Feed-forward hides gains that differ.
  const double speed = feed / per_minute;
  const double slower = feed_without_feedforward(session, {a.number, b.number}, {speed, speed}, feed);
  const auto loops = run_without_feedforward(session, samples, circle_program(a, b, o.radius, slower));
  const auto bare = servo_analysis::roundness(loops[0], loops[1]);
  TestReport r;
  r.test = "roundness";
  r.figures = {{"circular deviation", f.deviation * 1e3, "um", {}, {}},
               {"mean radius less programmed", f.radius_error * 1e3, "um", {}, {}},
               {"servo mismatch", f.mismatch, "ms", -1, 1},
               {"servo mismatch without feed-forward", bare.mismatch, "ms", -1, 1}};
  for (std::size_t q = 0; q < 4; ++q)
    r.figures.push_back(
        {"quadrant jump at " + std::to_string(90 * q) + " deg", f.quadrant_jump[q], "mm", {}, 0.01});
  std::string note = "a mismatch above zero: ";
  note += a.letter;
  note += " lags behind ";
  note += b.letter;
  note += "; make the position gains (10a900, PA0) equal";
  r.notes.push_back(std::move(note));
  r.picture = roundness_picture(session.machine() + ": roundness " + a.letter + b.letter, f);
  return r;
}

TestReport test_rtcp(ServoSession& session, const TestOptions& o) {
  const auto& rotary = only_axis(session, o);
  if (!rotary.turns) throw std::runtime_error("this test is of a rotary axis: --axis C");
  const double feed = feed_of(rotary, o, 1000), sense = std::copysign(1 / per_minute, o.end - o.start);
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
  const double slower = feed_without_feedforward(session, numbers, speeds, feed);
  rtcp.feed = rtcp.positioning = slower;
  const auto bare_turn = servo_analysis::turn_under_rtcp(
      run_without_feedforward(session, samples, rtcp_program(rtcp)), sense * slower);
  const auto f = servo_analysis::simultaneous_motion(turn.linear, turn.rotary);
  const auto bare = servo_analysis::simultaneous_motion(bare_turn.linear, bare_turn.rotary);
  const auto lags = lags_of(bare_turn, bare.lags, letters);
  const auto [least, most] =
      std::minmax_element(lags.begin(), lags.end(), [](auto& p, auto& q) { return p.time < q.time; });
  TestReport r;
  r.test = "rtcp";
  r.figures = {{"mismatch of linear axes", f.linear * 1e3, "um", {}, 1},
               {"mismatch of rotary axis", f.rotary * 1e3, "um", {}, 1},
               {"servo mismatch without feed-forward", (most->time - least->time) * 1e3, "ms", {}, 1}};
  for (const auto& lag : lags)
    r.figures.push_back({text("time lag of %c", lag.letter), lag.time * 1e3, "ms", {}, {}});
  r.notes.push_back(
      "time lags are without feed-forward, 1 / Kv; above the limit: lower the position gain (10a900, PA0) of "
      "every axis to that of the weakest");
  std::vector<PictureCurve> curves;
  for (std::size_t i = 0; i < turn.linear.size(); ++i)
    curves.push_back(over_time("linear axis " + std::to_string(i + 1),
                               difference(turn.linear[i].setpoint, turn.linear[i].feedback),
                               turn.rotary.interval, 1e3));
  r.picture =
      curves_picture(picture_title(session, rotary, "following errors under RTCP"), "s", "um", curves);
  return r;
}

}  // namespace trunnion::cli
