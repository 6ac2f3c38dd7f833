// SPDX-License-Identifier: Apache-2.0
// Servo tests that look into the loops: current, frequency response, friction, encoders.
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "machine/parameter_constants.hpp"
#include "machine_tests/servo_test_parts.hpp"

namespace trunnion::machine_tests {

using idl::servo::TestRequest;
using idl::servo::TestSignal;
using servo_analysis::over_time;
using servo_analysis::per_minute;

TestReport test_current(ServoSession& session, const TestOptions& o) {
  const auto& a = only_axis(session, o);
  TestRequest q = samples_of({a.number}, 1);
  q.in_motion = false;
  q.signal = TestSignal::TORQUE_STEP;
  q.amplitude = o.amplitude.value_or(0.1);
  q.period = 0.02, q.duration = 0.1;
  const auto result = session.run(q, "");
  if (result.traces.empty()) throw std::runtime_error("the drive gave no samples");
  const auto& t = result.traces[0];
  auto r = report_of("current", servo_analysis::current_findings(servo_analysis::current_time_constant(t)));
  r.picture = picture_of(
      session, a, "current loop",
      {"s",
       "share of the rated torque",
       {over_time("excitation", t.excitation, t.interval, 1), over_time("torque", t.torque, t.interval, 1)}});
  return r;
}

TestReport test_frequency(ServoSession& session, const TestOptions& o) {
  const auto& a = only_axis(session, o);
  constexpr double period = 1;  // s: lines of 1 Hz
  constexpr int periods = 3;
  const double feed = feed_of(a, o.feed, 600), v = feed / per_minute;
  TestRequest q = samples_of({a.number}, 1);
  q.signal = TestSignal::SPEED_CHIRP;
  // Less than the speed of the motion: friction keeps its direction, the loop stays linear.
  q.amplitude = o.amplitude ? *o.amplitude / per_minute : 0.3 * v;
  q.first_frequency = o.from, q.last_frequency = std::min(o.to * 1.05, 3900.0), q.period = period;
  if (q.amplitude >= v)
    throw std::runtime_error("the amplitude must be below the feed: friction would reverse");
  const double distance = v * (periods * period + 0.5) + v * v / a.acceleration + 0.1 * v;
  const auto result = session.run(q, to_and_fro_program(a, a.into_travel(distance), feed, 1));
  if (result.traces.empty()) throw std::runtime_error("the drive gave no samples of the motion");
  const auto& t = result.traces[0];
  servo_analysis::ResponseWindow w;
  w.period = static_cast<std::size_t>(std::llround(period / t.interval)), w.periods = periods - 1;
  w.first = o.from, w.last = o.to;
  const auto phases = servo_analysis::constant_phases(t, periods * period);
  if (phases.empty()) throw std::runtime_error("the motion was not long enough at constant speed");
  w.begin = phases.front().end - w.period * w.periods;
  const auto all = servo_analysis::loop_responses(t, w);
  const bool position = o.loop == "position";
  const auto &open = position ? all.position_open : all.speed_open,
             &closed = position ? all.position_closed : all.speed_closed;
  auto r = report_of("frequency", servo_analysis::frequency_findings(open, closed));
  for (std::size_t i = 0; i < open.size(); ++i)
    r.details["response"].push_back(
        {open[i].frequency, 20 * std::log10(std::abs(open[i].value)), std::arg(open[i].value) * 180 / M_PI,
         20 * std::log10(std::abs(closed[i].value)), std::arg(closed[i].value) * 180 / M_PI});
  r.picture = {session.machine() + ", axis " + a.letter + (position ? ": position loop" : ": speed loop"),
               servo_analysis::BodeDiagram{closed, open}};
  return r;
}

TestReport test_friction(ServoSession& session, const TestOptions& o) {
  const auto& a = only_axis(session, o);
  std::vector<servo_analysis::FrictionPoint> points;
  double inertia = 0;
  for (const double feed : {12.0, 30.0, 60.0, 120.0, 300.0, 600.0, 1200.0, 3000.0, 6000.0, 10000.0}) {
    if (feed > a.highest_feed) continue;
    const auto trace = stroke(session, a, feed);
    for (const auto& p : servo_analysis::friction_points(trace)) points.push_back(p);
    if (feed >= 600) inertia = servo_analysis::identify_inertia(trace);
  }
  const auto f = servo_analysis::identify_friction(points);
  auto r = report_of("friction", servo_analysis::friction_findings(a, f, inertia));
  servo_analysis::Curve measured{"torque at constant speed", {}};
  std::sort(points.begin(), points.end(), [](const auto& p, const auto& q) { return p.speed < q.speed; });
  for (const auto& p : points) {
    measured.points.push_back({p.speed, p.torque});
    r.details["points"].push_back({p.speed, p.torque});
  }
  r.picture = picture_of(session, a, "friction",
                         {a.length_unit() + "/s", "of the rated torque", {std::move(measured)}});
  return r;
}

TestReport test_encoders(ServoSession& session, const TestOptions& o) {
  const auto& a = only_axis(session, o);
  const auto& p = session.parameters();
  if (p.integer(parameter::full_closed_loop, a.number) != 0)
    throw std::runtime_error("parameter " +
                             machine::number_text(parameter::full_closed_loop.number(a.number)) +
                             " is 1: compare the encoders in semi-closed loop (0)");
  const double travel = std::abs(p.get(parameter::travel_per_revolution, a.number)) / 1000;
  const auto result = session.run(samples_of({a.number}, 8),
                                  to_and_fro_program(a, a.into_travel(travel), feed_of(a, o.feed, 300), 2));
  if (result.traces.empty() || result.traces[0].size() < 2)
    throw std::runtime_error("the drive gave no samples of the motion");
  const auto& t = result.traces[0];
  auto r = report_of("encoders", servo_analysis::encoder_findings(p, a, servo_analysis::compare_encoders(t)));
  r.picture =
      picture_of(session, a, "encoders",
                 {"s",
                  a.length_unit(),
                  {over_time("motor", t.motor, t.interval, 1), over_time("load", t.load, t.interval, 1)}});
  return r;
}

}  // namespace trunnion::machine_tests
