// SPDX-License-Identifier: Apache-2.0
// measure circle: the circular test of ISO 230-4 on a cluster, or of a recording
#include "circle_command.hpp"

#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>
#include <stdexcept>

#include "circle_report.hpp"
#include "figures.hpp"
#include "identification/circle_test.hpp"
#include "interrupt_watch.hpp"
#include "machine_tests/sampled_motion.hpp"
#include "report/captured_motion.hpp"
#include "report/truth_pictures.hpp"
#include "storage/file.hpp"
#include "true_machine.hpp"

namespace trunnion::cli {
namespace {

using circular_tests::ProgrammedCircle;
using servo_analysis::ChannelMotion;
using truth::Vec3;

constexpr double found_within = 1e-4;  // mm: of a recording, the path from its circle

struct CircleOptions {
  std::string machine, plane = "XY", source = "true", recording, plot, output, at;
  double radius = 100, feed = 1000, start = 0, overrun = 45, tool_length = 0;
  std::uint16_t channel = 0;
};

void write_readings(const std::string& path, const std::vector<geometry::RadialReading>& ccw,
                    const std::vector<geometry::RadialReading>& cw) {
  std::string lines = "sense,angle_deg,deviation_um\n";
  for (const auto* readings : {&ccw, &cw})
    for (const auto& r : *readings)
      lines += fmt::format("{},{:.6f},{:.6f}\n", readings == &ccw ? "ccw" : "cw", r.angle, r.deviation * um);
  storage::replace_file(path, lines);
}

// What was run, and on which machine.
struct CircleRun {
  ChannelMotion motion;
  ProgrammedCircle circle;
  std::string name, directory;
  machine::Parameters parameters;
};

CircleRun recorded_run(const CircleOptions& o) {
  if (o.source == "true" && o.machine.empty())
    throw std::runtime_error("--source true reads truth.yaml: name the machine, or choose --source encoder");
  CircleRun run;
  run.name = o.machine.empty() ? o.recording : o.machine;
  run.directory = o.machine;
  run.motion = report::motion_of_recording(o.recording, o.channel, run.parameters);
  try {
    const auto commanded = identification::commanded_points(run.motion, circular_tests::plane_of(o.plane));
    run.circle = circular_tests::find_circle(commanded, found_within);
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(o.recording + ": plane " + o.plane + ": " + error.what());
  }
  return run;
}

CircleRun run_on_machine(const CircleOptions& o, const Common& common) {
  const InterruptWatch watch(true);
  machine_tests::ServoSession session(o.machine, common.domain, o.channel, &InterruptWatch::requested);
  const Vec3 centre = o.at.empty() ? machine_tests::linear_place(session) : coordinates("--at", o.at);
  const auto plane = circular_tests::plane_of(o.plane);
  CircleRun run;
  run.motion = machine_tests::run_circle(session, {o.plane, centre, o.radius, o.feed, o.start, o.overrun});
  run.circle = {
      {centre[static_cast<Eigen::Index>(plane.first)], centre[static_cast<Eigen::Index>(plane.second)]},
      o.radius};
  run.name = session.machine(), run.directory = session.machine_directory();
  run.parameters = session.parameters();
  return run;
}

identification::CircleTest evaluated(const CircleOptions& o, const CircleRun& run) {
  const auto plane = circular_tests::plane_of(o.plane);
  if (o.source != "true")
    return identification::evaluate_circle(run.motion, o.plane, run.circle,
                                           identification::encoder_points(run.motion, plane), {});
  auto machine = load_true_machine(run.directory, o.channel, {});
  take_model(machine, run.parameters, o.channel);
  machine.report->tool_length = o.tool_length;
  return identification::evaluate_circle(
      run.motion, o.plane, run.circle,
      identification::true_points(run.motion, plane, run.circle, *machine.report),
      identification::instrument(machine, "ballbar"));
}

int measure_circle(const CircleOptions& o, const Common& common) {
  const auto run = o.recording.empty() ? run_on_machine(o, common) : recorded_run(o);
  const auto test = evaluated(o, run);
  const auto& circle = run.circle;
  if (!o.output.empty()) write_readings(o.output, test.readings.ccw, test.readings.cw);
  if (!o.plot.empty())
    storage::replace_file(
        o.plot,
        report::ballbar_picture(
            test.readings, fmt::format("{}, plane {}, R{:g} F{:.0f}, {}", run.name, o.plane, circle.radius,
                                       test.feed, o.source == "true" ? "true machine" : "encoders")));
  if (common.json) {
    auto out = report_json(test.report);
    out["machine"] = run.name, out["source"] = o.source;
    out["centre_mm"] = {circle.centre.first, circle.centre.second};
    out["feed_mm_per_min"] = test.feed, out["servo_mismatch_ms"] = test.servo_mismatch;
    out["start_deg"] = test.start, out["overrun_deg"] = test.overrun;
    out["interval_s"] = run.motion.interval;
    out["readings"] = {test.readings.ccw.size(), test.readings.cw.size()};
    std::cout << bus::text_of(out) << "\n";
    return 0;
  }
  print_figure("radius", circle.radius, "mm");
  print_figure("feed reached", test.feed, "mm/min");
  print_figure("start angle", test.start, "deg");
  print_figure("readings in a second", 1 / run.motion.interval, "");
  print_report(test.report);
  print_figure("servo mismatch", test.servo_mismatch, "ms");
  for (const auto& file : {o.output, o.plot})
    if (!file.empty()) std::cout << file << "\n";
  return 0;
}

}  // namespace

void add_circle_command(CLI::App& measure, Common& common) {
  auto o = std::make_shared<CircleOptions>();
  auto* command = add_command(measure, common, "circle",
                              "Circular test by ISO 230-4: the axes run a circle in both senses, with servo "
                              "drives; or of a recording",
                              [o, &common] { return measure_circle(*o, common); });
  command->add_option("machine", o->machine,
                      "Name under configs/machines or a directory: a cluster of its own in virtual time; "
                      "without it the cluster that runs");
  command->add_option("--plane", o->plane, "XY (default), XZ or YZ")
      ->check(CLI::IsMember({"XY", "XZ", "YZ"}));
  command->add_option("--radius", o->radius, "mm (default 100)")->check(CLI::Range(1.0, 1e4));
  command->add_option("--feed", o->feed, "mm/min (default 1000)")->check(CLI::Range(1.0, 1e6));
  command->add_option("--start", o->start, "Angle at which the reading begins, deg (default 0)")
      ->check(CLI::Range(-360.0, 360.0));
  command->add_option("--overrun", o->overrun, "Before and behind the reading, deg (default 45)")
      ->check(CLI::Range(0.0, 180.0));
  command->add_option("--at", o->at, "Centre X,Y,Z in machine coordinates (default: where the axes are)");
  command
      ->add_option("--source", o->source,
                   "true (default): a ballbar on the true machine of truth.yaml; encoder: the position loops")
      ->check(CLI::IsMember({"true", "encoder"}));
  command->add_option("--tool-length", o->tool_length, "Spindle face to the ball, mm (default 0)")
      ->check(CLI::Range(-1e6, 1e6));
  command->add_option("--recording", o->recording, "Find the circle in this recording; nothing moves");
  command->add_option("--channel", o->channel, "Channel (default 0)")->check(CLI::Range(0, 9));
  command->add_option("--plot", o->plot, "Write the polar plot (SVG)");
  command->add_option("--output", o->output, "Write the readings (CSV)");
}

}  // namespace trunnion::cli
