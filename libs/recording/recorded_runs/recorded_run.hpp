// SPDX-License-Identifier: Apache-2.0
// A whole run: a cluster of its own, a program for each channel, a recording, a report.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "cluster/cluster.hpp"
#include "cluster/executables.hpp"
#include "contracts/types.hpp"
#include "machine/parameters.hpp"
#include "report/report.hpp"
#include "report/stream_timing.hpp"

namespace trunnion::recorded_runs {

/// What a run tells while it lasts, and asks; each may be empty.
struct RunNews {
  /// The cluster is ready.
  std::function<void(const std::string& machine, const cluster::RunningCluster& cluster)> ready;
  /// Every 0.1 s, by channel, `seconds` after the start of the programs, and at their end.
  std::function<void(const std::vector<idl::channel::ChannelState>& newest, double seconds)> progress;
  std::function<void()> progress_end;
  /// A channel has stopped: a run has no operator who sees it.
  std::function<void(const idl::channel::ChannelState& state, std::uint32_t domain)> stopped;
  /// The run is to end.
  std::function<bool()> interrupted;
};

struct RunOptions {
  std::string machine;
  std::vector<std::string> programs;  ///< files or names of stored programs, one for each channel
  std::string vendor;                 ///< empty, fastdds, cyclonedds or mixed
  cluster::Executables executables;   ///< in the place of those beside the command
  std::string recording;              ///< file to write
  bool real_time = false;
  std::map<std::uint32_t, machine::ParameterValue> parameters;  ///< set before the programs run
  std::uint32_t from_line = 0;  ///< start from this line of the first program; 0 = from its top
  bool dry_run = false;
  bool continue_starved = false;  ///< after the drive has stopped because setpoints were missing
  double timeout = 3600;          ///< s of wall time
  std::optional<std::uint32_t> domain;
  std::string who;  ///< sets the parameters, for the journal
  RunNews news;
};

struct RunResult {
  std::vector<report::Report> reports;  ///< one for each program
  std::string alarm;                    ///< why the programs did not end well, or empty
  double start_seconds = 0;             ///< until the cluster was ready
};

/// Nothing of the cluster is left when it returns or throws.
RunResult run_programs(const RunOptions& options);

/// Cycles executed in a second of wall time, by turns without and with a recorder of every topic.
struct RecordingCost {
  std::vector<double> without, with;
};

/// Runs the first program of `options` twice in each round, all in one cluster in virtual time. Throws
/// std::runtime_error with the alarm when a run does not end well.
RecordingCost measure_recording(const RunOptions& options, int rounds);

/// Runs the first program of `options` in one cluster in real time, again and again for `seconds` of wall
/// time, at least once. Throws std::runtime_error with the alarm when a run does not end well; starved
/// periods are counted and do not end it.
report::StreamTiming measure_real_time(const RunOptions& options, double seconds);

}  // namespace trunnion::recorded_runs
