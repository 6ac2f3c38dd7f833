// Keeps the last seconds in memory and writes them to a file when an alarm fires.
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
  double before = 30;             ///< s kept, and so saved from before the alarm
  double after = 1;               ///< s of what follows it
  std::size_t bytes = 256 << 20;  ///< that may be kept; when it is less than `before`, the oldest go
  idl::service::Severity severity = idl::service::Severity::WARNING;  ///< the least that saves
};

/// Files are `path` numbered from the next free number on; each begins with the states that held then.
/// Alarms while another is being followed are in its file. A problem with one file does not end the watch.
class FlightRecorder final : public Destination {
 public:
  /// Alarms the bus keeps from before `began` (ns since the epoch) are not news.
  FlightRecorder(std::string path, FileHeader header, FlightLimits limits, std::int64_t began);

  void take(Message& message, double now) override;
  void idle(double now) override;
  /// An alarm that is still being followed is saved with what there is.
  void finish(double now) override;
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
