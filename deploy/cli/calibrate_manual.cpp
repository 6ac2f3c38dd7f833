// SPDX-License-Identifier: Apache-2.0
// calibrate manual: dial, edge finder and the RTCP check at nine poses
#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>

#include "bus/json.hpp"
#include "calibration/measurement_poses.hpp"
#include "calibration/virtual_dial.hpp"
#include "calibration_result.hpp"
#include "figures.hpp"
#include "machine/yaml.hpp"

namespace trunnion::cli {
namespace {

using calibration::ManualCheck;
using calibration::ManualKind;
using calibration::Vec3;

struct ManualOptions {
  CalibrationTarget target;
  std::string readings, displacements, place = "0,0,0";
  double alpha = 30, ball_length = 120, noise = 0, resolution = 0;
  std::uint64_t seed = 1;
  bool by_virtual = false;
};

void print_guide(ManualKind kind) {
  const auto& guide = calibration::guide_of(kind);
  print("{}: {}", calibration::to_string(kind), guide.title);
  std::cout << "Before:\n";
  for (const auto& check : guide.checks) std::cout << "  - " << check << "\n";
  std::cout << "Steps (readings in mm, in a file for --readings):\n";
  std::size_t number = 0;
  for (const auto& step : guide.steps) {
    std::cout << "  " << ++number << ". [" << step.at << "; " << step.use << "] " << step.action << "\n";
    for (const auto& [name, about] : step.readings) std::cout << "       " << name << ": " << about << "\n";
  }
  for (const auto& [name, about] : guide.values) std::cout << "  " << name << ": " << about << "\n";
}

void print_check(const ManualCheck& check, const std::vector<calibration::Angles>& poses, const char* when) {
  print("RTCP check at nine poses, {}: displacement of the ball in the workpiece frame, um", when);
  for (std::size_t i = 0; i < poses.size(); ++i)
    print("  {:<14} {:>10.1f} {:>10.1f} {:>10.1f}", calibration::pose_name(poses[i], check.model),
          um * check.displacements[i].x(), um * check.displacements[i].y(), um * check.displacements[i].z());
  for (const auto& line : check.acceptance.lines)
    print("  {:<36} {:>8.1f} um, limit {:.0f} um{}", line.name, um * line.value, um * line.limit,
          line.value <= line.limit ? "" : "  EXCEEDED");
}

bus::Json json_of(const ManualCheck& check) {
  bus::Json out = {{"accepted", check.acceptance.accepted()}};
  for (const auto& d : check.displacements) out["displacements_mm"].push_back({d.x(), d.y(), d.z()});
  for (const auto& line : check.acceptance.lines)
    out["acceptance"].push_back({{"name", line.name}, {"value_mm", line.value}, {"limit_mm", line.limit}});
  return out;
}

bus::Json json_of(const calibration::ChainParameters& chain) {
  bus::Json out = bus::Json::array();
  for (const auto slot : metrology::all_slots)
    if (const auto& axis = axis_at(chain, slot)) {
      const Vec3 v = axis->offset + axis->correction;
      out.push_back({{"axis", std::string(1, "ABCUVW"[axis->angle])}, {"offset_mm", {v.x(), v.y(), v.z()}}});
    }
  return out;
}

int manual(const ManualOptions& o, const Common& common) {
  const auto machine = load_calibrated_machine(o.target, common);
  const auto measured = measured_machine(machine, o.target.channel);
  const auto kind = calibration::manual_kind(measured.model);
  if (!kind)
    throw std::runtime_error(measured.name + ": " + calibration::manual_machines +
                             "; use `trunnion calibrate kinematics`");
  const int sources =
      (o.by_virtual ? 1 : 0) + (o.readings.empty() ? 0 : 1) + (o.displacements.empty() ? 0 : 1);
  if (sources > 1) throw std::runtime_error("give one of --virtual, --readings and --displacements");
  if (sources == 0) {
    print_guide(*kind);
    return 0;
  }
  const Vec3 place = vector_option("--place", o.place);
  const auto poses = calibration::check_poses(*kind, o.alpha);
  auto model = measured.model;
  bus::Json out = {
      {"machine", measured.name}, {"kind", calibration::to_string(*kind)}, {"before", json_of(model)}};
  calibration::Readings readings;
  bool accepted = true;
  if (o.by_virtual) {
    calibration::ManualGauges gauges;
    gauges.instrument = {o.noise / um, o.resolution / um, o.seed};
    const auto& travel = machine.outline.axes[3];
    if (*kind == ManualKind::ac_table && travel.present)
      gauges.alpha = std::min({90.0, travel.high, -travel.low});
    readings = calibration::read_virtually(*kind, *machine.report, model, gauges);
  } else if (!o.readings.empty()) {
    readings = calibration::parse_readings(machine::read_text(o.readings), o.readings, *kind);
  }
  if (!readings.empty()) {
    model = calibration::chain_of_readings(*kind, readings, model);
    out["readings"] = readings;
    out["formulas"] = json_of(model);
    if (!common.json)
      for (const auto& [name, value] : readings) print("reading {:<16} {:>14.4f}", name, value);
  }
  if (!o.displacements.empty()) {
    const auto displaced =
        calibration::parse_displacements(machine::read_text(o.displacements), o.displacements);
    const ManualCheck check{model, displaced, calibration::acceptance_of(*kind, displaced)};
    if (!common.json) print_check(check, poses, "as given");
    out["checks"].push_back(json_of(check));
    if (check.acceptance.accepted() && !common.json) print("accepted; no correction");
    if (!check.acceptance.accepted()) model = calibration::corrected(*kind, displaced, o.alpha, model);
  }
  if (o.by_virtual) {
    const auto checks = calibration::check_and_correct(
        *kind, *machine.report, model,
        {place, o.ball_length, o.alpha, {o.noise / um, o.resolution / um, o.seed + 1}});
    for (std::size_t i = 0; i < checks.size(); ++i) {
      if (!common.json) print_check(checks[i], poses, i == 0 ? "after the formulas" : "after a correction");
      out["checks"].push_back(json_of(checks[i]));
    }
    accepted = checks.back().acceptance.accepted();
    model = checks.back().model;
  }
  out["after"] = json_of(model);
  std::fflush(stdout);
  if (common.json) std::cout << bus::text_of(out) << "\n";
  if (!accepted)
    throw std::runtime_error("the check exceeds its limits after " +
                             std::to_string(calibration::most_corrections) + " corrections; nothing written");
  return write_change(o.target, common, measured.model, model);
}

}  // namespace

void add_calibrate_manual(CLI::App& calibrate, Common& common) {
  auto options = std::make_shared<ManualOptions>();
  auto& o = *options;
  auto* command =
      add_command(calibrate, common, "manual",
                  "Guided calibration with dial and edge finder of an AC table, a BC or AC head, or a B head "
                  "over a C table. "
                  "Without readings: the checks before, the steps and the names of their readings",
                  [options, &common] { return manual(*options, common); });
  add_target_options(*command, o.target);
  command->add_option("--readings", o.readings,
                      "YAML: `name: value` of every reading, mm; gives the vectors");
  command->add_option(
      "--displacements", o.displacements,
      "Nine lines `x y z`, mm: displacement of the ball at C0, C90, C180, C270, then A 0, +alpha, "
      "-alpha, -90, 0 of a table, or 0, 45, 90, -45, -90 of a head; gives the corrections");
  command->add_flag(
      "--virtual", o.by_virtual,
      "Read virtual instruments on the machine of truth.yaml, check and correct until accepted");
  command->add_option("--place", o.place,
                      "Of the ball in the check, X,Y,Z in the workpiece frame, mm (default 0,0,0)");
  command->add_option("--ball-length", o.ball_length, "Spindle face to the ball's centre, mm (default 120)")
      ->check(CLI::Range(0.0, 1e4));
  command->add_option("--alpha", o.alpha, "Angle of the table's check, deg (default 30)")
      ->check(CLI::Range(5.0, 90.0));
  command->add_option("--noise", o.noise, "Standard deviation of a virtual reading, um (default 0)")
      ->check(CLI::Range(0.0, 1000.0));
  command->add_option("--resolution", o.resolution, "Of a virtual reading, um (default 0)")
      ->check(CLI::Range(0.0, 1000.0));
  command->add_option("--seed", o.seed, "Of the noise (default 1)");
}

}  // namespace trunnion::cli
