// SPDX-License-Identifier: Apache-2.0
// A recording in one file, or in parts that are each a whole recording.
#pragma once

#include <deque>
#include <memory>

#include "destination.hpp"
#include "recording_file.hpp"
#include "state_keeper.hpp"

namespace trunnion::recorder {

struct PartLimits {
  std::uint64_t bytes = 0;  ///< a part ends when its file is as large, 0 = never
  double seconds = 0;       ///< or as old, 0 = never
  std::uint32_t keep = 0;   ///< parts that stay on the disk, 0 = all
  bool any() const { return bytes != 0 || seconds > 0; }
};

/// Without limits everything goes into the one file `path`; with limits into `path` numbered from the next
/// free number on. Every part but the first begins with the states that hold then.
class PartFiles final : public Destination {
 public:
  /// Creates the first file: throws std::runtime_error naming it and the reason.
  PartFiles(std::string path, FileHeader header, PartLimits limits, double now);

  void take(Message& message, double now) override;
  void idle(double now) override;
  void finish(double now) override;
  void end(const std::string& why) override;
  bool ended() const override { return !problem_.empty(); }
  std::uint32_t started() const override { return started_; }
  const std::vector<FileReport>& files() const override { return files_; }
  std::uint64_t unwritten() const override { return unwritten_; }
  const std::string& problem() const override { return problem_; }

 private:
  void begin_part(double now);
  void end_part();
  void write(const Message& message);
  void note_problem();

  const std::string path_;
  const FileHeader header_;
  const PartLimits limits_;
  StateKeeper states_;
  std::unique_ptr<RecordingFile> file_;
  std::uint32_t number_ = 0, started_ = 0;
  double began_ = 0, flushed_ = 0;
  std::vector<FileReport> files_;
  std::uint64_t unwritten_ = 0;
  std::string problem_;
};

}  // namespace trunnion::recorder
