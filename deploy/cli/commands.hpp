// SPDX-License-Identifier: Apache-2.0
// The sub-commands of `trunnion`; each file adds its own.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

namespace CLI {
class App;
}
namespace trunnion::tool_tables {
struct MachineTables;
}

namespace trunnion::cli {

/// Options every sub-command has.
struct Common {
  bool json = false;
  std::optional<std::uint32_t> domain;
  std::function<int()> action;  ///< of the sub-command that was parsed
};

// Operate
void add_cluster_commands(CLI::App& app, Common& common);   // up, status
void add_channel_command(CLI::App& app, Common& common);    // channel, its status
void add_operator_commands(CLI::App& app, Common& common);  // mdi, alarms, estop
void add_variables_command(CLI::App& app, Common& common);  // variables
void add_state_commands(CLI::App& app, Common& common);     // state, backup, restore
void add_swap_command(CLI::App& app, Common& common);       // swap
void add_upgrade_command(CLI::App& app, Common& common);    // upgrade
void add_down_command(CLI::App& app, Common& common);       // down

// Program
void add_program_commands(CLI::App& app, Common& common);   // program
void add_check_command(CLI::App& app, Common& common);      // check
void add_plan_command(CLI::App& app, Common& common);       // plan
void add_collision_command(CLI::App& app, Common& common);  // collision
void add_run_command(CLI::App& app, Common& common);        // run

// Commission
void add_check_machine_command(CLI::App& app, Common& common);  // check-machine
void add_parameter_commands(CLI::App& app, Common& common);     // param
void add_plc_command(CLI::App& app, Common& common);            // plc
void add_kins_command(CLI::App& app, Common& common);           // kins
void add_truth_command(CLI::App& app, Common& common);          // truth
void add_measure_command(CLI::App& app, Common& common);        // measure ballbar, laser, sensor-nest
void add_compensation_command(CLI::App& app, Common& common);   // compensation
void add_servo_command(CLI::App& app, Common& common);          // servo test, encoders, tune
void add_gantry_command(CLI::App& app, Common& common);         // gantry
void add_calibrate_command(CLI::App& app, Common& common);      // calibrate kinematics, manual, undo
void add_user_command(CLI::App& app, Common& common);           // user
void add_certificate_command(CLI::App& app, Common& common);    // certificate

// Record and verify
void add_record_command(CLI::App& app, Common& common);      // record
void add_recording_commands(CLI::App& app, Common& common);  // info, diff, export
void add_replay_command(CLI::App& app, Common& common);      // replay
void add_verify_command(CLI::App& app, Common& common);      // verify
void add_test_command(CLI::App& app, Common& common);        // test

// Develop
void add_new_command(CLI::App& app, Common& common);         // new service, new machine
void add_topic_commands(CLI::App& app, Common& common);      // topic
void add_bench_command(CLI::App& app, Common& common);       // bench
void add_completion_command(CLI::App& app, Common& common);  // completion

// Of plc
void add_plc_online_commands(CLI::App& plc, Common& common);  // plc variables, watch, force, trace
void add_plc_load_commands(CLI::App& plc, Common& common);    // plc load, programs

/// `trunnion check` of a file for a machine by name or directory with the tables that are `active` on it; 1
/// when the program has an error. `fetch` is called before the first subprogram is looked for: it writes
/// those that are stored beside the file.
int check_file(const std::string& program, const std::string& machine,
               const tool_tables::MachineTables& active, std::function<void()> fetch);

/// The subject "motion" of bench; 1 when a requirement is missed.
int bench_motion(const Common& common, const std::string& machine);

/// Of the option --exec.
inline constexpr const char* exec_help =
    "SERVICE=PATH: start this executable as the service, instead of Trunnion's; may be repeated";

/// --json and --domain.
CLI::App* add_command(CLI::App& app, Common& common, const std::string& name, const std::string& about,
                      std::function<int()> action);

}  // namespace trunnion::cli
