// SPDX-License-Identifier: Apache-2.0
// Keeps the newest record on disk, beside the thread that moves the axes: a disk may take a tenth of a
// second.
#pragma once

#include <condition_variable>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

namespace trunnion::channel {

class RecordKeeper {
 public:
  /// `file` is a kept text: a crash at any instant leaves the record before or the new one.
  explicit RecordKeeper(std::string file);
  /// Writes what was put last.
  ~RecordKeeper();
  RecordKeeper(const RecordKeeper&) = delete;
  RecordKeeper& operator=(const RecordKeeper&) = delete;

  /// Never waits for the disk. A record that is put while another is written replaces the ones before it.
  void put(std::string record);
  /// What went wrong with the newest write, or empty.
  std::string error();

 private:
  void write_on();
  std::string file_;
  std::mutex mutex_;
  std::condition_variable news_;
  std::optional<std::string> wanted_;
  std::string error_;
  bool ending_ = false;
  std::thread thread_;
};

}  // namespace trunnion::channel
