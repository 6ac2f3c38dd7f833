// SPDX-License-Identifier: Apache-2.0
#include "servo_analysis/test_findings.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "machine/parameter_constants.hpp"

namespace trunnion::servo_analysis {

bool TestFindings::reached() const {
  return std::all_of(figures.begin(), figures.end(), [](const auto& f) { return f.reached(); });
}

// 0.2 mm is the limit at 1000 mm/min; the error of a loop without feed-forward is in proportion to the speed.
// A gain that no loop can have is no measured one.
TestFindings position_findings(const TestedAxis& a, double feed, const MotionFigures& f, double slower,
                               const MotionFigures& bare, double highest_gain) {
  TestFindings r;
  r.figures = {{"following error", std::abs(f.following_error), a.length_unit(), {}, 0.2 * feed / 1000},
               {"largest following error", f.following_peak, a.length_unit(), {}, {}},
               {"following error without feed-forward",
                std::abs(bare.following_error),
                a.length_unit(),
                {},
                0.2 * slower / 1000},
               {"Kv", bare.velocity_gain, "1/s", least_position_gain, highest_gain}};
  r.notes.push_back(fmt::format("Kv is speed over following error without feed-forward at {:.0f} {}", slower,
                                a.speed_unit()));
  r.notes.push_back(
      "at 1000 mm/min 0.2 mm is Kv 83 1/s and 0.1 mm, the best, 167 1/s: a larger error needs a higher "
      "position gain (10a900, PA0)");
  return r;
}

TestFindings speed_findings(const TestedAxis& a, const MotionFigures& f) {
  TestFindings r;
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
  return r;
}

TestFindings overshoot_findings(const TestedAxis& a,
                                const std::vector<std::pair<double, MotionFigures>>& moved,
                                bool full_closed_loop) {
  TestFindings r;
  for (const auto& [feed, f] : moved) {
    const double limit = full_closed_loop && feed <= 500 ? 100 : 40;
    r.figures.push_back({"overshoot at F" + std::to_string(static_cast<int>(feed)),
                         f.overshoot * per_minute,
                         a.speed_unit(),
                         {},
                         limit});
  }
  r.notes.push_back(
      "above the limit: lower the speed gain (10a901, PA2) or acceleration and jerk of the axis");
  return r;
}

TestFindings roundness_findings(char first, char second, const RoundnessFigures& f,
                                const RoundnessFigures& bare) {
  TestFindings r;
  r.figures = {{"circular deviation", f.deviation * 1e3, "um", {}, {}},
               {"mean radius less programmed", f.radius_error * 1e3, "um", {}, {}},
               {"servo mismatch", f.mismatch, "ms", -1, 1},
               {"servo mismatch without feed-forward", bare.mismatch, "ms", -1, 1}};
  for (std::size_t q = 0; q < 4; ++q)
    r.figures.push_back(
        {"quadrant jump at " + std::to_string(90 * q) + " deg", f.quadrant_jump[q], "mm", {}, 0.01});
  r.notes.push_back(
      fmt::format("a mismatch above zero: {} lags behind {}; make the position gains (10a900, PA0) equal",
                  first, second));
  return r;
}

TestFindings rtcp_findings(const SimultaneousFigures& f, const std::vector<AxisLag>& lags) {
  const auto [least, most] =
      std::minmax_element(lags.begin(), lags.end(), [](auto& p, auto& q) { return p.time < q.time; });
  TestFindings r;
  r.figures = {{"mismatch of linear axes", f.linear * 1e3, "um", {}, 1},
               {"mismatch of rotary axis", f.rotary * 1e3, "um", {}, 1},
               {"servo mismatch without feed-forward", (most->time - least->time) * 1e3, "ms", {}, 1}};
  for (const auto& lag : lags)
    r.figures.push_back({fmt::format("time lag of {}", lag.letter), lag.time * 1e3, "ms", {}, {}});
  r.notes.push_back(
      "time lags are without feed-forward, 1 / Kv; above the limit: lower the position gain (10a900, PA0) of "
      "every axis to that of the weakest");
  return r;
}

TestFindings current_findings(double time) {
  TestFindings r;
  r.figures = {{"time constant", time * 1e3, "ms", {}, {}}, {"bandwidth", 1 / time, "1/s", {}, {}}};
  r.notes.push_back("PA27 of the manual: 6000 for a hardware current loop, 3000 to 4000 for an ordinary one");
  return r;
}

TestFindings frequency_findings(const Response& open, const Response& closed) {
  const auto m = margins(open);
  TestFindings r;
  if (m.crossover) r.figures.push_back({"crossover frequency", *m.crossover, "Hz", {}, {}});
  if (m.phase_margin) r.figures.push_back({"phase margin", *m.phase_margin, "deg", 30, {}});
  if (m.gain_margin) r.figures.push_back({"gain margin", 20 * std::log10(*m.gain_margin), "dB", 1.9, {}});
  if (const auto b = bandwidth(closed)) r.figures.push_back({"bandwidth (-3 dB)", *b, "Hz", {}, {}});
  r.figures.push_back({"resonance peak", 20 * std::log10(resonance_peak(closed)), "dB", {}, {}});
  r.notes.push_back("1.9 dB are 80 % of the critical gain; 30 deg are our choice");
  return r;
}

TestFindings friction_findings(const TestedAxis& a, const FrictionModel& f, double inertia) {
  const std::string share = "of the rated torque", per = share + " per " + a.length_unit() + "/s";
  const double rated = 1.5 * a.acceleration;
  TestFindings r;
  r.figures = {{"Coulomb friction", f.coulomb, share, {}, {}},
               {"breakaway friction", f.breakaway, share, {}, {}},
               {"Stribeck speed", f.stribeck_speed, a.length_unit() + "/s", {}, {}},
               {"viscous friction", f.viscous, per, {}, {}},
               {"weight", f.gravity, share, {}, {}},
               {"inertia over the nominal one", inertia * rated, "", {}, {}},
               {"residual", f.residual, share, {}, {}}};
  return r;
}

namespace {

// A display of the drive has four digits: the upper one counts 10000 of the lower one, both with the sign.
void add_displayed(TestFindings& r, const char* name, const char* high, const char* low, double pulses) {
  const double whole = std::round(pulses), upper = std::trunc(whole / 10000);
  r.figures.push_back({name, pulses, "pulses", {}, {}});
  r.figures.push_back({high, upper, "10000 pulses", {}, {}});
  r.figures.push_back({low, whole - 10000 * upper, "pulses", {}, {}});
}

}  // namespace

TestFindings encoder_findings(const machine::Parameters& p, const TestedAxis& a,
                              const EncoderComparison& compared) {
  const double travel = std::abs(p.get(parameter::travel_per_revolution, a.number)) / 1000;
  const double ratio = compared.ratio;
  const double motor = compared.motor_sense * travel, load = ratio * motor;
  const double motor_pulses = p.get(parameter::motor_encoder_pulses, a.number) / travel;
  const double load_pulses = p.get(parameter::load_encoder_pulses, a.number);
  TestFindings r;
  add_displayed(r, "motor encoder", "DP-PFH", "DP-PFL", motor * motor_pulses);
  if (load_pulses > 0) add_displayed(r, "load encoder", "DP-FPH", "DP-FPL", load * load_pulses / travel);
  r.figures.push_back({"load over motor", ratio, "", 0.99, 1.01});
  const auto parameter_text = [&](const auto& key) { return machine::number_text(key.number(a.number)); };
  if (std::abs(ratio) < 0.01) {
    r.notes.push_back("the load encoder does not move: look for its cable, or the axis has none");
    return r;
  }
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
  return r;
}

}  // namespace trunnion::servo_analysis
