// SPDX-License-Identifier: Apache-2.0
// calibrate: the vectors of the kinematics; writing and undoing them
#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>
#include <sstream>

#include "bus/json.hpp"
#include "calibration/chain_change.hpp"
#include "calibration/last_calibration.hpp"
#include "calibration_result.hpp"
#include "cluster/client.hpp"
#include "cluster/cluster.hpp"
#include "figures.hpp"
#include "machine/chain_parameters.hpp"
#include "machine/kinematics.hpp"
#include "machine/yaml.hpp"
#include "parameter_request.hpp"
#include "storage/file.hpp"

namespace trunnion::cli {
namespace {

int undo(const Common& common) {
  const auto running = cluster::find_cluster(common.domain);
  const auto last =
      calibration::last_calibration(machine::read_text(running.state_directory + "/journal.jsonl"));
  std::map<std::uint32_t, machine::ParameterValue> values;
  for (const auto& [number, value] : last.before) values[number] = {value, ""};
  if (!common.json)
    print("the calibration of {} by {}: {} parameters get the values of before", last.time, last.who,
          values.size());
  return import_parameters(common, values, calibration::undone_by);
}

}  // namespace

truth::Vec3 vector_option(const std::string& option, const std::string& text) {
  std::istringstream in(text);
  truth::Vec3 v;
  char comma[2], more = 0;
  if (!(in >> v[0] >> comma[0] >> v[1] >> comma[1] >> v[2]) || comma[0] != ',' || comma[1] != ',' ||
      in >> more || !v.allFinite() || !(v.cwiseAbs().maxCoeff() <= 1e5))
    throw std::runtime_error(option + " " + text + ": expected X,Y,Z in mm, each within -100000 .. 100000");
  return v;
}

void add_target_options(CLI::App& command, CalibrationTarget& target) {
  command
      .add_option("machine", target.machine, "Name under configs/machines, or a directory with machine.yaml")
      ->required();
  command.add_option("--channel", target.channel, "Channel (default 0)")->check(CLI::Range(0, 9));
  command.add_option("--set", target.set, "As of `trunnion truth`; may be repeated")->take_all();
  command.add_option("--output", target.output, "Write the changed parameters into a file");
  command.add_flag(
      "--write", target.write,
      "Set the changed parameters in the cluster that runs, all or none; active after a reset. Its "
      "journal names the calibration and keeps the values of before: `trunnion calibrate undo`");
}

TrueMachine load_calibrated_machine(const CalibrationTarget& target, const Common& common) {
  auto machine = load_true_machine(target.machine, target.channel, target.set);
  if (!target.write && !target.running) return machine;
  const auto running = cluster::find_cluster(common.domain);
  if (running.machine != machine.name)
    throw std::runtime_error("the cluster that runs is " + running.machine + ", to be calibrated is " +
                             machine.name);
  cluster::Client client(running.run.domain);
  const auto set = client.newest(topics::parameter_set);
  for (const auto& pending : set.pending)
    if (machine::is_chain_parameter(pending.number))
      throw std::runtime_error("parameter " + machine::number_text(pending.number) +
                               " of the kinematics waits for a reset; reset the channel first");
  const auto compensation = machine.report->compensation;
  identification::take_model(machine, machine::parameters_of(set), target.channel);
  machine.report->compensation = compensation;
  return machine;
}

calibration::MeasuredMachine measured_machine(const TrueMachine& machine, std::uint16_t channel) {
  return {machine.name, machine::chain_parameters(machine.model, channel), machine.outline,
          calibration::probe_and_sphere(machine.truth.probe, machine.truth.solids)};
}

int write_change(const CalibrationTarget& target, const Common& common,
                 const calibration::ChainParameters& before, const calibration::ChainParameters& after,
                 const ChangeWriter& writer) {
  const auto values = calibration::changed_parameters(before, after, target.channel);
  if (!common.json)
    for (const auto& [number, value] : values)
      print("{} {} = {:.9g}", machine::number_text(number), machine::Catalogue::instance().find(number)->name,
            value.value);
  if (!target.output.empty()) {
    storage::replace_file(target.output, machine::write_parameter_text(values));
    if (!common.json) print("{}: {} parameters", target.output, values.size());
  }
  std::fflush(stdout);
  if (target.write && !values.empty()) {
    if (writer) {
      writer(values);
      if (!common.json) print("written; active after a reset of the channel");
      return 0;
    }
    return import_parameters(common, values, calibration::calibrated_by, common.json);
  }
  if (!common.json && target.output.empty())
    print("{}",
          target.running
              ? "nothing written: `trunnion calibrate confirm` writes the result, `discard` gives it up"
              : "nothing written: --write changes the cluster that runs, --output FILE writes parameters");
  return 0;
}

void add_calibrate_command(CLI::App& app, Common& common) {
  auto* calibrate = app.add_subcommand("calibrate", "Calibrate the kinematics of a five-axis machine");
  calibrate->require_subcommand(1);
  add_calibrate_kinematics(*calibrate, common);
  add_calibrate_manual(*calibrate, common);
  add_calibrate_measurement(*calibrate, common);
  add_command(
      *calibrate, common, "undo",
      "Give the parameters that the last calibration has written into the cluster that runs the values of "
      "before; refused when one of them was changed since. Active after a reset",
      [&common] { return undo(common); });
}

}  // namespace trunnion::cli
