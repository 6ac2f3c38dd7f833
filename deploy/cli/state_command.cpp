// SPDX-License-Identifier: Apache-2.0
// state check, state accept, backup, restore
#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <memory>

#include "bus/json.hpp"
#include "cluster/cluster.hpp"
#include "cluster/cluster_locks.hpp"
#include "commands.hpp"
#include "machine_state/backup.hpp"
#include "machine_state/machine_directory.hpp"
#include "machine_state/state_check.hpp"
#include "service/node.hpp"
#include "state_place.hpp"
#include "storage/file.hpp"
#include "trunnion/version.hpp"

namespace trunnion::cli {
namespace fs = std::filesystem;
using bus::Json;
namespace {

const char* text_of(storage::KeptState state) {
  constexpr const char* names[] = {"absent", "good", "previous", "unusable"};
  return names[static_cast<int>(state)];
}

int check_state(const Common& common, const StatePlace& where) {
  const auto place = state_place(common, where);
  const auto reports = machine_state::check_state(place.state);
  bool good = true;
  Json files = Json::array();
  if (!common.json)
    std::printf("%s\n%-28s %-8s %10s %-9s\n", place.state.c_str(), "file", "kind", "generation", "usable");
  for (const auto& report : reports) {
    good = good && report.problem.empty();
    files.push_back({{"file", report.name},
                     {"kind", machine_state::name_of(report.kind)},
                     {"generation", report.generation},
                     {"usable", text_of(report.state)},
                     {"problem", report.problem}});
    if (!common.json)
      std::printf("%-28s %-8s %10llu %-9s %s\n", report.name.c_str(), machine_state::name_of(report.kind),
                  static_cast<unsigned long long>(report.generation), text_of(report.state),
                  report.problem.c_str());
  }
  if (common.json)
    std::cout << bus::text_of(Json{{"state", place.state}, {"good", good}, {"files", files}}) << "\n";
  return good ? 0 : 1;
}

// The files of a cluster that runs are its own.
StatePlace unused_place(const Common& common, const StatePlace& where) {
  if (!where.given())
    throw std::runtime_error("say with --machine or --state which state directory; no cluster may use it");
  return state_place(common, where);
}

int accept(const Common& common, const StatePlace& where, const std::vector<std::string>& files) {
  const auto place = unused_place(common, where);
  const cluster::StateLock lock(place.state, cluster::make_identity(place.machine, 0, false), 0);
  for (const auto& file : files) machine_state::accept(place.state, file);
  if (common.json)
    std::cout << bus::text_of(Json{{"accepted", files}}) << "\n";
  else
    std::printf("%zu files of %s are used as they are now, from the next start on\n", files.size(),
                place.state.c_str());
  return 0;
}

int backup(const Common& common, const StatePlace& where, const std::string& file) {
  const auto place = state_place(common, where);
  const auto& machine = known_machine(place);
  auto state = machine_state::collect(place.state, place.machine, version, service::time_of_day());
  state.configuration = machine_state::machine_files(machine);
  storage::replace_file(fs::absolute(file).string(), machine_state::write_backup(state));
  if (common.json)
    std::cout << bus::text_of(Json{{"backup", file},
                                   {"state", place.state},
                                   {"files", state.files.size()},
                                   {"machine", machine},
                                   {"machine_files", state.configuration.size()}})
              << "\n";
  else
    std::printf("%s: %zu files of %s, %zu of %s\n", file.c_str(), state.files.size(), place.state.c_str(),
                state.configuration.size(), machine.c_str());
  return 0;
}

struct Restore {
  StatePlace where;
  std::string file, configuration;
};

// Of the machine's directory, with those of the backup; nothing when the machine is not on this computer.
std::optional<std::vector<std::string>> differing_here(const machine_state::Backup& backup,
                                                       const StatePlace& place) {
  if (place.directory.empty() || backup.configuration.empty()) return std::nullopt;
  return machine_state::differing_files(backup.configuration, machine_state::machine_files(place.directory));
}

void tell_of_configuration(const machine_state::Backup& backup, const StatePlace& place,
                           const std::optional<std::vector<std::string>>& differing) {
  if (backup.configuration.empty()) {
    std::printf("The backup is of version %s and has no files of the machine's directory\n",
                backup.version.c_str());
  } else if (!differing) {
    std::printf("The machine %s is not here: 'trunnion restore --configuration DIR' makes its directory\n",
                backup.machine.c_str());
  } else if (!differing->empty()) {
    std::printf(
        "%s is not as in the backup, and was not changed ('trunnion restore --configuration DIR' makes "
        "a new directory):\n",
        place.directory.c_str());
    for (const auto& name : *differing) std::printf("  %s\n", name.c_str());
  }
}

int restore(const Common& common, Restore options) {
  std::ifstream in(options.file, std::ios::binary);
  if (!in) throw std::runtime_error(options.file + ": cannot be opened");
  const std::string bytes(std::istreambuf_iterator<char>(in), {});
  const auto backup = machine_state::read_backup(bytes);
  if (!options.where.given()) options.where.state = cluster::default_state_directory(backup.machine);
  auto place = unused_place(common, options.where);
  std::optional<cluster::StateLock> lock;
  if (fs::exists(place.state))
    lock.emplace(place.state, cluster::make_identity(backup.machine, 0, false), 0);
  else
    fs::create_directories(fs::path(place.state).parent_path());
  if (!options.configuration.empty()) {
    if (backup.configuration.empty())
      throw std::runtime_error(options.file + " is of version " + backup.version +
                               " and has no files of the machine's directory: copy them from the old "
                               "computer, and restore without --configuration");
    machine_state::make_machine(backup.configuration, options.configuration);
    place.directory = fs::absolute(options.configuration).lexically_normal().string();
  }
  std::optional<std::vector<std::string>> differing;
  std::string old;
  try {
    differing = differing_here(backup, place);  // may fail, and then nothing is exchanged
    old = machine_state::restore(backup, place.state);
  } catch (const std::exception&) {
    std::error_code ignored;
    if (!options.configuration.empty()) fs::remove_all(place.directory, ignored);
    throw;
  }
  if (common.json) {
    std::cout << bus::text_of(Json{{"state", place.state},
                                   {"before", old},
                                   {"files", backup.files.size()},
                                   {"machine", backup.machine},
                                   {"machine_directory", place.directory},
                                   {"machine_differs", differing.value_or(std::vector<std::string>{})},
                                   {"version", backup.version},
                                   {"time", backup.time}})
              << "\n";
    return 0;
  }
  std::printf("%s has the state of %s of %s (version %s)%s\n", place.state.c_str(), backup.machine.c_str(),
              backup.time.c_str(), backup.version.c_str(),
              old.empty() ? "" : ("; what was there is in " + old).c_str());
  if (!options.configuration.empty())
    std::printf("%s has the machine: 'trunnion up %s'\n", place.directory.c_str(), place.directory.c_str());
  else
    tell_of_configuration(backup, place, differing);
  return 0;
}

}  // namespace

void add_state_commands(CLI::App& app, Common& common) {
  auto place = std::make_shared<StatePlace>();
  auto file = std::make_shared<std::string>();
  auto files = std::make_shared<std::vector<std::string>>();
  auto* state = app.add_subcommand("state", "The files that survive a stop of the cluster");
  state->require_subcommand(1);
  auto* command =
      add_command(*state, common, "check",
                  "List every kept file, its generation and what of it can be used. Exit status 0 "
                  "when nothing is damaged",
                  [&common, place] { return check_state(common, *place); });
  add_place_options(*command, *place);
  command =
      add_command(*state, common, "accept",
                  "Use files that were edited by hand as they are, from the next start on; not while the "
                  "cluster runs",
                  [&common, place, files] { return accept(common, *place, *files); });
  add_place_options(*command, *place);
  command->add_option("file", *files, "Below the state directory, for example tools.yaml or programs/part.nc")
      ->required();
  command = add_command(app, common, "backup",
                        "Write the whole state of a machine and its directory into one file (tar), without "
                        "recordings, keys and certificates",
                        [&common, place, file] { return backup(common, *place, *file); });
  add_place_options(*command, *place);
  command->add_option("file", *file, "The file")->required();
  auto options = std::make_shared<Restore>();
  command =
      add_command(app, common, "restore",
                  "Put a backup in the place of the state directory, after it was checked; not while the "
                  "cluster runs. What was there is kept beside it",
                  [&common, options] { return restore(common, *options); });
  add_place_options(*command, options->where);
  command->add_option(
      "--configuration", options->configuration,
      "New directory for the machine itself (machine.yaml, parameters, tools, PLC, programs), as "
      "on a new computer");
  command->add_option("file", options->file, "The backup")->required();
}

}  // namespace trunnion::cli
