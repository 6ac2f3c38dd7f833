// SPDX-License-Identifier: Apache-2.0
#include <CLI/CLI.hpp>
#include <iostream>
#include <string>
#include <utility>
#include <vector>

#include "bus/json.hpp"
#include "commands.hpp"
#include "trunnion/version.hpp"

namespace trunnion::cli {
namespace {

std::vector<CLI::App*> all_commands(CLI::App& app) {
  return app.get_subcommands([](CLI::App*) { return true; });
}

// The help shows groups and commands in this order.
void add_commands(CLI::App& app, Common& common) {
  using Add = void (*)(CLI::App&, Common&);
  const std::vector<std::pair<const char*, std::vector<Add>>> groups = {
      {"Operate",
       {add_cluster_commands, add_channel_command, add_operator_commands, add_variables_command,
        add_state_commands, add_swap_command, add_upgrade_command, add_down_command}},
      {"Program",
       {add_program_commands, add_check_command, add_plan_command, add_collision_command, add_run_command}},
      {"Commission",
       {add_check_machine_command, add_parameter_commands, add_plc_command, add_kins_command,
        add_truth_command, add_measure_command, add_compensation_command, add_servo_command,
        add_gantry_command, add_calibrate_command, add_user_command, add_certificate_command}},
      {"Record and verify",
       {add_record_command, add_recording_commands, add_replay_command, add_verify_command,
        add_test_command}},
      {"Develop", {add_new_command, add_topic_commands, add_bench_command, add_completion_command}},
  };
  for (const auto& [name, commands] : groups) {
    const auto before = all_commands(app).size();
    for (const auto add : commands) add(app, common);
    const auto now = all_commands(app);
    for (auto i = before; i < now.size(); ++i) now[i]->group(name);
  }
}

}  // namespace
}  // namespace trunnion::cli

int main(int argc, char** argv) {
  using namespace trunnion::cli;
  CLI::App app("trunnion: starts, runs and watches a distributed CNC controller");
  app.set_version_flag("--version", std::string("trunnion ") + trunnion::version);
  app.require_subcommand(1);
  Common common;
  add_commands(app, common);
  try {
    app.parse(argc, argv);
    return common.action();
  } catch (const CLI::ParseError& e) {
    return app.exit(e);
  } catch (const std::exception& e) {
    if (common.json)
      std::cout << trunnion::bus::text_of({{"error", e.what()}}) << "\n";
    else
      std::cerr << "trunnion: " << e.what() << "\n";
    return 1;
  }
}
