// SPDX-License-Identifier: Apache-2.0
// run: a machine, a program, a report; bench: the same as a measurement
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include "bus/json.hpp"
#include "cluster/cluster_files.hpp"
#include "commands.hpp"
#include "interrupt_watch.hpp"
#include "parameter_request.hpp"
#include "recorded_runs/recorded_run.hpp"

namespace trunnion::cli {
namespace fs = std::filesystem;
namespace {

using recorded_runs::RunOptions;

void draw_progress(const std::vector<idl::channel::ChannelState>& states, double seconds) {
  std::uint64_t cycle = 0;
  std::string lines;
  for (const auto& state : states) {
    cycle = std::max(cycle, state.cycle);
    lines += (lines.empty() ? "line " : ", ") + std::to_string(state.line) + " of " +
             std::to_string(state.lines_total);
  }
  std::fprintf(stderr, "\r%s  cycle %llu  %.1f s ", lines.c_str(), static_cast<unsigned long long>(cycle),
               seconds);
  std::fflush(stderr);
}

// How the run is continued. `bar`: a line of progress is on the terminal.
void say_stopped(const idl::channel::ChannelState& state, std::uint32_t domain, bool bar) {
  const unsigned channel = state.channel;
  std::fprintf(stderr,
               "%schannel %u is stopped behind line %u (%s): 'trunnion channel start --channel %u "
               "--domain %u' continues it, Ctrl-C ends the run\n",
               bar ? "\n" : "", channel, static_cast<unsigned>(state.line),
               state.detail.empty() ? "M0, M1 or a feed hold" : state.detail.c_str(), channel,
               static_cast<unsigned>(domain));
}

// The news of a run on the terminal; of a quiet one only what ends it or has stopped it.
recorded_runs::RunNews news_of(bool quiet, bool real_time) {
  recorded_runs::RunNews news;
  const bool bar = !quiet && isatty(2) != 0;
  news.interrupted = &InterruptWatch::requested;
  news.stopped = [bar](const auto& state, std::uint32_t domain) { say_stopped(state, domain, bar); };
  if (bar) {
    news.progress = &draw_progress;
    news.progress_end = [] { std::fprintf(stderr, "\n"); };
  }
  if (!quiet)
    news.ready = [real_time](const std::string& machine, const cluster::RunningCluster& cluster) {
      std::printf("%s is ready in %.2f s (%s time, domain %u)\n", machine.c_str(), cluster.start_seconds,
                  real_time ? "real" : "virtual", cluster.run.domain);
      std::fflush(stdout);
    };
  return news;
}

int run_machine(const Common& common, RunOptions options, const std::string& report_directory) {
  const fs::path out = report_directory.empty() ? fs::path("out") : fs::path(report_directory);
  fs::create_directories(out);
  if (options.recording.empty()) options.recording = (out / "recording.mcap").string();
  options.domain = common.domain;
  options.who = user_name() + " run";
  const InterruptWatch watch(true);
  options.news = news_of(common.json, options.real_time);
  const auto result = run_programs(options);
  bus::Json all = bus::Json::array();
  for (std::size_t c = 0; c < result.reports.size(); ++c) {
    const auto directory = result.reports.size() == 1 ? out : out / ("channel" + std::to_string(c));
    report::write_report(result.reports[c], directory.string());
    if (common.json)
      all.push_back(bus::Json::parse(report::json_text(result.reports[c])));
    else
      std::printf("\n%s\nReport: %s\n", report::terminal_text(result.reports[c]).c_str(),
                  directory.string().c_str());
  }
  if (common.json) std::cout << (all.size() == 1 ? all[0] : all).dump(2) << "\n";
  if (!result.alarm.empty()) throw std::runtime_error(result.alarm);
  return 0;
}

// Times the cone over the vendors in virtual time, each layout several times in turn, so that a noisy machine
// is noisy for all; or counts starved cycles in real time.
int bench(const Common& common, const std::string& machine, const std::string& program,
          const std::vector<std::string>& vendors, int rounds, bool real_time) {
  const auto recording =
      (fs::temp_directory_path() / ("trunnion-bench-" + std::to_string(getpid()) + ".mcap")).string();
  const InterruptWatch watch(true);
  bus::Json rows = bus::Json::array();
  if (!common.json)
    std::printf("%-11s %5s %12s %14s %10s %18s\n", "vendor", "round", "cycles", "x real time", "starved",
                "command hash");
  for (int round = 0; round < rounds; ++round)
    for (const auto& vendor : vendors) {
      RunOptions options;
      options.machine = machine, options.programs = {program}, options.vendor = vendor;
      options.recording = recording, options.real_time = real_time;
      options.continue_starved = real_time;
      options.news = news_of(true, real_time);
      const auto result = run_programs(options);
      fs::remove(recording);
      if (!result.alarm.empty()) throw std::runtime_error(result.alarm);
      const auto& r = result.reports.at(0);
      rows.push_back({{"vendor", vendor},
                      {"round", round},
                      {"cycles", r.executed},
                      {"times_real_time", r.speed},
                      {"starved_periods", r.starved},
                      {"ready_seconds", result.start_seconds}});
      if (!common.json)
        std::printf("%-11s %5d %12llu %14.1f %10llu   %016llx\n", vendor.c_str(), round,
                    static_cast<unsigned long long>(r.executed), r.speed,
                    static_cast<unsigned long long>(r.starved),
                    static_cast<unsigned long long>(r.command_hash));
      std::fflush(stdout);
    }
  if (common.json) std::cout << rows.dump(2) << "\n";
  return 0;
}

// Runs the program for some time in real time and says how punctual every process was.
int bench_real_time(const Common& common, RunOptions options, const std::vector<std::string>& vendors,
                    double seconds) {
  options.recording =
      (fs::temp_directory_path() / ("trunnion-bench-" + std::to_string(getpid()) + ".mcap")).string();
  options.real_time = true;
  const InterruptWatch watch(true);
  options.news = news_of(common.json, true);
  bus::Json rows = bus::Json::array();
  for (const auto& vendor : vendors) {
    options.vendor = vendor;
    const auto timing = measure_real_time(options, seconds);
    if (common.json) {
      rows.push_back(bus::Json::parse(report::json_text(timing)));
      rows.back()["vendor"] = vendor;
    } else {
      std::printf("%s\n%s\n", vendor.c_str(), report::terminal_text(timing).c_str());
      std::fflush(stdout);
    }
  }
  if (common.json) std::cout << rows.dump(2) << "\n";
  return 0;
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

// What a recorder of every topic costs the stream, by turns in one cluster for each vendor.
int bench_recording(const Common& common, const std::string& machine, const std::string& program,
                    const std::vector<std::string>& vendors, int rounds) {
  const auto recording =
      (fs::temp_directory_path() / ("trunnion-bench-" + std::to_string(getpid()) + ".mcap")).string();
  const InterruptWatch watch(true);
  bus::Json rows = bus::Json::array();
  if (!common.json)
    std::printf("%-11s %24s %24s %8s\n", "vendor", "cycles/s, not recorded", "cycles/s, recorded", "ratio");
  for (const auto& vendor : vendors) {
    RunOptions options;
    options.machine = machine, options.programs = {program}, options.vendor = vendor;
    options.recording = recording, options.domain = common.domain;
    options.news = news_of(true, false);
    const auto cost = measure_recording(options, rounds);
    const double without = median(cost.without), with = median(cost.with);
    rows.push_back({{"vendor", vendor},
                    {"cycles_per_second", without},
                    {"cycles_per_second_recorded", with},
                    {"ratio", with / without},
                    {"rounds", rounds}});
    if (!common.json)
      std::printf("%-11s %24.0f %24.0f %8.3f\n", vendor.c_str(), without, with, with / without);
    std::fflush(stdout);
  }
  if (common.json) std::cout << rows.dump(2) << "\n";
  return 0;
}

}  // namespace

void add_run_command(CLI::App& app, Common& common) {
  auto options = std::make_shared<RunOptions>();
  auto report_directory = std::make_shared<std::string>();
  auto executables = std::make_shared<std::vector<std::string>>();
  auto parameters = std::make_shared<std::string>();
  auto* command = add_command(app, common, "run",
                              "Start a cluster of its own, run a program on it, write a report, stop it",
                              [&common, options, report_directory, executables, parameters] {
                                options->executables = cluster::read_executables(*executables);
                                if (!parameters->empty())
                                  options->parameters = machine::read_parameter_file(*parameters);
                                return run_machine(common, *options, *report_directory);
                              });
  command
      ->add_option("machine", options->machine,
                   "Name under configs/machines, or a directory with machine.yaml")
      ->required();
  command
      ->add_option("programs", options->programs,
                   "Program file, or name of a stored program; one for each channel")
      ->required();
  command->add_option("--record", options->recording,
                      "Recording to write (default: recording.mcap in the report's directory)");
  command->add_option("--report", *report_directory, "Directory of the report (default: out)");
  command->add_flag("--real-time", options->real_time,
                    "One cycle in one cycle time instead of as fast as possible");
  command->add_option("--vendor", options->vendor, "DDS vendor of every service, instead of machine.yaml's")
      ->check(CLI::IsMember({"fastdds", "cyclonedds", "mixed"}));
  command->add_option("--exec", *executables, exec_help);
  command->add_option("--parameters", *parameters,
                      "YAML file of parameters that are set before, as `param import` and a reset do; the "
                      "machine's own files stay as they are");
  command->add_option("--from-line", options->from_line, "Start the first program from this line");
  command->add_flag("--dry-run", options->dry_run, "Parameter 04c914 takes the place of programmed feeds");
  command->add_option("--timeout", options->timeout, "Seconds of wall time after which the run has failed");
}

void add_bench_command(CLI::App& app, Common& common) {
  auto machine = std::make_shared<std::string>("ac-table"),
       program = std::make_shared<std::string>("nas979_cone");
  auto vendors =
      std::make_shared<std::vector<std::string>>(std::vector<std::string>{"cyclonedds", "mixed", "fastdds"});
  auto rounds = std::make_shared<int>(3);
  auto seconds = std::make_shared<double>(0);
  auto real_time = std::make_shared<bool>(false), recording = std::make_shared<bool>(false);
  auto subject = std::make_shared<std::string>("stream");
  auto* command =
      add_command(app, common, "bench",
                  "Measure the stream: the speed of a program in virtual time over the DDS vendors, or "
                  "starved cycles and delays in real time; or the planner: the reference motions and its "
                  "speed",
                  [&common, machine, program, vendors, rounds, real_time, seconds, recording, subject] {
                    if (*subject == "motion") return bench_motion(common, *machine);
                    if (*recording) return bench_recording(common, *machine, *program, *vendors, *rounds);
                    if (*real_time && *seconds > 0) {
                      RunOptions repeated;
                      repeated.machine = *machine, repeated.programs = {*program};
                      return bench_real_time(common, repeated, *vendors, *seconds);
                    }
                    return bench(common, *machine, *program, *vendors, *rounds, *real_time);
                  });
  command->add_option("subject", *subject, "stream (default) or motion")
      ->check(CLI::IsMember({"stream", "motion"}));
  command->add_option("--machine", *machine, "Machine (default ac-table)");
  command->add_option("--program", *program, "Program (default nas979_cone)");
  command->add_option("--vendor", *vendors, "DDS vendors to run with (default: each alone, and mixed)")
      ->check(CLI::IsMember({"fastdds", "cyclonedds", "mixed"}));
  command->add_option("--rounds", *rounds, "Rounds over the vendors")->check(CLI::Range(1, 1000));
  command->add_flag("--real-time", *real_time, "Run in real time and count starved cycles");
  command
      ->add_option("--seconds", *seconds,
                   "With --real-time: repeat the program for this many seconds for each vendor; prints the "
                   "delays of every process and the lead this computer could run with")
      ->check(CLI::Range(1.0, 86400.0));
  command->add_flag("--recording", *recording, "What a recorder costs: runs with and without one by turns");
}

}  // namespace trunnion::cli
