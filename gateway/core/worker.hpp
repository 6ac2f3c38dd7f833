// SPDX-License-Identifier: Apache-2.0
// Work on a thread of its own at low priority, so that no disk, no large body and no large answer delays an
// order.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <functional>
#include <mutex>
#include <string>
#include <thread>

namespace trunnion::gateway {

class Worker {
 public:
  /// Requests that may wait: their connections may be gone already.
  static constexpr std::size_t most_waiting = 256;

  /// `name` of the thread, as other programs show it: at most 15 characters.
  explicit Worker(std::string name, std::size_t most = most_waiting) : name_(std::move(name)), most_(most) {}
  ~Worker() { stop(); }
  Worker(const Worker&) = delete;
  Worker& operator=(const Worker&) = delete;
  /// Runs the job of a request after those before it. False when too many wait, and after stop().
  [[nodiscard]] bool offer(std::function<void()> job);
  /// The same for what must not be refused: a part of a request that was taken, or of the gateway itself.
  void post(std::function<void()> job);
  /// Drops what waits and returns when the job under way has ended.
  void stop();

 private:
  bool add(std::function<void()> job, std::size_t most);
  void work();
  const std::string name_;
  const std::size_t most_;
  std::mutex mutex_;
  std::condition_variable wake_;
  std::deque<std::function<void()>> jobs_;
  bool stopping_ = false;
  std::thread thread_;  ///< started with the first job
};

}  // namespace trunnion::gateway
