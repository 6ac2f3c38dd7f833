// SPDX-License-Identifier: Apache-2.0
// measure k-test, r-test: a rotary axis turns with tool tip control, a ball sensor reads the tip's deviation
#include "ball_commands.hpp"

#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <iostream>
#include <memory>
#include <stdexcept>
#include <utility>

#include "circle_report.hpp"
#include "figures.hpp"
#include "identification/k_test.hpp"
#include "interrupt_watch.hpp"
#include "machine/kinematics.hpp"
#include "machine_tests/r_test_run.hpp"
#include "report/servo_pictures.hpp"
#include "storage/file.hpp"
#include "true_machine.hpp"

namespace trunnion::cli {
namespace {

using identification::BallSample;
using identification::BallTurn;
using identification::span_of;
using machine_tests::BallTest;
using machine_tests::ServoSession;
using servo_analysis::Curve;
using servo_analysis::Diagram;
using truth::Vec3;

constexpr const char* directions[] = {"X", "Y", "Z"};

struct CommandOptions : machine_tests::BallOptions {
  std::string machine, place, plot, test = "K2", output;
  std::size_t stops = 72, repeats = 1;
  double feed = 2000, cutoff = 20;  // mm/min along the circle of the ball, Hz
  std::vector<double> feeds, starts;
};

std::string table_row(const std::string& name, const Vec3& v, const char* unit) {
  return fmt::format("{:<34} {:>10.3f} {:>10.3f} {:>10.3f} {}", name, v[0] * um, v[1] * um, v[2] * um, unit);
}

std::vector<Curve> curves(const std::vector<double>& angles, const std::vector<Vec3>& deviations) {
  std::vector<Curve> all;
  for (Eigen::Index k = 0; k < 3; ++k) {
    Curve curve{directions[k], {}};
    for (std::size_t i = 0; i < angles.size(); ++i)
      curve.points.push_back({angles[i], deviations[i][k] * um});
    all.push_back(std::move(curve));
  }
  return all;
}

std::vector<Vec3> deviations_of(const std::vector<BallSample>& samples) {
  std::vector<Vec3> all;
  for (const auto& s : samples) all.push_back(s.deviation);
  return all;
}

std::string letter_of_axis(const ServoSession& session, const CommandOptions& o) {
  const auto model = machine::make_chain(session.parameters(), o.channel);
  const auto letter = identification::axis_of_test(
      model, o.test == "K2" ? identification::KTest::k2 : identification::KTest::k1);
  if (!letter) throw std::runtime_error("--test " + o.test + ": the machine has no rotary axis for it");
  return {*letter};
}

void take_place(CommandOptions& o) {
  if (!o.place.empty()) o.ball.place = coordinates("--ball", o.place);
}

void print_common(const BallTest& test, const CommandOptions& o, const BallTurn& turn) {
  std::cout << "axis " << o.axis
            << fmt::format(" from {:.3f} to {:.3f} deg, ball at X{:.3f} Y{:.3f} Z{:.3f} of the workpiece, ",
                           test.start(), test.start() + test.set().sweep, test.set().ball[0],
                           test.set().ball[1], test.set().ball[2])
            << fmt::format("tool {:.3f} mm\n", test.set().tool_length);
  print_figure("radius of the ball's circle", test.set().radius, "mm");
  print_figure("speed of the axis", std::abs(turn.speed), "rad/s");
  print_figure("readings in a second", 1 / turn.interval, "");
}

int k_test(CommandOptions o, const Common& common) {
  take_place(o);
  const InterruptWatch watch(true);
  ServoSession session(o.machine, common.domain, o.channel, &InterruptWatch::requested);
  o.axis = letter_of_axis(session, o);
  BallTest test(session, o);
  const auto motion = test.run(o.feed, test.start());
  const auto name = std::string(1, identification::annex_of(test.set().machine)) + o.test;
  bus::Json out = {{"machine", session.machine()},
                   {"test", name},
                   {"axis", o.axis},
                   {"feed_mm_per_min", o.feed},
                   {"radius_mm", test.set().radius},
                   {"ball_mm", vector_json(test.set().ball, 1)},
                   {"source", o.source}};
  if (!common.json) {
    std::cout << name << ", ";
    print_common(test, o, motion.there);
    std::cout << fmt::format("{:<34} {:>10} {:>10} {:>10}\n", "largest less least", "X", "Y", "Z");
  }
  std::vector<Diagram> diagrams;
  std::string csv = "sense,angle_deg,x_um,y_um,z_um\n";
  for (const auto* turn : {&motion.there, &motion.back}) {
    const auto figures = identification::figures_of(test.set(), *turn);
    const std::string sense = figures.positive ? "positive" : "negative";
    const auto& range = figures.range;
    out[sense] = {{"range_um", vector_json(figures.span, um)},
                  {"radial_um", range.radial * um},
                  {"tangential_um", range.tangential * um},
                  {"axial_um", range.axial * um}};
    for (std::size_t i = 0; i < figures.angles.size(); ++i) {
      const auto& deviation = figures.deviations[i];
      csv += fmt::format("{},{:.6f},{:.6f},{:.6f},{:.6f}\n", sense, figures.angles[i], deviation[0] * um,
                         deviation[1] * um, deviation[2] * um);
    }
    diagrams.push_back(
        {"deg of the axis, " + sense + " sense", "um", curves(figures.angles, figures.deviations)});
    if (common.json) continue;
    std::cout << table_row(sense + " sense", figures.span, "um") << "\n";
    print_figure("  radial", range.radial * um, "um");
    print_figure("  tangential", range.tangential * um, "um");
    print_figure("  along the axis", range.axial * um, "um");
  }
  if (!o.plot.empty())
    storage::replace_file(
        o.plot,
        report::stacked_picture(
            fmt::format("{}, {}: axis {}, F{:g}", session.machine(), name, o.axis, o.feed), diagrams));
  if (!o.output.empty()) storage::replace_file(o.output, csv);
  if (common.json) std::cout << bus::text_of(out) << "\n";
  return 0;
}

bus::Json json_of(const identification::AxisLocation& location) {
  bus::Json errors = bus::Json::object();
  for (const auto& e : location.errors)
    errors[e.name] = {{"value", e.value * (e.angle ? urad : um)},
                      {"uncertainty", e.uncertainty * (e.angle ? urad : um)},
                      {"unit", e.angle ? "urad" : "um"}};
  return {{"errors", errors}, {"not_shown", location.hidden}, {"residual_um", location.residual * um}};
}

void print_location(const identification::AxisLocation& location, const std::string& how) {
  for (const auto& e : location.errors) {
    const double unit = e.angle ? urad : um;
    print_figure(
        e.name + ", " + how, e.value * unit,
        fmt::format("{}, standard uncertainty {:.3f}", e.angle ? "urad" : "um", e.uncertainty * unit));
  }
  for (const auto& name : location.hidden)
    std::cout << name << ", " << how << ": this place of the ball does not show it\n";
  print_figure("residual, " + how, location.residual * um, "um");
}

int r_test_study(BallTest& test, const CommandOptions& o, const std::string& machine, bool json) {
  const auto rows = machine_tests::study_r_test(test, {o.feeds, o.starts, o.stops, o.repeats}, {o.cutoff});
  bus::Json out = {{"machine", machine}, {"axis", o.axis}, {"stops", o.stops}, {"repeats", o.repeats}};
  if (!json)
    std::cout
        << "standard deviation of dynamic less static, um; then after removal of servo, noise and pitch\n"
        << "    feed   start          X          Y          Z          X          Y          Z\n";
  std::vector<Curve> all;
  for (const auto& row : rows) {
    out["study"].push_back({{"feed_mm_per_min", row.feed},
                            {"start_deg", row.start},
                            {"difference_um", vector_json(row.difference, um)},
                            {"cleaned_um", vector_json(row.cleaned, um)}});
    if (!json)
      std::cout << fmt::format("{:>8g} {:>7g} {:>10.3f} {:>10.3f} {:>10.3f} {:>10.3f} {:>10.3f} {:>10.3f}\n",
                               row.feed, row.start, row.difference[0] * um, row.difference[1] * um,
                               row.difference[2] * um, row.cleaned[0] * um, row.cleaned[1] * um,
                               row.cleaned[2] * um);
    for (Eigen::Index k = 0; k < 2; ++k) {
      const auto name = fmt::format("{}, start {:g}", directions[k], row.start);
      auto curve = std::find_if(all.begin(), all.end(), [&](const auto& c) { return c.name == name; });
      if (curve == all.end()) curve = all.insert(all.end(), {name, {}});
      curve->points.push_back({row.feed, row.difference[k] * um});
    }
  }
  if (!o.plot.empty())
    storage::replace_file(o.plot, report::picture_of(machine + ": dynamic less static, standard deviation",
                                                     Diagram{"mm/min", "um", std::move(all)}));
  if (json) std::cout << bus::text_of(out) << "\n";
  return 0;
}

int r_test(CommandOptions o, const Common& common) {
  take_place(o);
  const InterruptWatch watch(true);
  ServoSession session(o.machine, common.domain, o.channel, &InterruptWatch::requested);
  BallTest test(session, o);
  if (!o.feeds.empty() || !o.starts.empty()) {
    if (o.feeds.empty()) o.feeds = {o.feed};
    if (o.starts.empty()) o.starts = {test.start()};
    if (o.stops < identification::least_stops)
      throw std::runtime_error("--stops: the study compares with at least 4 stops");
    return r_test_study(test, o, session.machine(), common.json);
  }
  const auto found = machine_tests::run_r_test(test, o.feed, o.stops, {o.cutoff});
  const auto& motion = found.motion;
  const auto& result = found.result;
  const auto& stops = found.stops;
  const double speed = std::abs(motion.there.speed);
  bus::Json out = {{"machine", session.machine()},
                   {"axis", o.axis},
                   {"source", o.source},
                   {"feed_mm_per_min", o.feed},
                   {"speed_rad_per_s", speed},
                   {"radius_mm", test.set().radius},
                   {"ball_mm", vector_json(test.set().ball, 1)},
                   {"interval_s", motion.there.interval},
                   {"readings", result.angles.size()},
                   {"noise_um", vector_json(motion.there.noise, um)},
                   {"range_um", vector_json(span_of(result.read), um)},
                   {"cleaned_range_um", vector_json(span_of(result.cleaned), um)},
                   {"dynamic", json_of(result.location)}};
  for (const auto& s : motion.servos)
    out["servos"].push_back({{"axis", std::string(1, s.letter)},
                             {"natural_frequency_rad_per_s", s.response.natural_frequency},
                             {"damping", s.response.damping},
                             {"zero_time_s", s.response.zero_time},
                             {"position_gain_per_s", s.response.position_gain},
                             {"feedforward", s.response.feedforward},
                             {"fit_percent", s.response.fit},
                             {"prediction_error_um", s.prediction_error * um}});
  out["pitch"] = bus::Json::array();
  for (const auto& h : result.pitch)
    out["pitch"].push_back({{"order", h.order},
                            {"amplitude_um", h.amplitude * um},
                            {"phase_deg", h.phase},
                            {"frequency_rad_per_s", static_cast<double>(h.order) * speed}});
  const auto& standing = found.comparison;
  if (standing) {
    out["static"] = json_of(standing->location);
    out["static"]["stops"] = stops.size();
    out["dynamic_less_static_um"] = vector_json(standing->difference, um);
    out["cleaned_less_static_um"] = vector_json(standing->cleaned, um);
  }
  if (!o.plot.empty()) {
    std::vector<Diagram> diagrams = {{"deg of the axis, as read", "um", curves(result.angles, result.read)},
                                     {"deg of the axis, without servo, noise and pitch error", "um",
                                      curves(result.angles, result.cleaned)}};
    if (!stops.empty()) {
      std::vector<double> angles;
      for (const auto& s : stops) angles.push_back(s.turned);
      diagrams.push_back({"deg of the axis, at " + std::to_string(stops.size()) + " stops", "um",
                          curves(angles, deviations_of(stops))});
    }
    Curve spectrum{"tangential amplitude", {}};
    for (const auto& h : result.tangential)
      if (h.order > 1 && h.order <= 100)
        spectrum.points.push_back({static_cast<double>(h.order), h.amplitude * um});
    if (!spectrum.points.empty()) diagrams.push_back({"harmonic of the turn", "um", {spectrum}});
    storage::replace_file(
        o.plot, report::stacked_picture(
                    fmt::format("{}: R-test, axis {}, F{:g}", session.machine(), o.axis, o.feed), diagrams));
  }
  if (!o.output.empty()) {
    std::string csv = "angle_deg,x_um,y_um,z_um,cleaned_x_um,cleaned_y_um,cleaned_z_um\n";
    for (std::size_t i = 0; i < result.angles.size(); ++i)
      csv += fmt::format("{:.6f},{:.6f},{:.6f},{:.6f},{:.6f},{:.6f},{:.6f}\n", result.angles[i],
                         result.read[i][0] * um, result.read[i][1] * um, result.read[i][2] * um,
                         result.cleaned[i][0] * um, result.cleaned[i][1] * um, result.cleaned[i][2] * um);
    storage::replace_file(o.output, csv);
  }
  if (common.json) {
    std::cout << bus::text_of(out) << "\n";
    return 0;
  }
  print_common(test, o, motion.there);
  for (const auto& s : motion.servos)
    std::cout << fmt::format(
        "servo {}: wn {:.1f} rad/s, xi {:.3f}, tau {:.3f} ms, Kv {:.1f} 1/s, feed-forward {:.3f}, fit {:.2f} "
        "%\n",
        s.letter, s.response.natural_frequency, s.response.damping, s.response.zero_time * 1e3,
        s.response.position_gain, s.response.feedforward, s.response.fit);
  std::cout << fmt::format("{:<34} {:>10} {:>10} {:>10}\n", "", "X", "Y", "Z");
  std::cout << table_row("noise at rest, standard deviation", motion.there.noise, "um") << "\n"
            << table_row("largest less least, as read", span_of(result.read), "um") << "\n"
            << table_row("  without servo, noise, pitch", span_of(result.cleaned), "um") << "\n";
  if (standing)
    std::cout << table_row("dynamic less static, standard dev.", standing->difference, "um") << "\n"
              << table_row("  without servo, noise, pitch", standing->cleaned, "um") << "\n";
  for (const auto& h : result.pitch)
    print_figure("pitch error, harmonic " + std::to_string(h.order), h.amplitude * um,
                 fmt::format("um at {:.2f} rad/s", static_cast<double>(h.order) * speed));
  print_location(result.location, "dynamic");
  if (standing) print_location(standing->location, "static");
  return 0;
}

void add_options(CLI::App* command, CommandOptions& o) {
  command->add_option(
      "machine", o.machine,
      "Name under configs/machines or a directory: a cluster of its own in virtual time; without "
      "it the cluster that runs");
  command->add_option("--feed", o.feed, "mm/min along the circle of the ball (default 2000)")
      ->check(CLI::Range(1.0, 1e6));
  command->add_option("--ball", o.place,
                      "Place X,Y,Z of the ball in the workpiece frame (default: --radius, --height)");
  command->add_option("--radius", o.ball.radius, "Of the ball about a table's axis, mm (default 72.411)")
      ->check(CLI::Range(1.0, 1e4));
  command->add_option("--height", o.ball.height, "Of the ball above the table axis' point, mm (default 50)")
      ->check(CLI::Range(-1e4, 1e4));
  command->add_option("--start", o.start, "deg (default 0, or the begin of the travel)")
      ->check(CLI::Range(-1e4, 1e4));
  command->add_option("--sweep", o.sweep, "deg, signed (default a turn, or 90 % of the travel)")
      ->check(CLI::Range(-360.0, 360.0));
  command->add_option("--hold", o.hold, "A-30: the angle of another rotary axis; may be repeated")
      ->allow_extra_args(false);
  command->add_option("--tool", o.tool, "Tool whose tip is the ball's centre, H (default 1)")
      ->check(CLI::Range(1, 999));
  command
      ->add_option("--source", o.source,
                   "true (default): sensors on the true machine; encoder: position loops")
      ->check(CLI::IsMember({"true", "encoder"}));
  command->add_option("--channel", o.channel, "Channel (default 0)")->check(CLI::Range(0, 9));
  command->add_option("--plot", o.plot, "Write the diagrams (SVG)");
  command->add_option("--output", o.output, "Write the readings (CSV)");
}

}  // namespace

void add_ball_commands(CLI::App& measure, Common& common) {
  auto k = std::make_shared<CommandOptions>();
  auto* command =
      add_command(measure, common, "k-test",
                  "Circle of ISO 10791-6 with a rotary and two or three linear axes: a ball sensor "
                  "reads the tip under RTCP in both senses",
                  [k, &common] { return k_test(*k, common); });
  command->add_option("--test", k->test, "K1: the axis that swivels; K2 (default): the one along the tool")
      ->check(CLI::IsMember({"K1", "K2"}));
  add_options(command, *k);
  auto r = std::make_shared<CommandOptions>();
  command =
      add_command(measure, common, "r-test",
                  "Dynamic R-test of a rotary axis: response of the servos, pitch error, location errors, "
                  "compared with stops; with --feeds or --starts a study of them",
                  [r, &common] { return r_test(*r, common); });
  command->add_option("--axis", r->axis, "Rotary axis (default C)");
  add_options(command, *r);
  command->add_option("--stops", r->stops, "Stops of the static test (default 72, 0: none)")
      ->check(CLI::Range(0, 3600));
  command->add_option("--cutoff", r->cutoff, "Of the Kalman filter, Hz (default 20)")
      ->check(CLI::Range(0.1, 900.0));
  command->add_option("--feeds", r->feeds, "Study: feeds, mm/min, separated by commas")->delimiter(',');
  command->add_option("--starts", r->starts, "Study: start angles, deg, separated by commas")->delimiter(',');
  command->add_option("--repeats", r->repeats, "Study: of each (default 1)")->check(CLI::Range(1, 100));
}

}  // namespace trunnion::cli
