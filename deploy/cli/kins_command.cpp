// SPDX-License-Identifier: Apache-2.0
// kins: positions through the kinematics of a machine, without a cluster
#include <CLI/CLI.hpp>
#include <cmath>
#include <iostream>
#include <memory>

#include "commands.hpp"
#include "machine/kinematics.hpp"
#include "machine/machine.hpp"
#include "machine/parameter_setting.hpp"
#include "machine/pose_lines.hpp"
#include "machine_directory.hpp"

namespace trunnion::cli {
namespace {

struct KinsOptions {
  std::string machine, direction;
  double tool_length = 0;
  std::uint16_t channel = 0;
  std::vector<std::string> set;
};

int kins(const KinsOptions& options) {
  if (!std::isfinite(options.tool_length)) throw std::runtime_error("--tool-length: not a number");
  machine::Parameters parameters;
  parameters.values = machine::machine_parameters(machine::load_machine(machine_directory(options.machine)));
  for (const auto& setting : options.set) machine::apply_setting(parameters, options.channel, setting);
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
