// SPDX-License-Identifier: Apache-2.0
// check: what a program would do, without a cluster
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iostream>
#include <memory>
#include <optional>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "analysis/check_program.hpp"
#include "analysis/default_machine.hpp"
#include "analysis/json_lines.hpp"
#include "analysis/program_folders.hpp"
#include "analysis/program_summary.hpp"
#include "analysis/rotary_words.hpp"
#include "canonical/program_dialect.hpp"
#include "channel_setup/channel_setup.hpp"
#include "cluster/cluster_files.hpp"
#include "collision_machine.hpp"
#include "commands.hpp"

namespace trunnion::cli {
namespace {

struct CheckOptions {
  std::string program;
  std::string machine;
  std::string tools;
  std::string dialect;  ///< empty: that of the machine, without one ISO
  bool skip_blocks = false;
  bool json_lines = false;
  bool summary = false, json = false;
  std::optional<tool_tables::MachineTables> active;  ///< of a running machine, in place of its folder's
  std::function<void()> fetch;  ///< makes the programs that may be called files beside the program
};

std::optional<analysis::ToolRows> tool_rows(const std::string& path) {
  if (path.empty()) return std::nullopt;
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  if (!file) throw std::runtime_error(path + ": cannot be read");
  return analysis::read_tool_rows(text.str(), path);
}

/// The tools of the rows, with these values only.
idl::parameters::ToolTable tool_table(const analysis::ToolRows& rows) {
  idl::parameters::ToolTable table;
  for (const auto& [number, row] : rows) {
    idl::parameters::Tool tool;
    tool.number = number;
    tool.length = row.length;
    tool.radius = row.radius;
    table.tools.push_back(tool);
  }
  return table;
}

/// A line on the terminal while a long program is read.
class ProgressLine {
 public:
  void show(std::uint64_t line, std::uint64_t lines) {
    constexpr std::chrono::milliseconds period(200);
    const auto now = std::chrono::steady_clock::now();
    const bool last = line == lines && drawn_;
    if (!last && now - newest_ < period) return;
    newest_ = now;
    drawn_ = !last;
    std::fprintf(stderr, "\rline %llu of %llu %s", static_cast<unsigned long long>(line),
                 static_cast<unsigned long long>(lines), last ? "\n" : "");
    std::fflush(stderr);
  }

 private:
  std::chrono::steady_clock::time_point newest_ = std::chrono::steady_clock::now();
  bool drawn_ = false;
};

int run_check(const CheckOptions& options) {
  analysis::FileSource text(options.program);
  const auto rows = tool_rows(options.tools);
  std::vector<std::string> folders{std::filesystem::path(options.program).parent_path().string()};
  if (folders[0].empty()) folders[0] = ".";
  std::string directory;
  if (!options.machine.empty()) {
    directory = cluster::find_machine(options.machine);
    folders.push_back(directory + "/programs");
    folders.push_back(directory + "/cycles");
  }
  analysis::ProgramFolders programs(folders);
  auto fetch = options.fetch;
  const auto resolve = [&](std::string_view called) {
    if (fetch) std::exchange(fetch, nullptr)();
    return programs.find(called);
  };
  const auto name = [&](std::uint32_t program) {
    return program == 0 ? options.program : programs.path(language::ProgramName(program).view());
  };
  analysis::CheckOptions check_options;
  check_options.json_lines = options.json_lines;
  check_options.skip_blocks = options.skip_blocks;
  check_options.json = options.json;
  const auto dialect = canonical::dialect_named(options.dialect);
  ProgressLine progress;
  if (options.summary && isatty(STDERR_FILENO) != 0)
    check_options.progress = [&](std::uint64_t line, std::uint64_t lines) { progress.show(line, lines); };
  const auto check = [&](auto& machine, const language::AxisValues& start) {
    return options.summary ? analysis::summarize_program(text, machine, start, check_options, name, std::cout)
                           : analysis::check_program(text, machine, start, check_options, name, std::cout);
  };
  bool good = false;
  if (options.machine.empty()) {
    analysis::DefaultMachine machine(rows);
    machine.resolve = resolve;
    if (dialect) machine.dialect = *dialect;
    machine.rotary_axes = analysis::rotary_words(text);
    check_options.lengths_known = rows.has_value();
    good = check(machine, {});
  } else {
    const auto tables = options.active ? *options.active : tool_tables::load_machine_tables(directory);
    analysis::SurveyedMachine machine(tables);
    machine.resolve = resolve;
    if (dialect) machine.set_program_dialect(*dialect);
    if (rows) machine.set_tools(tool_table(*rows));
    const auto guard = collision_guard::load_guard(machine, directory, tables.parameters, 0);
    check_options.guard = guard.get();
    good = check(machine, machine.reference_position());
    print_warnings(guard.get(), options.program);
  }
  return good ? 0 : 1;
}

/// What keeps a program from being read at all is an error line too, when lines are asked for.
int run_check_as_asked(const CheckOptions& options) {
  if (!options.json_lines) return run_check(options);
  try {
    return run_check(options);
  } catch (const std::exception& error) {
    std::cout << "{\"error\":{\"line\":0,\"column\":0,\"number\":"
              << static_cast<unsigned>(language::AlarmNumber::text_unreadable)
              << ",\"text\":" << analysis::json_string(error.what()) << "}}\n";
    return 1;
  }
}

}  // namespace

int check_file(const std::string& program, const std::string& machine,
               const tool_tables::MachineTables& active, std::function<void()> fetch) {
  CheckOptions check;
  check.program = program, check.machine = machine;
  check.active = active, check.fetch = std::move(fetch);
  return run_check(check);
}

void add_check_command(CLI::App& app, Common& common) {
  auto options = std::make_shared<CheckOptions>();
  auto* command =
      add_command(app, common, "check", "Interpret a program without a cluster and report what it does",
                  [&common, options] {
                    options->json = common.json;
                    return run_check_as_asked(*options);
                  });
  command->add_option("program", options->program, "The program's file")->required();
  command->add_option(
      "--machine", options->machine,
      "Folder or name of a machine: its axes, travel, offsets and tools, from its reference position; else "
      "three linear axes from 0 without end, offsets 0, rotary axes that the program names without "
      "kinematics");
  command->add_option(
      "--tools", options->tools,
      "CSV file number,length,radius in place of the tools; without it and a machine every tool is 0 long");
  std::vector<std::string> names(canonical::dialect_names.begin(), canonical::dialect_names.end());
  command
      ->add_option("--dialect", options->dialect,
                   "Dialect of programs whose head names none, in place of that of the machine; iso when "
                   "neither is named")
      ->check(CLI::IsMember(names));
  command->add_flag("--skip-blocks", options->skip_blocks, "Leave out blocks that begin with /");
  auto* const motions =
      command->add_flag("--jsonl", options->json_lines, "One JSON object per motion instead of a summary");
  command
      ->add_flag("--summary", options->summary,
                 "Tools, times, envelope, reserve of travel, calls and all M codes that the machine does not "
                 "have; with --json as one document")
      ->excludes(motions);
}

}  // namespace trunnion::cli
