// SPDX-License-Identifier: Apache-2.0
// measure: the instruments on a machine with errors
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <iostream>
#include <memory>

#include "ball_commands.hpp"
#include "bus/json.hpp"
#include "circle_command.hpp"
#include "circle_report.hpp"
#include "commands.hpp"
#include "figures.hpp"
#include "geometry_command.hpp"
#include "identification/measurement_plan.hpp"
#include "report/truth_pictures.hpp"
#include "storage/file.hpp"
#include "true_machine.hpp"
#include "truth/measurement.hpp"

namespace trunnion::cli {
namespace {

struct MeasureOptions {
  std::string machine, plot, plane = "XY", error = "EXX", axis = "C", at = "0,0,0";
  double tool_length = 0, radius = 100, from = 0, to = 0;
  std::uint16_t channel = 0;
  std::size_t points = 0, runs = 5;
  std::vector<std::string> set;
};

void write_plot(const std::string& path, const std::string& svg, bool json) {
  if (path.empty()) return;
  storage::replace_file(path, svg);
  if (!json) std::cout << path << "\n";
}

TrueMachine machine_of(const MeasureOptions& o) {
  if (!std::isfinite(o.tool_length)) throw std::runtime_error("--tool-length: not a number");
  auto machine = load_true_machine(o.machine, o.channel, o.set);
  machine.report->tool_length = o.tool_length;
  return machine;
}

int ballbar(const MeasureOptions& o, bool json) {
  const auto machine = machine_of(o);
  truth::BallbarPath path;
  path.centre = coordinates("--at", o.at);
  path.radius = o.radius;
  path.first = o.plane[0] == 'X' ? 0 : 1;
  path.second = o.plane[1] == 'Y' ? 1 : 2;
  if (o.points > 0) path.points = o.points;
  const auto m =
      truth::measure_ballbar(*machine.report, path, identification::instrument(machine, "ballbar"));
  const auto r = circular_tests::circle_report(o.plane, path.radius, m.ccw, m.cw);
  write_plot(o.plot, report::ballbar_picture(m, machine.name + ", plane " + o.plane), json);
  if (json) {
    auto out = report_json(r);
    out["machine"] = machine.name, out["ccw"] = readings_json(m.ccw), out["cw"] = readings_json(m.cw);
    std::cout << bus::text_of(out) << "\n";
    return 0;
  }
  print_report(r);
  return 0;
}

int laser(const MeasureOptions& o, bool json) {
  const auto machine = machine_of(o);
  const auto error = identification::linear_axis_error(o.error);
  if (!error)
    throw std::runtime_error("--error " + o.error + ": expected EXX, EYX .. ECZ: an error of X, Y or Z");
  if (!identification::laser_shows(*error, machine.report->model().tool_direction()))
    throw std::runtime_error("--error " + o.error +
                             ": a rotation about the tool does not move the tool's axis");
  truth::LaserPlan plan;
  plan.component = error->component, plan.axis = error->axis;
  const bool angle = plan.component > 2;
  const auto& travel = machine.outline.axes[plan.axis];
  const bool given = o.from != o.to;
  plan.from = given ? o.from : travel.low + 0.05 * (travel.high - travel.low);
  plan.to = given ? o.to : travel.high - 0.05 * (travel.high - travel.low);
  if (!(plan.to > plan.from)) throw std::runtime_error("--from must be below --to");
  plan.others = coordinates("--at", o.at);
  if (o.points > 0) plan.targets = o.points;
  plan.runs = o.runs;
  const auto m = truth::measure_laser(*machine.report, plan,
                                      identification::instrument(machine, angle ? "laser_angle" : "laser"));
  const double unit = angle ? urad : um;
  const char* name = angle ? "urad" : "um";
  write_plot(o.plot, report::laser_picture(m, machine.name + " " + o.error, unit, name), json);
  const auto& a = m.accuracy;
  const std::pair<const char*, double> figures[] = {{"accuracy_A", a.accuracy},
                                                    {"systematic_E", a.systematic},
                                                    {"mean_bidirectional_M", a.mean_bidirectional},
                                                    {"repeatability_R", a.repeatability},
                                                    {"reversal_B", a.reversal},
                                                    {"mean_reversal", a.mean_reversal}};
  if (json) {
    bus::Json out = {{"machine", machine.name}, {"error", o.error}, {"unit", name}};
    for (const auto& [figure, value] : figures) out[figure] = value * unit;
    for (const auto& target : m.targets) {
      bus::Json up = bus::Json::array(), down = bus::Json::array();
      for (const double value : target.up) up.push_back(value * unit);
      for (const double value : target.down) down.push_back(value * unit);
      out["targets"].push_back({{"position_mm", target.position}, {"up", up}, {"down", down}});
    }
    std::cout << bus::text_of(out) << "\n";
    return 0;
  }
  for (const auto& target : m.targets) {
    double up = 0, down = 0;
    for (const double value : target.up) up += value * unit / static_cast<double>(target.up.size());
    for (const double value : target.down) down += value * unit / static_cast<double>(target.down.size());
    std::cout << fmt::format("{:>12.4f} {:>10.3f} {:>10.3f} {}\n", target.position, up, down, name);
  }
  for (const auto& [figure, value] : figures) print_figure(figure, value * unit, name);
  return 0;
}

int sensor_nest(const MeasureOptions& o, bool json) {
  const auto machine = machine_of(o);
  const auto index = o.axis.size() == 1 ? std::string_view("ABCUVW").find(o.axis[0]) : std::string_view::npos;
  if (index == std::string_view::npos || !machine.report->model().turns(index))
    throw std::runtime_error("--axis " + o.axis + ": the machine has no rotary axis of this name");
  const auto& travel = machine.outline.axes[3 + index];
  const bool given = o.from != o.to;
  const double from = given ? o.from : std::max(travel.low, -180.0),
               to = given ? o.to : std::min(travel.high, 180.0);
  const auto readings =
      truth::measure_nest(*machine.report, 3 + index, from, to, o.points > 0 ? o.points : 13,
                          coordinates("--at", o.at), identification::instrument(machine, "rtest"));
  bus::Json out = bus::Json::array();
  for (const auto& r : readings) {
    if (json) {
      out.push_back({{"angle_deg", r.angle},
                     {"sensors_um", {r.sensors[0] * um, r.sensors[1] * um, r.sensors[2] * um}},
                     {"deviation_um", vector_json(r.deviation, um)}});
      continue;
    }
    std::cout << fmt::format("{:>10.3f} {:>9.3f} {:>9.3f} {:>9.3f}   {:>9.3f} {:>9.3f} {:>9.3f}\n", r.angle,
                             r.sensors[0] * um, r.sensors[1] * um, r.sensors[2] * um, r.deviation[0] * um,
                             r.deviation[1] * um, r.deviation[2] * um);
  }
  if (json)
    std::cout << bus::text_of({{"machine", machine.name}, {"axis", o.axis}, {"readings", out}}) << "\n";
  return 0;
}

CLI::App* add_measurement(CLI::App& app, Common& common, const std::string& name, const std::string& about,
                          const std::shared_ptr<MeasureOptions>& options,
                          int (*run)(const MeasureOptions&, bool)) {
  auto* command =
      add_command(app, common, name, about, [options, &common, run] { return run(*options, common.json); });
  command
      ->add_option("machine", options->machine,
                   "Name under configs/machines, or a directory with machine.yaml")
      ->required();
  command->add_option("--tool-length", options->tool_length, "mm (default 0)")->check(CLI::Range(-1e6, 1e6));
  command->add_option("--channel", options->channel, "Channel (default 0)")->check(CLI::Range(0, 9));
  command->add_option("--set", options->set, "As of `trunnion truth`; may be repeated")->take_all();
  return command;
}

CLI::App* add_sensor_nest(CLI::App& measure, Common& common, const std::string& name,
                          const std::shared_ptr<MeasureOptions>& options) {
  auto* nest = add_measurement(
      measure, common, name,
      "The geometry alone: a rotary axis turns while the control keeps the tip at a place of the workpiece "
      "(RTCP), from stop to stop; in motion: r-test. Angle, "
      "three sensors, deviation x y z",
      options, &sensor_nest);
  nest->add_option("--axis", options->axis, "Rotary axis (default C)");
  nest->add_option("--from", options->from, "deg (default: the travel, at most a turn)");
  nest->add_option("--to", options->to, "deg");
  nest->add_option("--at", options->at, "Place X,Y,Z of the ball in the workpiece frame (default 0,0,0)");
  nest->add_option("--points", options->points, "Angles (default 13)")->check(CLI::Range(2, 10000));
  return nest;
}

}  // namespace

void add_measure_command(CLI::App& app, Common& common) {
  auto* measure =
      app.add_subcommand("measure", "Measure a machine that has a truth.yaml: by its geometry, or in motion");
  measure->require_subcommand(1);
  add_geometry_command(*measure, common);
  add_circle_command(*measure, common);
  add_ball_commands(*measure, common);
  auto options = std::make_shared<MeasureOptions>();
  auto* bar = add_measurement(
      *measure, common, "ballbar",
      "Circular test by ISO 230-4 of the geometry alone: both circles and what they say", options, &ballbar);
  bar->add_option("--plane", options->plane, "XY (default), XZ or YZ")
      ->check(CLI::IsMember({"XY", "XZ", "YZ"}));
  bar->add_option("--radius", options->radius, "mm (default 100)")->check(CLI::Range(1.0, 1e4));
  bar->add_option("--at", options->at, "Centre X,Y,Z of the tip in the workpiece frame (default 0,0,0)");
  bar->add_option("--points", options->points, "Readings of each circle (default 720)")
      ->check(CLI::Range(16, 100000));
  bar->add_option("--plot", options->plot, "Write the polar plot (SVG)");
  auto* beam = add_measurement(*measure, common, "laser",
                               "Position, straightness or angle of an axis by ISO 230-2", options, &laser);
  beam->add_option("--error", options->error, "EXX (default), EYX, EBX ...: which error of which axis");
  beam->add_option("--from", options->from, "First target in machine coordinates, mm (default: the travel)");
  beam->add_option("--to", options->to, "Last target");
  beam->add_option("--at", options->at, "X,Y,Z of the other axes in machine coordinates (default 0,0,0)");
  beam->add_option("--points", options->points, "Targets (default 11)")->check(CLI::Range(2, 10000));
  beam->add_option("--runs", options->runs, "Runs up and down (default 5)")->check(CLI::Range(2, 1000));
  beam->add_option("--plot", options->plot, "Write the deviations (SVG)");
  add_sensor_nest(*measure, common, "sensor-nest", options);
  add_sensor_nest(*measure, common, "rtest", options)->group("");  // its name up to 0.3
}

}  // namespace trunnion::cli
