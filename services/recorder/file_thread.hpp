// SPDX-License-Identifier: Apache-2.0
// The thread that compresses and writes. It derives the figures of the stream from the bytes it writes, and
// watches the disk.
#pragma once

#include <atomic>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

#include "destination.hpp"
#include "message_queue.hpp"
#include "recording/stream_tally.hpp"
#include "service.hpp"
#include "space_watch.hpp"

namespace trunnion::recorder {

class FileThread {
 public:
  FileThread(const Options& options, const FileHeader& header, MessageQueue& queue);
  ~FileThread() { join(); }
  FileThread(const FileThread&) = delete;
  FileThread& operator=(const FileThread&) = delete;

  void join();
  /// After join().
  const recording::StreamTally& tally() const { return tally_; }
  const Destination& destination() const { return *destination_; }
  /// Of the destination, so far.
  std::uint32_t started() const { return started_; }
  bool ended() const { return ended_; }
  /// What the disk has shown since the last call.
  std::vector<SpaceWatch::Finding> take_findings();

 private:
  void run();
  void watch_space(double now);
  void report_files();

  const bool json_;
  const std::string path_;
  const std::vector<const bus::TopicEntry*>& topics_;
  MessageQueue& queue_;
  std::unique_ptr<Destination> destination_;
  SpaceWatch watch_;
  recording::StreamTally tally_;
  std::size_t reported_files_ = 0;
  bool reported_ = false;
  std::atomic<std::uint32_t> started_{1};
  std::atomic<bool> ended_{false};
  std::mutex mutex_;
  std::vector<SpaceWatch::Finding> findings_;
  std::thread thread_;
};

}  // namespace trunnion::recorder
