// SPDX-License-Identifier: Apache-2.0
#include <CLI/CLI.hpp>
#include <iostream>
#include <string>

#include "bus/json.hpp"
#include "commands.hpp"
#include "trunnion/version.hpp"

int main(int argc, char** argv) {
  using namespace trunnion::cli;
  CLI::App app("trunnion: starts, runs and watches a distributed CNC controller");
  app.set_version_flag("--version", std::string("trunnion ") + trunnion::version);
  app.require_subcommand(1);
  Common common;
  add_cluster_commands(app, common);
  add_down_command(app, common);
  add_run_command(app, common);
  add_operator_commands(app, common);
  add_channel_command(app, common);
  add_parameter_commands(app, common);
  add_compensation_command(app, common);
  add_topic_commands(app, common);
  add_kins_command(app, common);
  add_truth_command(app, common);
  add_variables_command(app, common);
  add_measure_command(app, common);
  add_servo_command(app, common);
  add_gantry_command(app, common);
  add_calibrate_command(app, common);
  add_check_command(app, common);
  add_check_machine_command(app, common);
  add_collision_command(app, common);
  add_plan_command(app, common);
  add_plc_command(app, common);
  add_program_commands(app, common);
  add_recording_commands(app, common);
  add_verify_command(app, common);
  add_test_command(app, common);
  add_replay_command(app, common);
  add_state_commands(app, common);
  add_swap_command(app, common);
  add_upgrade_command(app, common);
  add_user_command(app, common);
  add_certificate_command(app, common);
  add_new_command(app, common);
  add_completion_command(app, common);
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
