// SPDX-License-Identifier: Apache-2.0
#include "servo_test_parts.hpp"

#include <algorithm>
#include <cmath>

#include "figures.hpp"
#include "machine/parameter_constants.hpp"
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
  r.figures = {{"following error", std::abs(f.following_error), length_unit(a), {}, 0.2 * feed / 1000},
               {"largest following error", f.following_peak, length_unit(a), {}, {}},
               {"following error without feed-forward",
                std::abs(bare.following_error),
                length_unit(a),
                {},
                0.2 * slower / 1000},
               {"Kv", bare.velocity_gain, "1/s", least_position_gain,
                machine::Catalogue::instance().find(gain)->maximum}};
  r.notes.push_back(text("Kv is speed over following error without feed-forward at %.0f %s", slower,
                         speed_unit(a).c_str()));
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
  r.figures = {{"speed ripple", f.ripple * per_minute, speed_unit(a), {}, 10},
               {"overshoot", f.overshoot * per_minute, speed_unit(a), {}, {}},
               {"acceleration peak, positive", f.acceleration_peak, length_unit(a) + "/s2", {}, {}},
               {"acceleration peak, negative", f.deceleration_peak, length_unit(a) + "/s2", {}, {}}};
  if (mean > 0)
    r.figures.push_back({"difference of the peaks",
                         100 * std::abs(f.acceleration_peak - f.deceleration_peak) / mean,
                         "%",
                         {},
                         {}});
  std::vector<double> command = difference(trace.speed_set, trace.excitation);
  r.picture = curves_picture(picture_title(session, a, "speed loop"), "s", speed_unit(a),
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
    r.figures.push_back({"overshoot at " + name, f.overshoot * per_minute, speed_unit(a), {}, limit});
    curves.push_back(over_time(name, difference(trace.speed, difference(trace.speed_set, trace.excitation)),
                               trace.interval, per_minute));
  }
  r.notes.push_back(
      "above the limit: lower the speed gain (10a901, PA2) or acceleration and jerk of the axis");
  r.picture =
      curves_picture(picture_title(session, a, "speed less its setpoint"), "s", speed_unit(a), curves);
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

namespace {

struct RtcpTurn {
  std::vector<AxisTrace> linear;
  AxisTrace rotary;
};

// The manual's program without its stops. Incremental, as in to_and_fro_program().
std::string rtcp_program(char letter, const TestOptions& o, double feed, double positioning) {
  return text("G90 G94\nG1 %c%.4f F%.3f\nG4 P500\nG43.4 H%u\n", letter, o.start, positioning, o.tool) +
         text("G91 G1 %c%.4f F%.3f\nG4 P500\nG1 %c%.4f F%.3f\nG90 G49\nM30\n", letter, o.end - o.start, feed,
              letter, o.start - o.end, positioning);
}

// The samples in which the rotary axis, the last one, turns from start to end with `speed`.
RtcpTurn turn_under_rtcp(std::vector<AxisTrace> traces, double speed) {
  std::size_t begin = 0, end = 0;
  for (const auto& p : servo_analysis::constant_phases(traces.back(), 0.2))
    if (std::abs(p.speed - speed) < 0.02 * std::abs(speed) && p.end - p.begin > end - begin)
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

void check_linear_motion(const RtcpTurn& turn) {
  double moved = 0;
  for (const auto& t : turn.linear)
    for (const double x : t.setpoint) moved = std::max(moved, std::abs(x - t.setpoint[0]));
  if (moved < 1)
    throw std::runtime_error(
        "the linear axes do not move: move the tool away from the centre of the rotary axis");
}

double peak_speed(const AxisTrace& t) {
  double peak = 0;
  for (std::size_t i = 0; i + 1 < t.size(); ++i)
    peak = std::max(peak, std::abs(t.setpoint[i + 1] - t.setpoint[i]) / t.interval);
  return peak;
}

struct Lag {
  char letter;
  double time;  // s
};

// Of the axes that move: one that hardly does has no lag to speak of.
std::vector<Lag> lags_of(const RtcpTurn& turn, const std::vector<double>& times, const std::string& letters) {
  double highest = 0;
  for (const auto& t : turn.linear) highest = std::max(highest, peak_speed(t));
  std::vector<Lag> lags;
  for (std::size_t i = 0; i < turn.linear.size(); ++i)
    if (peak_speed(turn.linear[i]) > 0.1 * highest) lags.push_back({letters[i], times[i]});
  lags.push_back({letters.back(), times.back()});
  return lags;
}

}  // namespace

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
  auto result = session.run(samples, rtcp_program(rotary.letter, o, feed, 3000));
  if (result.traces.size() != numbers.size())
    throw std::runtime_error("the drive gave no samples of the motion");
  const auto turn = turn_under_rtcp(std::move(result.traces), sense * feed);
  check_linear_motion(turn);
  // Feed-forward hides gains that differ. Lags are times, so a lower feed shows them as well.
  std::vector<double> speeds;
  for (const auto& t : turn.linear) speeds.push_back(peak_speed(t));
  speeds.push_back(feed / per_minute);
  const double slower = feed_without_feedforward(session, numbers, speeds, feed);
  const auto bare_turn = turn_under_rtcp(
      run_without_feedforward(session, samples, rtcp_program(rotary.letter, o, slower, slower)),
      sense * slower);
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

const SessionAxis* partner_of(const ServoSession& session, const SessionAxis& axis) {
  if (axis.turns || axis.letter < 'X' || axis.letter > 'Z') return nullptr;
  for (const auto& other : session.axes())
    if (other.number != axis.number && other.letter >= 'X' && other.letter <= 'Z' && !other.turns)
      return &other;
  return nullptr;
}

servo_analysis::TuningTask tuning_task(const ServoSession& session, const SessionAxis& axis,
                                       const SessionAxis* partner, double amplitude) {
  const auto& p = session.parameters();
  servo_analysis::TuningTask task;
  task.current = servo_analysis::ServoSettings::from(p, axis.number);
  task.amplitude = amplitude;
  task.acceleration = axis.acceleration;
  task.rated_acceleration = 1.5 * axis.acceleration;
  task.highest_feed = axis.highest_feed;
  task.current_time_constant = p.get(parameter::current_time_constant, axis.number);
  task.full_closed_loop = p.integer(parameter::full_closed_loop, axis.number) != 0;
  task.travel = std::min(40.0, std::max(axis.high - axis.place, axis.place - axis.low));
  task.circles = partner != nullptr;
  if (partner != nullptr) {
    const double space = std::min(partner->high - partner->place, partner->place - partner->low);
    task.circles = space >= 5;
    if (task.circles) task.travel = std::min(task.travel, 2 * space);
  }
  return task;
}

}  // namespace trunnion::cli
