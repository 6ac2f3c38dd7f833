// SPDX-License-Identifier: Apache-2.0
// alarms.jsonl of the state directory: which alarms there were.
#pragma once

#include <atomic>
#include <string>

namespace trunnion::gateway {

class AlarmFile {
 public:
  static constexpr const char* name = "alarms.jsonl";

  explicit AlarmFile(std::string path) : path_(std::move(path)) {}
  /// Empty when there is none yet, or when it cannot be read.
  std::string read() const;
  /// Adds lines at the end. Never throws; failed() then says so.
  void append(const std::string& lines);
  /// In place of all lines, whole after a crash. Never throws.
  void replace(const std::string& lines);
  /// Whether the last writing failed. From any thread.
  bool failed() const { return failed_; }

 private:
  const std::string path_;
  std::atomic<bool> failed_ = false;
};

}  // namespace trunnion::gateway
