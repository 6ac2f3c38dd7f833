// SPDX-License-Identifier: Apache-2.0
// servo: tests of the drives of a running cluster, their tuning
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>

#include "commands.hpp"
#include "figures.hpp"
#include "interrupt_watch.hpp"
#include "machine_tests/servo_tests.hpp"
#include "report/servo_pictures.hpp"
#include "servo_analysis/tuning_task.hpp"
#include "storage/file.hpp"

namespace trunnion::cli {
namespace {

using machine_tests::ServoSession;
using machine_tests::TestOptions;
using machine_tests::TestReport;
using servo_analysis::TestedAxis;
using servo_analysis::TestFigure;

struct ServoOptions : TestOptions {
  std::string machine, plot;
  std::uint16_t channel = 0;
  double amplitude_um = 20;
  bool write = false;
};

std::string limits(const TestFigure& f) {
  if (f.least && f.most) return fmt::format("limits {:g} .. {:g}", *f.least, *f.most);
  if (f.most) return fmt::format("limit {:g}", *f.most);
  if (f.least) return fmt::format("at least {:g}", *f.least);
  return {};
}

bus::Json json_of(const TestFigure& f) {
  bus::Json j = {{"name", f.name}, {"value", f.value}, {"unit", f.unit}};
  if (f.least) j["least"] = *f.least;
  if (f.most) j["most"] = *f.most;
  if (f.least || f.most) j["reached"] = f.reached();
  return j;
}

bus::Json json_of(const std::vector<servo_analysis::ServoSettings::Value>& values) {
  bus::Json all = bus::Json::array();
  for (const auto& v : values)
    all.push_back({{"parameter", machine::number_text(v.number)}, {"value", v.value}});
  return all;
}

// Values that differ from those of the machine.
std::vector<servo_analysis::ServoSettings::Value> changes(
    const ServoSession& session, std::vector<servo_analysis::ServoSettings::Value> values) {
  std::erase_if(values, [&](const auto& v) { return session.parameters().at(v.number) == v.value; });
  return values;
}

void propose_settings(const ServoSession& session,
                      const std::vector<servo_analysis::ServoSettings::Value>& values) {
  for (const auto& v : values)
    print("{} {:<26} {:>10.5g} -> {:>10.5g}", machine::number_text(v.number),
          machine::Catalogue::instance().find(v.number)->name, session.parameters().at(v.number), v.value);
}

int run_test(const ServoOptions& o, const Common& common,
             TestReport (*test)(ServoSession&, const TestOptions&)) {
  const InterruptWatch watch(true);
  ServoSession session(o.machine, common.domain, o.channel, &InterruptWatch::requested);
  const auto found = test(session, o);
  if (!o.plot.empty()) storage::replace_file(o.plot, report::picture_of(found.picture));
  if (o.write && !found.proposal.empty()) session.write(found.proposal, "servo " + found.test);
  if (common.json) {
    bus::Json out = {{"machine", session.machine()}, {"test", found.test}, {"reached", found.reached()}};
    if (!o.axes.empty()) out["axes"] = o.axes;
    for (const auto& f : found.figures) out["figures"].push_back(json_of(f));
    out["notes"] = found.notes;
    out["proposal"] = json_of(found.proposal);
    if (!found.details.is_null()) out["details"] = found.details;
    std::cout << bus::text_of(out) << "\n";
    return found.reached() ? 0 : 1;
  }
  for (const auto& f : found.figures)
    print("{:<36} {:>12.4f} {:<20} {:<20} {}", f.name, f.value, f.unit, limits(f),
          f.least || f.most ? f.reached() ? "pass" : "FAIL" : "");
  for (const auto& note : found.notes) std::cout << note << "\n";
  propose_settings(session, found.proposal);
  if (!found.proposal.empty())
    print("{}", o.write ? "written; a change of encoders acts after a restart"
                        : "nothing written: --write sets the parameters");
  if (!o.plot.empty()) print("{}", o.plot);
  return found.reached() ? 0 : 1;
}

void say_tuned(const TestedAxis& axis, const servo_analysis::TuningResult& result, double amplitude_um) {
  print("{}  {}; largest vibration {:.2f} um of {:g} um", axis.letter,
        result.reached() ? "every limit is reached" : "NOT every limit is reached",
        result.largest_vibration * 1e3, amplitude_um);
  if (result.settings.position_gain < servo_analysis::least_position_gain)
    print("{}  position gain {:.4g} 1/s, the limit of servo test position is {:.1f} 1/s: stiffen the axis",
          axis.letter, result.settings.position_gain, servo_analysis::least_position_gain);
}

int tune(const ServoOptions& o, const Common& common) {
  const InterruptWatch watch(true);
  ServoSession session(o.machine, common.domain, o.channel, &InterruptWatch::requested);
  std::vector<const TestedAxis*> axes;
  for (const auto& letter : o.axes)
    if (letter == "all")
      for (const auto& a : session.axes()) axes.push_back(&a);
    else
      axes.push_back(&session.axis(letter));
  std::vector<servo_analysis::ServoSettings::Value> values;
  bus::Json out = {{"machine", session.machine()}, {"amplitude_um", o.amplitude_um}};
  bool reached = true;
  for (const auto* a : axes) {
    const auto* partner = servo_analysis::partner_of(session.axes(), *a);
    auto task = servo_analysis::tuning_task(session.parameters(), *a, partner, o.amplitude_um / 1000);
    if (!task.circles) partner = nullptr;
    if (!common.json) task.progress = [&](const std::string& line) { print("{}  {}", a->letter, line); };
    machine_tests::SessionAxisUnderTest axis(session, *a, partner);
    const auto result = servo_analysis::tune_axis(axis, task);
    const auto changed = changes(session, result.settings.values(a->number));
    values.insert(values.end(), changed.begin(), changed.end());
    reached = reached && result.reached();
    bus::Json entry = {{"axis", std::string(1, a->letter)},
                       {"reached", result.reached()},
                       {"critical_speed_gain", result.critical_speed_gain},
                       {"critical_position_gain", result.critical_position_gain},
                       {"inertia", result.inertia},
                       {"coulomb", result.coulomb},
                       {"largest_vibration_um", result.largest_vibration * 1e3},
                       {"motions", result.motions}};
    for (const auto& f : result.figures)
      entry["figures"].push_back({{"name", f.name},
                                  {"value", f.value},
                                  {"limit", f.limit},
                                  {"unit", f.unit},
                                  {"reached", f.reached()}});
    out["axes"].push_back(entry);
    if (!common.json) say_tuned(*a, result, o.amplitude_um);
  }
  out["proposal"] = json_of(values);
  out["reached"] = reached;
  // What does not reach the limits is shown and not written.
  const bool write = o.write && reached && !values.empty();
  if (write) session.write(values, "servo tune");
  out["written"] = write;
  if (common.json) {
    std::cout << bus::text_of(out) << "\n";
  } else {
    propose_settings(session, values);
    print("{}", write                 ? "written in one activation"
                : o.write && !reached ? "nothing written: a limit is not reached"
                                      : "nothing written: --write sets the parameters");
  }
  return reached ? 0 : 1;
}

void add_machine(CLI::App* command, ServoOptions& o) {
  command->add_option("machine", o.machine,
                      "Name under configs/machines or a directory: a cluster of its own in virtual "
                      "time; without it the cluster that runs");
  command->add_option("--channel", o.channel, "Channel (default 0)")->check(CLI::Range(0, 9));
}

void add_common(CLI::App* command, ServoOptions& o) {
  add_machine(command, o);
  command->add_option("--axis", o.axes, "Letter of the axis; may be repeated, `all` for tune")
      ->required()
      ->allow_extra_args(false);
}

void add_plot(CLI::App* command, ServoOptions& o) {
  command->add_option("--plot", o.plot, "Write the picture (SVG)");
}

void add_spindle_sync(CLI::App& tests, Common& common) {
  auto o = std::make_shared<ServoOptions>();
  auto* command = add_command(
      tests, common, "spindle-sync",
      "A spindle follows another one: error of the angle at constant speeds and while the speed changes",
      [o, &common] { return run_test(*o, common, &machine_tests::test_spindle_sync); });
  add_machine(command, *o);
  auto& test = o->spindle_sync;
  command
      ->add_option("--speed", test.speeds,
                   "Of the master, 1/min; may be repeated, in the order of the changes (default 1000, then "
                   "2000, or what the gears in force have instead)")
      ->allow_extra_args(false)
      ->check(CLI::Range(1.0, 5e5));
  command->add_option("--on", test.on,
                      "Block that couples the slave, by the PLC of the machine (default M80)");
  command->add_option("--off", test.off, "Block that ends it (default M84)");
  command->add_option("--start", test.start, "Block that starts the master (default M3)");
  command->add_option("--stop", test.stop, "Block that stops it (default M5)");
  command->add_option("--settling", test.settling, "s of machine time before the recording (default 2)")
      ->check(CLI::Range(0.1, 60.0));
  command->add_option("--record", test.record, "s of machine time that are recorded (default 5)")
      ->check(CLI::Range(0.5, 100.0));
  add_plot(command, *o);
}

}  // namespace

void add_servo_command(CLI::App& app, Common& common) {
  auto* servo = app.add_subcommand("servo", "Test and tune the drives of a running cluster");
  servo->require_subcommand(1);
  auto* tests =
      servo->add_subcommand("test", "Servo tests with the limits of the manual; 1 when one is not reached");
  tests->require_subcommand(1);
  struct Row {
    const char *name, *about;
    TestReport (*run)(ServoSession&, const TestOptions&);
  };
  static constexpr Row rows[] = {
      {"position", "Following error to and fro at 1000 mm/min, and Kv without feed-forward",
       &machine_tests::test_position},
      {"speed", "Ripple of the speed and peaks of the acceleration at 3000 mm/min",
       &machine_tests::test_speed},
      {"current", "Time constant of the current loop by a step of the torque at rest",
       &machine_tests::test_current},
      {"overshoot",
       "Overshoot of the speed at the end of an acceleration at 100, 200, 500, 1000 and 3000 mm/min",
       &machine_tests::test_overshoot},
      {"roundness",
       "Circle of two axes: roundness, quadrant jumps, servo mismatch with and without feed-forward",
       &machine_tests::test_roundness},
      {"rtcp",
       "A rotary axis turns under RTCP: mismatch of linear and rotary axes with and without feed-forward",
       &machine_tests::test_rtcp},
      {"frequency", "Frequency response of speed or position loop by a chirp, margins",
       &machine_tests::test_frequency},
      {"friction", "Coulomb, viscous and Stribeck friction, weight, inertia", &machine_tests::test_friction}};
  const auto add = [&](CLI::App& parent, const Row& row) {
    auto o = std::make_shared<ServoOptions>();
    auto* command = add_command(parent, common, row.name, row.about,
                                [o, &common, run = row.run] { return run_test(*o, common, run); });
    add_common(command, *o);
    command->add_option("--feed", o->feed, "mm/min or deg/min (default: that of the manual)")
        ->check(CLI::Range(0.1, 1e6));
    add_plot(command, *o);
    const std::string name = row.name;
    if (name == "roundness")
      command->add_option("--radius", o->radius, "mm (default 100)")->check(CLI::Range(1.0, 1e4));
    if (name == "frequency") {
      command->add_option("--loop", o->loop, "speed (default) or position")
          ->check(CLI::IsMember({"speed", "position"}));
      command->add_option("--from", o->from, "Hz (default 1)")->check(CLI::Range(1.0, 3000.0));
      command->add_option("--to", o->to, "Hz (default 300)")->check(CLI::Range(2.0, 3500.0));
      command
          ->add_option("--amplitude", o->amplitude,
                       "Of the chirp, mm/min or deg/min (default 30 % of the feed)")
          ->check(CLI::Range(0.1, 1e5));
    }
    if (name == "current")
      command->add_option("--amplitude", o->amplitude, "Of the step, share of the rated torque (default 0.1)")
          ->check(CLI::Range(0.01, 0.5));
    if (name == "rtcp") {
      command->add_option("--tool", o->tool, "H (default 1)")->check(CLI::Range(1, 999));
      command->add_option("--start", o->start, "deg (default 0)");
      command->add_option("--end", o->end, "deg (default 360)");
    }
    return std::pair{command, o};
  };
  for (const auto& row : rows) add(*tests, row);
  add_spindle_sync(*tests, common);
  const auto [encoders, encoder_options] = add(
      *servo, {"encoders",
               "Compare motor and load encoder over one revolution, before the loop is closed over the load",
               &machine_tests::test_encoders});
  encoders->add_flag("--write", encoder_options->write, "Set sign and pulses of the load encoder");
  auto o = std::make_shared<ServoOptions>();
  auto* command = add_command(
      *servo, common, "tune",
      "Find the critical gains, keep 80 %, feed-forward and friction compensation; a proposal, or with "
      "--write the parameters of the machine",
      [o, &common] { return tune(*o, common); });
  add_common(command, *o);
  command
      ->add_option("--amplitude", o->amplitude_um,
                   "No vibration may be larger, um (default 20; of a rotary axis mdeg)")
      ->check(CLI::Range(1.0, 1000.0));
  command->add_flag("--write", o->write,
                    "Write the parameters in one activation when every limit is reached");
}

}  // namespace trunnion::cli
