// SPDX-License-Identifier: Apache-2.0
// plan: a program's motion without a cluster: one row per cycle, and what it asks of the machine
#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <memory>
#include <stdexcept>

#include "analysis/file_source.hpp"
#include "analysis/program_folders.hpp"
#include "cluster/cluster_files.hpp"
#include "collision_machine.hpp"
#include "commands.hpp"
#include "motion_analysis/plan_report.hpp"
#include "plan_picture.hpp"

namespace trunnion::cli {
namespace {

struct Plan {
  std::string program, machine, csv, plot;
  std::vector<std::string> settings;
  bool places = false;
};

void print_places(const Plan& plan, const std::vector<analysis::CostlyPlace>& places) {
  for (const analysis::CostlyPlace& place : places)
    std::printf("%s:%s\n", plan.program.c_str(), analysis::to_text(place).c_str());
  if (places.empty()) std::printf("%s: the programmed feed is kept everywhere\n", plan.program.c_str());
}

void apply(const std::string& setting, machine::Parameters& parameters) {
  const auto equals = setting.find('=');
  std::size_t used = 0;
  std::uint32_t number = 0;
  double value = 0;
  try {
    if (equals == std::string::npos) throw std::invalid_argument("");
    number = static_cast<std::uint32_t>(std::stoul(setting.substr(0, equals), &used));
    if (used != equals) throw std::invalid_argument("");
    value = std::stod(setting.substr(equals + 1), &used);
    if (used + equals + 1 != setting.size()) throw std::invalid_argument("");
  } catch (const std::exception&) {
    throw std::runtime_error("--set " + setting + ": expected NUMBER=VALUE");
  }
  const std::string wrong = machine::Catalogue::instance().check(number, value, "");
  if (!wrong.empty()) throw std::runtime_error("--set " + setting + ": " + wrong);
  parameters.values[number] = {value, ""};
}

void write_row(std::FILE* file, const analysis::PlannedCycle& cycle, const machine::ChannelAxes& axes) {
  std::fprintf(file, "%llu,%u", static_cast<unsigned long long>(cycle.cycle), cycle.setpoint->line);
  for (const auto index : axes.index) std::fprintf(file, ",%.17g", cycle.machine[index]);
  std::fprintf(file, ",%.17g,%.17g,%.17g,%.6f\n", cycle.tip[0], cycle.tip[1], cycle.tip[2],
               cycle.setpoint->feed * 60);
}

int run_plan(const Plan& plan) {
  const std::string directory = cluster::find_machine(plan.machine);
  auto tables = tool_tables::load_machine_tables(directory);
  for (const auto& setting : plan.settings) apply(setting, tables.parameters);
  channel_setup::ChannelSetup machine(tables);
  std::string own = std::filesystem::path(plan.program).parent_path().string();
  analysis::ProgramFolders programs(
      {own.empty() ? "." : own, directory + "/programs", directory + "/cycles"});
  machine.resolve = [&programs](std::string_view name) { return programs.find(name); };
  analysis::FileSource text(plan.program);

  std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(nullptr, &std::fclose);
  const auto& axes = machine.channel_axes();
  if (!plan.csv.empty()) {
    file.reset(std::fopen(plan.csv.c_str(), "w"));
    if (!file) throw std::runtime_error(plan.csv + ": cannot be written");
    std::fprintf(file.get(), "cycle,line");
    for (const char letter : axes.letters) std::fprintf(file.get(), ",%c", letter);
    std::fprintf(file.get(), ",tip_x,tip_y,tip_z,feed\n");
  }
  const auto guard = collision_guard::load_guard(machine, directory, tables.parameters, 0);
  PlanPicture picture(machine.cycle_seconds());
  const auto report = analysis::plan_program(
      text, machine, machine.reference_position(),
      [&](const analysis::PlannedCycle& cycle) {
        if (file) write_row(file.get(), cycle, axes);
        if (!plan.plot.empty()) picture.add(cycle);
      },
      guard.get());
  print_warnings(guard.get(), plan.program);
  if (file && std::ferror(file.get()) != 0) throw std::runtime_error(plan.csv + ": cannot be written");
  if (!plan.plot.empty()) {
    std::ofstream out(plan.plot, std::ios::binary);
    out << picture.svg(std::filesystem::path(plan.program).filename().string() + " on " +
                           std::filesystem::path(plan.machine).filename().string(),
                       report.places);
    out.close();
    if (!out) throw std::runtime_error(plan.plot + ": cannot be written");
  }
  const auto status = [&] {
    if (report.result.good) return 0;
    std::cerr << plan.program << ":" << report.result.alarm << "\n";
    return 1;
  };
  if (plan.places) {
    print_places(plan, report.places);
    return status();
  }
  // A second time without rows and checks, for the speed of the planner itself.
  const auto begin = std::chrono::steady_clock::now();
  const auto timed = analysis::run_program(text, machine, machine.reference_position(), {}, {});
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();

  std::printf(
      "{\"motion_time\": %.6f, \"bound_time\": %.6f, \"time_to_bound\": %.4f, \"least_time\": %.6f, "
      "\"cycles\": %llu, \"blocks\": "
      "%llu, "
      "\"blocks_per_second\": %.0f, \"contour_deviation\": %.6f, \"orientation_deviation\": %.6f, \"axes\": "
      "{",
      report.motion_time, report.bound, report.bound > 0 ? report.motion_time / report.bound : 0.0,
      report.least_time, static_cast<unsigned long long>(report.result.cycles),
      static_cast<unsigned long long>(report.result.blocks),
      seconds > 0 ? static_cast<double>(timed.blocks) / seconds : 0.0, report.deviation.contour,
      report.deviation.orientation);
  for (std::size_t k = 0; k < axes.index.size(); ++k) {
    const auto& r = report.axes[axes.index[k]];
    std::printf("%s\"%c\": {\"velocity\": %.6f, \"acceleration\": %.6f, \"jerk\": %.6f}", k > 0 ? ", " : "",
                axes.letters[k], r.velocity, r.acceleration, r.jerk);
  }
  std::printf("}, \"costly_places\": [");
  static constexpr const char* limit_names[] = {"velocity", "acceleration", "jerk"};
  for (std::size_t k = 0; k < report.places.size(); ++k) {
    const analysis::CostlyPlace& place = report.places[k];
    std::printf(
        "%s{\"lines\": [%u, %u], \"begin\": %.3f, \"end\": %.3f, \"lost\": %.4f, \"axis\": \"%c\", "
        "\"limit\": \"%s\", "
        "\"use\": %.3f}",
        k > 0 ? ", " : "", place.first_line, place.last_line, place.begin, place.end, place.lost,
        canonical::axis_letters[place.axis], limit_names[static_cast<std::size_t>(place.limit)], place.use);
  }
  std::printf("]}\n");
  return status();
}

}  // namespace

void add_plan_command(CLI::App& app, Common& common) {
  auto plan = std::make_shared<Plan>();
  auto* command =
      add_command(app, common, "plan",
                  "Plan a program's motion without a cluster and report what it demands of the axes, as JSON",
                  [plan] { return run_plan(*plan); });
  command->add_option("program", plan->program, "The program's file")->required();
  command->add_option("--machine", plan->machine, "Folder or name of the machine")->required();
  command->add_option("--csv", plan->csv, "File for one row per cycle");
  command->add_flag("--places", plan->places,
                    "Print the ten places that lose most time as text, in place of JSON");
  command->add_option("--plot", plan->plot,
                      "File for a picture (SVG) of path and feed with the ten places that lose most time");
  command->add_option("--set", plan->settings,
                      "NUMBER=VALUE instead of the machine's parameter; may be repeated");
}

}  // namespace trunnion::cli
