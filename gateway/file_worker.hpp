// SPDX-License-Identifier: Apache-2.0
// Work with files on a thread of its own at low priority, so that no disk and no large file delays an order.
#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <thread>

namespace trunnion::gateway {

class FileWorker {
 public:
  FileWorker() = default;
  ~FileWorker() { stop(); }
  FileWorker(const FileWorker&) = delete;
  FileWorker& operator=(const FileWorker&) = delete;
  /// Runs `job` after those before it. Nothing after stop().
  void post(std::function<void()> job);
  /// Jobs that have not begun.
  std::size_t waiting() const;
  /// Drops what waits and returns when the job under way has ended.
  void stop();

 private:
  void work();
  mutable std::mutex mutex_;
  std::condition_variable wake_;
  std::deque<std::function<void()>> jobs_;
  bool stopping_ = false;
  std::thread thread_;  ///< started with the first job
};

}  // namespace trunnion::gateway
