// SPDX-License-Identifier: Apache-2.0
// One channel's motion in a recording, cycle by cycle.
#pragma once

#include <array>
#include <iterator>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "machine/services.hpp"
#include "recording/cycle_coverage.hpp"
#include "recording/mcap_reader.hpp"
#include "report/programmed_path.hpp"

namespace trunnion::report {

/// The stages whose batches are timed, in the order of the stream.
inline constexpr auto batch_stages = [] {
  std::array<const char*, std::size(machine::service::stages)> names{};
  for (std::size_t i = 0; i < names.size(); ++i) names[i] = machine::service::stages[i].name;
  return names;
}();

struct PathRow {
  std::uint64_t cycle = 0;
  std::uint32_t epoch = 0;
  std::uint32_t line = 0;
  bool rtcp = false;
  double tool_length = 0;           ///< mm
  language::AxisValues position{};  ///< as in PathBatch
};

/// Rows of a fixed width, each with its cycle.
struct RowTable {
  std::size_t width = 0;
  std::vector<std::uint64_t> cycles;
  std::vector<std::uint32_t> epochs;
  std::vector<double> values;
  const double* row(std::size_t i) const { return &values[i * width]; }
};

/// First arrival of the batch that begins at a cycle, by stage; ns since the epoch, 0 = not there.
struct BatchTimes {
  std::uint64_t last_cycle = 0;
  bool starts = false;  ///< the first of a motion
  std::array<std::int64_t, batch_stages.size()> written{};
};

struct FeedbackTime {
  std::uint64_t first = 0, count = 0, tick = 0;
  std::int64_t written = 0;
};

struct Capture {
  MachineTables tables;
  bool has_parameters = false, has_tools = false, has_offsets = false;
  std::vector<PathRow> path;               ///< ascending cycles, of the newest epoch that has them
  RowTable gantry;                         ///< columns: axes of the channel; ascending cycles
  std::vector<std::uint16_t> gantry_axes;  ///< logical axis numbers of its columns
  RowTable commanded, actual;              ///< columns: the drive's axes; ascending cycles
  std::map<std::pair<std::uint32_t, std::uint64_t>, BatchTimes> batches;  ///< by epoch and first cycle
  std::vector<FeedbackTime> feedback;
  std::map<std::string, std::uint64_t> lost;  ///< cycles missing between batches, by topic handle
  std::uint64_t late_batches = 0;             ///< that came after a later one, and were still news
  std::uint64_t repeated_batches = 0;         ///< without new cycles: those of the second replica
  std::uint64_t messages = 0;
  std::map<std::string, std::string> metadata;
  std::uint64_t starved = 0;  ///< periods during the recording
  std::string problem;        ///< of the recording
  bool complete = false, damaged = false;
};

/// Reads everything of `channel`. Messages that do not decode are left out and named in `problem`.
Capture read_capture(recording::Source& source, std::uint16_t channel);

}  // namespace trunnion::report
