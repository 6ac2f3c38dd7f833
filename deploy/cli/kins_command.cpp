// SPDX-License-Identifier: Apache-2.0
// kins: positions through the kinematics of a machine, without a cluster
#include <CLI/CLI.hpp>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <memory>
#include <sstream>

#include "cluster/cluster_files.hpp"
#include "commands.hpp"
#include "machine/kinematics.hpp"
#include "machine/machine.hpp"
#include "machine/pose_lines.hpp"

namespace trunnion::cli {
namespace {

struct KinsOptions {
  std::string machine, direction;
  double tool_length = 0;
  std::uint16_t channel = 0;
  std::vector<std::string> set;
};

std::string directory_of(const std::string& machine) {
  const std::filesystem::path path(machine);
  if (path.filename() != "machine.yaml") return cluster::find_machine(machine);
  return cluster::find_machine(path.has_parent_path() ? path.parent_path().string() : ".");
}

// The vector of a correction, as its element in machine.yaml has it.
bool apply_correction(machine::Parameters& parameters, std::uint16_t channel, const std::string& name,
                      const std::string& text) {
  for (const auto& element : machine::correction_elements(parameters, channel)) {
    if (element.name != name) continue;
    std::istringstream in(text);
    double v[3];
    char comma[2];
    if (!(in >> v[0] >> comma[0] >> v[1] >> comma[1] >> v[2]) || comma[0] != ',' || comma[1] != ',' ||
        in >> comma[0])
      throw std::runtime_error("--set " + name + ": expected NAME=X,Y,Z");
    for (std::uint32_t i = 0; i < 3; ++i) {
      const double value = element.sign * v[i];
      const auto refused = machine::Catalogue::instance().check(element.number + i, value, "");
      if (!refused.empty()) throw std::runtime_error(refused);
      parameters.values[element.number + i] = {value, ""};
    }
    return true;
  }
  return false;
}

void apply(machine::Parameters& parameters, std::uint16_t channel, const std::string& setting) {
  const auto equals = setting.find('=');
  if (equals == std::string::npos)
    throw std::runtime_error("--set " + setting + ": expected NUMBER=VALUE or NAME=X,Y,Z");
  if (apply_correction(parameters, channel, setting.substr(0, equals), setting.substr(equals + 1))) return;
  std::string number = setting.substr(0, equals);
  if (!number.empty() && number.size() < 6) number.insert(0, 6 - number.size(), '0');
  // As a line of parameters.yaml, so that the same limits hold.
  const auto values =
      machine::read_parameter_text("\"" + number + "\": " + setting.substr(equals + 1), "--set " + setting);
  for (const auto& [key, value] : values) parameters.values[key] = value;
}

int kins(const KinsOptions& options) {
  if (!std::isfinite(options.tool_length)) throw std::runtime_error("--tool-length: not a number");
  machine::Parameters parameters;
  parameters.values = machine::machine_parameters(machine::load_machine(directory_of(options.machine)));
  for (const auto& setting : options.set) apply(parameters, options.channel, setting);
  const machine::PoseLines lines(parameters, options.channel, options.tool_length);
  for (const auto& line : machine::kinematics_warnings(parameters, options.channel))
    std::cerr << "trunnion: warning: " << line << "\n";
  using Direction = machine::PoseLines::Direction;
  const auto direction = options.direction == "inverse"   ? Direction::inverse
                         : options.direction == "forward" ? Direction::forward
                                                          : Direction::orient;
  std::string line;
  for (std::size_t number = 1; std::getline(std::cin, line); ++number) {
    if (line.find_first_not_of(" \t\r") == std::string::npos) continue;
    const auto where = "line " + std::to_string(number) + ": ";
    try {
      const auto answer = lines.answer(direction, line);
      std::cout << answer.text << "\n";
      if (!answer.warning.empty()) std::cerr << "trunnion: " << where << answer.warning << "\n";
    } catch (const std::runtime_error& e) {
      std::cout.flush();
      std::cerr << "trunnion: " << where << e.what() << "\n";
      return 1;
    }
  }
  return 0;
}

}  // namespace

void add_kins_command(CLI::App& app, Common& common) {
  auto options = std::make_shared<KinsOptions>();
  auto* command = add_command(app, common, "kins",
                              "Send positions on standard input through a machine's kinematics, line by line",
                              [options] { return kins(*options); });
  command
      ->add_option("machine", options->machine,
                   "Name under configs/machines, a directory with machine.yaml, or that file")
      ->required();
  command
      ->add_option(
          "direction", options->direction,
          "inverse: x y z r1 r2 -> X Y Z; forward: X Y Z r1 r2 -> x y z i j k; orient: i j k -> r1 r2 "
          "of every solution. r1 r2: rotary axes of the head, then of the table, each from the base "
          "outwards, in degrees")
      ->required()
      ->check(CLI::IsMember({"inverse", "forward", "orient"}));
  command->add_option("--tool-length", options->tool_length, "Tool length in mm (default 0)")
      ->check(CLI::Range(-1e6, 1e6));
  command->add_option("--channel", options->channel, "Channel (default 0)")->check(CLI::Range(0, 9));
  command
      ->add_option(
          "--set", options->set,
          "NUMBER=VALUE instead of the machine's parameter, or NAME=X,Y,Z of a correction of its kinematic "
          "chain; may be repeated")
      ->take_all();
}

}  // namespace trunnion::cli
