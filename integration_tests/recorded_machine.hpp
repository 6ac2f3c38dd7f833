// SPDX-License-Identifier: Apache-2.0
// A machine that lives, and recordings of it that are verified.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "cluster/child_process.hpp"
#include "cluster_harness.hpp"
#include "verification/verify.hpp"

namespace trunnion::integration {

class RecordedMachine {
 public:
  RecordedMachine(std::string machine, Time time, std::string vendor = "");
  ~RecordedMachine();

  Cluster& cluster() { return *cluster_; }
  std::string file(const std::string& name) const { return (directory_ / name).string(); }

  /// As `trunnion up` and `down` on the kept state.
  void up();
  void down() { cluster_.reset(); }
  /// After down(): the drive continues with these numbers of cycle and tick, as after a long uptime.
  void set_counters(std::uint64_t cycle, std::uint64_t tick);

  /// Returns when the recording runs; `more` are options of the recorder.
  void record(const std::string& name, const std::vector<std::string>& more = {});
  void stop_recording();

  /// Stores and runs a program on each channel to its end.
  void run_programs();
  void start_programs();
  bool await_end();
  /// As an operator: a parameter that the stream uses, a work offset, and a reset that activates them.
  void change_values();
  void reset();
  void swap(const std::string& service);
  /// kill -9, until the launcher has replaced it and the machine is ready.
  void kill_service(const std::string& service);

  /// Every service of the machine against the recording: an expectation for each. `excused` are services that
  /// may say in one line that they cannot be verified; those are returned with what they say.
  std::map<std::string, std::string> expect_verified(const std::string& name,
                                                     const std::set<std::string>& excused = {});
  std::uint64_t cycles(const std::string& service) const { return cycles_.at(service); }

 private:
  std::string machine_, vendor_;
  Time time_;
  std::filesystem::path directory_;
  std::unique_ptr<Cluster> cluster_;
  cluster::ChildProcess recorder_;
  std::uint16_t channels_ = 1;
  std::map<std::string, std::uint64_t> cycles_;
};

}  // namespace trunnion::integration
