// SPDX-License-Identifier: Apache-2.0
// test: a suite of verifications
#include <CLI/CLI.hpp>
#include <atomic>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <memory>
#include <mutex>
#include <thread>

#include "bus/json.hpp"
#include "cluster/child_process.hpp"
#include "cluster/cluster_files.hpp"
#include "commands.hpp"
#include "machine/machine.hpp"
#include "machine/yaml.hpp"
#include "service/node.hpp"
#include "storage/temporary_directory.hpp"
#include "verification/stored_recording.hpp"
#include "verification/suite.hpp"
#include "verification/suite_report.hpp"

namespace trunnion::cli {
namespace {

namespace fs = std::filesystem;
using verification::Suite;
using verification::SuiteEntry;
using verification::SuiteResult;
using verification::SuiteTest;
using verification::VerifiedProcess;

struct SuiteOptions {
  std::string suite, junit, html;
  unsigned jobs = std::max(1u, std::thread::hardware_concurrency());
};

std::vector<VerifiedProcess> processes_of(const SuiteEntry& entry) {
  std::string name = entry.machine;
  if (name.empty()) {
    const auto recording = verification::load_recording(entry.recording, {"cluster"});
    const auto machine = recording.metadata.find("machine");
    if (machine == recording.metadata.end())
      throw std::runtime_error(entry.place + entry.recording + " names no machine: enter it as 'machine'");
    name = machine->second;
  }
  std::vector<VerifiedProcess> processes;
  for (const auto& service : machine::load_machine(cluster::find_machine(name)).services)
    if (service.replica == 0)
      processes.push_back({service.service, static_cast<std::uint16_t>(service.channel)});
  return processes;
}

void write(const std::string& path, const std::string& text) {
  std::ofstream out(path);
  out << text;
  out.close();
  if (!out) throw std::runtime_error("cannot write " + path);
}

/// Runs the tests, as many at a time as `jobs`, each in a process of its own, which may end as it likes.
class Runner {
 public:
  Runner(const Suite& suite, std::vector<SuiteTest> tests, bool quiet)
      : suite_(suite), tests_(std::move(tests)), results_(tests_.size()), quiet_(quiet) {}

  std::vector<SuiteResult> run(unsigned jobs) {
    std::vector<std::thread> workers;
    for (unsigned i = 0; i < std::min<std::size_t>(jobs, tests_.size()); ++i)
      workers.emplace_back([this] {
        for (std::size_t next = taken_++; next < tests_.size(); next = taken_++) verify(next);
      });
    for (auto& worker : workers) worker.join();
    return std::move(results_);
  }

 private:
  void verify(std::size_t number) {
    const auto& test = tests_[number];
    auto& result = results_[number];
    result.recording = suite_.entries[test.entry].recording;
    result.name = test.name;
    const auto log = (logs_.path() / std::to_string(number)).string();
    cluster::ChildOptions options;
    options.arguments = verification::verify_arguments(suite_, test);
    options.arguments.insert(options.arguments.begin(), fs::read_symlink("/proc/self/exe").string());
    options.log = log;
    options.read_from = 1;
    options.ends_with_parent = true;
    const double begin = service::monotonic_seconds();
    try {
      cluster::ChildProcess child(options);
      const auto output = child.read_all();
      while (!child.status()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
      const int status = *child.status();
      verification::judge(result, WIFEXITED(status) ? WEXITSTATUS(status) : 1, output,
                          cluster::last_line(log));
    } catch (const std::exception& e) {
      result.problem = e.what();
    }
    result.seconds = service::monotonic_seconds() - begin;
    if (quiet_) return;
    const std::lock_guard lock(mutex_);
    std::printf("[%zu/%zu] %s %-14s %6.2f s  %s%s%s\n", ++done_, tests_.size(),
                result.passed    ? "passed"
                : result.skipped ? "skipped"
                                 : "FAILED",
                result.name.c_str(), result.seconds, result.recording.c_str(), result.passed ? "" : ": ",
                result.problem.c_str());
    std::fflush(stdout);
  }

  const storage::TemporaryDirectory logs_{"trunnion-test"};
  const Suite& suite_;
  std::vector<SuiteTest> tests_;
  std::vector<SuiteResult> results_;
  std::atomic<std::size_t> taken_{0};
  std::mutex mutex_;
  std::size_t done_ = 0;
  bool quiet_;
};

int run_suite(const Common& common, const SuiteOptions& options) {
  const auto suite = verification::parse_suite(machine::read_text(options.suite), options.suite);
  const auto title = suite.title.empty() ? fs::path(options.suite).filename().string() : suite.title;
  const auto results =
      Runner(suite, verification::tests_of(suite, processes_of), common.json).run(options.jobs);
  if (!options.junit.empty()) write(options.junit, verification::junit_of(title, results));
  if (!options.html.empty()) write(options.html, verification::html_of(title, results));
  const auto passed = std::ranges::count(results, true, &SuiteResult::passed);
  const auto skipped = std::ranges::count(results, true, &SuiteResult::skipped);
  if (common.json) {
    bus::Json list = bus::Json::array();
    for (const auto& result : results)
      list.push_back({{"recording", result.recording},
                      {"name", result.name},
                      {"passed", result.passed},
                      {"skipped", result.skipped},
                      {"seconds", result.seconds},
                      {"problem", result.problem},
                      {"report", result.report}});
    std::cout << bus::text_of({{"title", title}, {"passed", passed}, {"skipped", skipped}, {"tests", list}},
                              2)
              << "\n";
  } else {
    const auto more = skipped == 0 ? "" : ", " + std::to_string(skipped) + " skipped";
    std::printf("%td of %zu verifications as recorded%s\n", passed, results.size(), more.c_str());
  }
  return verification::is_passed(results) ? 0 : 1;
}

}  // namespace

void add_test_command(CLI::App& app, Common& common) {
  auto options = std::make_shared<SuiteOptions>();
  auto* command = add_command(
      app, common, "test",
      "Verify the services of a list of recordings (docs/recordings.md); status 0: all are equal, and what "
      "a recording has nothing for is skipped",
      [&common, options] { return run_suite(common, *options); });
  command->add_option("suite", options->suite, "The list as YAML")->required()->check(CLI::ExistingFile);
  command->add_option("--jobs", options->jobs, "Verifications at a time (default: the number of processors)")
      ->check(CLI::Range(1, 64));
  command->add_option("--junit", options->junit, "Write the results as JUnit XML to this file");
  command->add_option("--html", options->html,
                      "Write a page with the results and plots of first differences");
}

}  // namespace trunnion::cli
