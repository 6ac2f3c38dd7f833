// SPDX-License-Identifier: Apache-2.0
// Keeps the last seconds in memory and writes them to a file when an alarm is raised.
#pragma once

#include <deque>
#include <map>
#include <optional>
#include <tuple>

#include "contracts/types.hpp"
#include "destination.hpp"
#include "recording_file.hpp"
#include "state_keeper.hpp"

namespace trunnion::recorder {

struct FlightLimits {
  double before = 30;             ///< s kept, and so saved before the alarm
  double after = 1;               ///< s saved after it
  std::size_t bytes = 256 << 20;  ///< that may be kept; the oldest are removed first
  idl::service::Severity severity = idl::service::Severity::WARNING;  ///< the least that saves
};

/// Files are `path` numbered from the next free number on; each starts with the states that were valid then.
/// Further alarms during `after` are in the same file. A problem with one file does not end the recording.
class FlightRecorder final : public Destination {
 public:
  /// Alarms that the bus keeps from before `began` (ns since the epoch) are ignored.
  FlightRecorder(std::string path, FileHeader header, FlightLimits limits, std::int64_t began);

  void take(Message& message, double now) override;
  void idle(double now) override;
  /// A pending alarm is saved with the messages so far.
  void finish(double now) override;
  void end(const std::string&) override {}
  bool ended() const override { return false; }
  /// It starts once. The states that it keeps are requested again every half of the kept time.
  std::uint32_t started() const override { return 1; }
  const std::vector<FileReport>& files() const override { return files_; }
  std::uint64_t unwritten() const override { return unwritten_; }
  const std::string& problem() const override { return problem_; }

 private:
  struct Kept {
    Message message;
    double arrived = 0;
  };
  void forget(double now);
  bool fires(const Message& message);
  void save();

  const std::string path_;
  const FileHeader header_;
  const FlightLimits limits_;
  const std::int64_t began_;
  StateKeeper states_;  // as they were before the oldest message kept
  std::deque<Kept> kept_;
  std::size_t bytes_ = 0;
  std::map<std::tuple<std::uint32_t, std::uint32_t, std::uint32_t>, std::uint32_t> occurrences_;
  std::optional<double> save_at_;
  std::string why_;
  std::vector<FileReport> files_;
  std::uint64_t unwritten_ = 0;
  std::string problem_;
};

}  // namespace trunnion::recorder
