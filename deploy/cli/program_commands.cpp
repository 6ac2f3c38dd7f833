// SPDX-License-Identifier: Apache-2.0
// program: the stored programs of a running cluster
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <memory>

#include "bus/json.hpp"
#include "cluster/client.hpp"
#include "cluster/cluster.hpp"
#include "cluster/stored_program.hpp"
#include "commands.hpp"
#include "machine/parameters.hpp"
#include "machine/yaml.hpp"
#include "parameter_store/machine_tables.hpp"
#include "storage/temporary_directory.hpp"

namespace trunnion::cli {
namespace {

namespace fs = std::filesystem;
using idl::program::Operation;
using idl::program::ProgramEntry;
using idl::program::ProgramList;

struct ProgramOptions {
  std::string name, new_name, file;
  bool replace = false;
};

ProgramEntry stored(const ProgramList& list, const std::string& name) {
  if (const auto found = cluster::find_program(list, name)) return *found;
  throw std::runtime_error("there is no stored program " + name + "; trunnion program list shows them");
}

bus::Json json_of(const ProgramEntry& entry) {
  return {{"name", entry.name},
          {"revision", entry.revision},
          {"bytes", entry.size},
          {"lines", entry.lines},
          {"crc32", entry.crc32}};
}

int answer(const Common& common, const std::string& done, const ProgramEntry& entry) {
  if (common.json)
    std::cout << bus::text_of({{"done", done}, {"program", json_of(entry)}}, 2) << "\n";
  else
    std::printf("%s %s: revision %llu, %llu bytes, %u lines\n", entry.name.c_str(), done.c_str(),
                static_cast<unsigned long long>(entry.revision), static_cast<unsigned long long>(entry.size),
                entry.lines);
  return 0;
}

cluster::Client connect(const Common& common) {
  return cluster::Client(cluster::find_cluster(common.domain).run.domain);
}

int list_programs(const Common& common) {
  auto client = connect(common);
  const auto list = client.newest(topics::program_list);
  if (common.json) {
    bus::Json programs = bus::Json::array();
    for (const auto& entry : list.programs) programs.push_back(json_of(entry));
    std::cout << bus::text_of({{"revision", list.revision}, {"programs", programs}}, 2) << "\n";
    return 0;
  }
  std::printf("%-40s %9s %12s %9s\n", "program", "revision", "bytes", "lines");
  for (const auto& entry : list.programs)
    std::printf("%-40s %9llu %12llu %9u\n", entry.name.c_str(),
                static_cast<unsigned long long>(entry.revision), static_cast<unsigned long long>(entry.size),
                entry.lines);
  return 0;
}

int put(const Common& common, const ProgramOptions& options) {
  const auto text = machine::read_text(options.file);
  auto client = connect(common);
  const auto name = options.name.empty() ? fs::path(options.file).filename().string() : options.name;
  const auto before = client.newest(topics::program_list);
  const auto same = std::ranges::find(before.programs, name, &ProgramEntry::name);
  if (same != before.programs.end() && !options.replace)
    throw std::runtime_error(name + " is stored already (revision " + std::to_string(same->revision) +
                             "): --replace stores this text in its place");
  client.upload(name, text);
  idl::program::ProgramRequest request;
  request.operation = Operation::RESOLVE;
  request.name = name;
  return answer(common, "stored", client.program(request).entry);
}

int get_program(const Common& common, const ProgramOptions& options) {
  auto client = connect(common);
  const auto entry = stored(client.newest(topics::program_list), options.name);
  const auto text = client.download(entry.name);
  if (options.file.empty() || options.file == "-") {
    std::cout << text;
    return std::cout.flush() ? 0 : 1;
  }
  std::ofstream out(options.file, std::ios::binary);
  out << text;
  out.close();
  if (!out) throw std::runtime_error("cannot write " + options.file);
  return answer(common, "written to " + options.file, entry);
}

/// Changes a stored program; the program service refuses one that a channel executes. Returns it as it was
/// and as it is now.
std::pair<ProgramEntry, ProgramEntry> change(const Common& common, const ProgramOptions& options,
                                             Operation operation) {
  auto client = connect(common);
  const auto entry = stored(client.newest(topics::program_list), options.name);
  idl::program::ProgramRequest request;
  request.operation = operation;
  request.name = entry.name;
  request.new_name = options.new_name;
  return {entry, client.program(request).entry};
}

int remove_program(const Common& common, const ProgramOptions& options) {
  return answer(common, "deleted", change(common, options, Operation::REMOVE).first);
}

int rename(const Common& common, const ProgramOptions& options) {
  const auto [before, now] = change(common, options, Operation::RENAME);
  return answer(common, "was " + before.name, now);
}

int check_program(const Common& common, const ProgramOptions& options) {
  const auto cluster = cluster::find_cluster(common.domain);
  cluster::Client client(cluster.run.domain);
  const auto entry = stored(client.newest(topics::program_list), options.name);
  const storage::TemporaryDirectory directory("trunnion-check");
  const auto write = [&](const std::string& name) {
    std::ofstream(directory.path() / name, std::ios::binary) << client.download(name);
  };
  write(entry.name);
  const auto fetch = [&] {
    for (const auto& other : client.newest(topics::program_list).programs)
      if (other.name != entry.name) write(other.name);
  };
  tool_tables::MachineTables active;
  active.parameters = machine::parameters_of(client.newest(topics::parameter_set));
  active.tools = client.newest(topics::tool_table);
  active.offsets = client.newest(topics::work_offsets);
  return check_file((directory.path() / entry.name).string(), cluster.machine_directory, active, fetch);
}

}  // namespace

void add_program_commands(CLI::App& app, Common& common) {
  auto* program = app.add_subcommand("program", "List, store, read and check programs of a running cluster");
  program->require_subcommand(1);
  const auto add = [&](const char* name, const char* about,
                       int (*run)(const Common&, const ProgramOptions&)) {
    auto options = std::make_shared<ProgramOptions>();
    auto* command =
        add_command(*program, common, name, about, [&common, options, run] { return run(common, *options); });
    return std::pair(command, options);
  };
  const char* const stored_name = "Name of a stored program, with or without .nc";
  add("list", "Stored programs with revision and size",
      [](const Common& c, const ProgramOptions&) { return list_programs(c); });
  {
    const auto [command, options] = add("put", "Store a file as a program", put);
    command->add_option("file", options->file, "File")->required()->check(CLI::ExistingFile);
    command->add_option("name", options->name, "Name in the store (default: that of the file)");
    command->add_flag("--replace", options->replace, "Also when a program of this name is stored");
  }
  {
    const auto [command, options] = add("get", "Read a stored program", get_program);
    command->add_option("name", options->name, stored_name)->required();
    command->add_option("file", options->file, "File to write (default: standard output)");
  }
  {
    const auto [command, options] =
        add("delete", "Delete a stored program that no channel executes", remove_program);
    command->add_option("name", options->name, stored_name)->required();
  }
  {
    const auto [command, options] = add("rename", "Give a stored program another name", rename);
    command->add_option("name", options->name, stored_name)->required();
    command->add_option("new-name", options->new_name, "New name")->required();
  }
  {
    const auto [command, options] =
        add("check", "Interpret a stored program with the axes, travel, offsets and tools that are active",
            check_program);
    command->add_option("name", options->name, stored_name)->required();
  }
}

}  // namespace trunnion::cli
