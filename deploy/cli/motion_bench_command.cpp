// SPDX-License-Identifier: Apache-2.0
// bench motion: the reference motions with their bounds, and the speed of planning
#include <sys/resource.h>

#include <chrono>
#include <cstdio>
#include <iostream>

#include "analysis/program_run.hpp"
#include "bus/json.hpp"
#include "cluster/cluster_files.hpp"
#include "commands.hpp"
#include "language/text_source.hpp"
#include "motion_analysis/motion_bench.hpp"

namespace trunnion::cli {
namespace {

struct Speed {
  const char* name;
  std::string text;
  double asked;  ///< blocks per second
};

constexpr double most_megabytes = 100;

// Blocks per second of a program text, interpretation included; the best of three runs, since
// other work on the machine only slows it down.
double blocks_per_second(channel_setup::ChannelSetup& machine, const std::string& text) {
  double best = 0;
  for (int k = 0; k < 3; ++k) {
    language::StringSource source(text);
    const auto begin = std::chrono::steady_clock::now();
    const auto result = analysis::run_program(source, machine, machine.reference_position(), {}, {});
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    if (!result.good) throw std::runtime_error("bench motion: " + result.alarm);
    best = std::max(best, static_cast<double>(result.blocks) / seconds);
  }
  return best;
}

}  // namespace

int bench_motion(const Common& common, const std::string& machine_name) {
  bus::Json rows = bus::Json::array();
  bool good = true;
  if (!common.json)
    std::printf("%-24s %8s %8s %7s %8s %7s %7s %7s %9s %9s\n", "path", "time s", "bound s", "ratio",
                "allowed", "v", "a", "j", "contour", "verdict");
  for (const auto& reference : analysis::reference_cases()) {
    const auto result = analysis::run_case(reference);
    const auto& r = result.run;
    good = good && result.good;
    rows.push_back({{"path", reference.path.name},
                    {"time", r.motion_time},
                    {"bound", reference.bound},
                    {"bound_is", reference.bound_is},
                    {"ratio", r.motion_time / reference.bound},
                    {"allowed", reference.allowed},
                    {"velocity", r.worst.velocity},
                    {"acceleration", r.worst.acceleration},
                    {"jerk", r.worst.jerk},
                    {"contour", r.deviation.contour},
                    {"orientation", r.deviation.orientation},
                    {"good", result.good}});
    if (!common.json)
      std::printf("%-24s %8.4f %8.4f %7.4f %8.4f %7.4f %7.4f %7.4f %9.6f %9s  (%s)\n",
                  reference.path.name.c_str(), r.motion_time, reference.bound,
                  r.motion_time / reference.bound, reference.allowed, r.worst.velocity, r.worst.acceleration,
                  r.worst.jerk, r.deviation.contour, result.good ? "good" : "MISSED",
                  reference.bound_is.c_str());
  }
  channel_setup::ChannelSetup machine(tool_tables::load_machine_tables(cluster::find_machine(machine_name)));
  // A relief of 3,000 places fits on the table; the stairs stay within the travel.
  const Speed speeds[] = {
      {"three-axis", analysis::program_text(analysis::dense_three_axis(2000)), 150e3},
      {"five-axis", analysis::program_text(analysis::wavy_cap(1000)), 50e3},
      {"relief", analysis::program_text(analysis::relief(3000, false)), 25e3},
      {"five-axis relief", analysis::program_text(analysis::relief(3000, true)), 15e3},
      {"lines and arcs", analysis::program_text(analysis::lines_and_arcs(240)), 20e3},
  };
  for (const Speed& speed : speeds) {
    const double reached = blocks_per_second(machine, speed.text);
    good = good && reached >= speed.asked;
    rows.push_back({{"planning", speed.name},
                    {"blocks_per_second", reached},
                    {"asked", speed.asked},
                    {"good", reached >= speed.asked}});
    if (!common.json)
      std::printf("planning %-16s %8.0f blocks/s, asked %6.0f  %s\n", speed.name, reached, speed.asked,
                  reached >= speed.asked ? "good" : "MISSED");
  }
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const double megabytes = static_cast<double>(usage.ru_maxrss) / 1024;  // Linux counts KiB
  good = good && megabytes <= most_megabytes;
  rows.push_back(
      {{"memory_megabytes", megabytes}, {"asked", most_megabytes}, {"good", megabytes <= most_megabytes}});
  if (!common.json)
    std::printf("memory of the process, at most %.0f MB, asked %.0f  %s\n", megabytes, most_megabytes,
                megabytes <= most_megabytes ? "good" : "MISSED");
  if (common.json) std::cout << rows.dump(2) << "\n";
  return good ? 0 : 1;
}

}  // namespace trunnion::cli
