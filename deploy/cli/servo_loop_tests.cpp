// SPDX-License-Identifier: Apache-2.0
// Servo tests that look into the loops: current, frequency response, friction, encoders.
#include <algorithm>
#include <cmath>

#include "machine/parameter_constants.hpp"
#include "servo_pictures.hpp"
#include "servo_test_parts.hpp"

namespace trunnion::cli {

using idl::servo::TestRequest;
using idl::servo::TestSignal;
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
  // In the period of a step the other loops do nothing yet: the torque changes by a share of the step, which
  // is the period over the time constant.
  double both = 0, square = 0;
  for (std::size_t i = 1; i < t.size(); ++i) {
    const double step = t.excitation[i] - t.excitation[i - 1];
    both += step * (t.torque[i] - t.torque[i - 1]);
    square += step * step;
  }
  if (!(both > 0)) throw std::runtime_error("the torque does not follow its setpoint");
  const double time = t.interval / (both / square);
  TestReport r;
  r.test = "current";
  r.figures = {{"time constant", time * 1e3, "ms", {}, {}}, {"bandwidth", 1 / time, "1/s", {}, {}}};
  r.notes.push_back("PA27 of the manual: 6000 for a hardware current loop, 3000 to 4000 for an ordinary one");
  r.picture = curves_picture(
      picture_title(session, a, "current loop"), "s", "share of the rated torque",
      {over_time("excitation", t.excitation, t.interval, 1), over_time("torque", t.torque, t.interval, 1)});
  return r;
}

TestReport test_frequency(ServoSession& session, const TestOptions& o) {
  const auto& a = only_axis(session, o);
  constexpr double period = 1;  // s: lines of 1 Hz
  constexpr int periods = 3;
  const double feed = feed_of(a, o, 600), v = feed / per_minute;
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
  const auto m = servo_analysis::margins(open);
  TestReport r;
  r.test = "frequency";
  if (m.crossover) r.figures.push_back({"crossover frequency", *m.crossover, "Hz", {}, {}});
  if (m.phase_margin) r.figures.push_back({"phase margin", *m.phase_margin, "deg", 30, {}});
  if (m.gain_margin) r.figures.push_back({"gain margin", 20 * std::log10(*m.gain_margin), "dB", 1.9, {}});
  if (const auto b = servo_analysis::bandwidth(closed))
    r.figures.push_back({"bandwidth (-3 dB)", *b, "Hz", {}, {}});
  r.figures.push_back(
      {"resonance peak", 20 * std::log10(servo_analysis::resonance_peak(closed)), "dB", {}, {}});
  r.notes.push_back("1.9 dB are 80 % of the critical gain; 30 deg are our choice");
  for (std::size_t i = 0; i < open.size(); ++i)
    r.details["response"].push_back(
        {open[i].frequency, 20 * std::log10(std::abs(open[i].value)), std::arg(open[i].value) * 180 / M_PI,
         20 * std::log10(std::abs(closed[i].value)), std::arg(closed[i].value) * 180 / M_PI});
  r.picture =
      bode_picture(picture_title(session, a, position ? "position loop" : "speed loop"), closed, open);
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
  TestReport r;
  r.test = "friction";
  const std::string share = "of the rated torque", per = share + " per " + length_unit(a) + "/s";
  const double rated = 1.5 * a.acceleration;
  r.figures = {{"Coulomb friction", f.coulomb, share, {}, {}},
               {"breakaway friction", f.breakaway, share, {}, {}},
               {"Stribeck speed", f.stribeck_speed, length_unit(a) + "/s", {}, {}},
               {"viscous friction", f.viscous, per, {}, {}},
               {"weight", f.gravity, share, {}, {}},
               {"inertia over the nominal one", inertia * rated, "", {}, {}},
               {"residual", f.residual, share, {}, {}}};
  PictureCurve measured{"torque at constant speed", {}};
  std::sort(points.begin(), points.end(), [](const auto& p, const auto& q) { return p.speed < q.speed; });
  for (const auto& p : points) {
    measured.points.push_back({p.speed, p.torque});
    r.details["points"].push_back({p.speed, p.torque});
  }
  r.picture = curves_picture(picture_title(session, a, "friction"), length_unit(a) + "/s", share, {measured});
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
                                  to_and_fro_program(a, a.into_travel(travel), feed_of(a, o, 300), 2));
  if (result.traces.empty() || result.traces[0].size() < 2)
    throw std::runtime_error("the drive gave no samples of the motion");
  const auto& t = result.traces[0];
  // The far half of the way there: backlash and friction are behind it.
  const auto phases = servo_analysis::constant_phases(t, 0.2);
  if (phases.empty()) throw std::runtime_error("the motion had no constant speed");
  const auto end = phases.front().end, half = (phases.front().begin + end) / 2;
  double motor_mean = 0, load_mean = 0, both = 0, square = 0;
  for (std::size_t i = half; i < end; ++i) motor_mean += t.motor[i], load_mean += t.load[i];
  motor_mean /= static_cast<double>(end - half), load_mean /= static_cast<double>(end - half);
  for (std::size_t i = half; i < end; ++i) {
    both += (t.motor[i] - motor_mean) * (t.load[i] - load_mean);
    square += std::pow(t.motor[i] - motor_mean, 2);
  }
  const double ratio = square > 0 ? both / square : 0;
  const double motor = std::copysign(travel, t.motor[end - 1] - t.motor[half]), load = ratio * motor;
  const double motor_pulses = p.get(parameter::motor_encoder_pulses, a.number) / travel;
  const double load_pulses = p.get(parameter::load_encoder_pulses, a.number);
  TestReport r;
  r.test = "encoders";
  // A display of the drive has four digits: the upper one counts 10000 of the lower one, both with the sign.
  const auto displayed = [&](const char* name, const char* high, const char* low, double pulses) {
    const double whole = std::round(pulses), upper = std::trunc(whole / 10000);
    r.figures.push_back({name, pulses, "pulses", {}, {}});
    r.figures.push_back({high, upper, "10000 pulses", {}, {}});
    r.figures.push_back({low, whole - 10000 * upper, "pulses", {}, {}});
  };
  displayed("motor encoder", "DP-PFH", "DP-PFL", motor * motor_pulses);
  if (load_pulses > 0) displayed("load encoder", "DP-FPH", "DP-FPL", load * load_pulses / travel);
  r.figures.push_back({"load over motor", ratio, "", 0.99, 1.01});
  const auto parameter_text = [&](const auto& key) { return machine::number_text(key.number(a.number)); };
  if (std::abs(ratio) < 0.01) {
    r.notes.push_back("the load encoder does not move: look for its cable, or the axis has none");
  } else {
    if (ratio < 0) {
      const int now = p.integer(parameter::load_encoder_reversed, a.number);
      r.notes.push_back("the load encoder counts in the opposite direction: set " +
                        parameter_text(parameter::load_encoder_reversed) + " to " + std::to_string(1 - now) +
                        " (PA10 = 512) before the loop is closed over it");
      r.proposal.push_back({parameter::load_encoder_reversed.number(a.number), 1.0 - now});
    }
    if (std::abs(std::abs(ratio) - 1) > 0.01 && load_pulses > 0) {
      const double right = std::round(load_pulses * std::abs(ratio));
      r.notes.push_back("the load encoder gives " + std::to_string(static_cast<long>(right)) +
                        " pulses for one revolution of the motor: set " +
                        parameter_text(parameter::load_encoder_pulses) + " (PB46, PB47) to it");
      r.proposal.push_back({parameter::load_encoder_pulses.number(a.number), right});
    }
    if (r.proposal.empty())
      r.notes.push_back("signs and pulses agree: " + parameter_text(parameter::full_closed_loop) +
                        " = 1 (STB14) may close the loop over the load encoder");
  }
  r.picture =
      curves_picture(picture_title(session, a, "encoders"), "s", length_unit(a),
                     {over_time("motor", t.motor, t.interval, 1), over_time("load", t.load, t.interval, 1)});
  return r;
}

}  // namespace trunnion::cli
