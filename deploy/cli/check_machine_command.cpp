// SPDX-License-Identifier: Apache-2.0
// check-machine: whether a machine would start
#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>

#include "bus/json.hpp"
#include "commands.hpp"
#include "machine_check/machine_check.hpp"
#include "machine_directory.hpp"

namespace trunnion::cli {
namespace {

using bus::Json;

std::string counted(std::size_t count, const std::string& one, const std::string& several) {
  return std::to_string(count) + " " + (count == 1 ? one : several);
}

Json json_of(const machine_check::MachineReport& report) {
  auto findings = Json::array();
  for (const auto& finding : report.findings)
    findings.push_back(
        {{"file", finding.file}, {"line", finding.line}, {"column", finding.column}, {"text", finding.text}});
  return {{"machine", report.name},      {"findings", findings},        {"axes", report.axes},
          {"spindles", report.spindles}, {"channels", report.channels}, {"files", report.files}};
}

int check_machine(const Common& common, const std::string& machine, const std::string& state) {
  const auto report = machine_check::check_machine(machine_directory(machine), state);
  if (common.json) {
    std::cout << bus::text_of(json_of(report)) << "\n";
  } else {
    for (const auto& finding : report.findings) std::cout << machine_check::to_string(finding) << "\n";
    if (report.findings.empty())
      std::cout << report.name << " is good: " << counted(report.axes, "axis", "axes") << ", "
                << counted(report.spindles, "spindle", "spindles") << " and "
                << counted(report.channels, "channel", "channels") << " in "
                << counted(report.files.size(), "file", "files") << "\n";
  }
  return report.findings.empty() ? 0 : 1;
}

}  // namespace

void add_check_machine_command(CLI::App& app, Common& common) {
  auto machine = std::make_shared<std::string>(), state = std::make_shared<std::string>();
  auto* command = add_command(app, common, "check-machine",
                              "Check the files of a machine as a whole, without a cluster: one line for each "
                              "error, with file and line. Exit status 0 when it may start",
                              [&common, machine, state] { return check_machine(common, *machine, *state); });
  command->add_option("machine", *machine, "Name under configs/machines, or a directory with machine.yaml")
      ->required();
  command->add_option("--state", *state, "Also what users have saved in this state directory");
}

}  // namespace trunnion::cli
