// SPDX-License-Identifier: Apache-2.0
#include "file_worker.hpp"

#include <sys/resource.h>
#include <unistd.h>

namespace trunnion::gateway {

void FileWorker::post(std::function<void()> job) {
  const std::lock_guard lock(mutex_);
  if (stopping_) return;
  jobs_.push_back(std::move(job));
  if (!thread_.joinable()) thread_ = std::thread([this] { work(); });
  wake_.notify_one();
}

std::size_t FileWorker::waiting() const {
  const std::lock_guard lock(mutex_);
  return jobs_.size();
}

void FileWorker::stop() {
  std::deque<std::function<void()>> dropped;
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
    std::swap(dropped, jobs_);
  }
  wake_.notify_one();
  if (thread_.joinable()) thread_.join();
}

void FileWorker::work() {
  setpriority(PRIO_PROCESS, static_cast<id_t>(gettid()), 10);
  for (;;) {
    std::function<void()> job;
    {
      std::unique_lock lock(mutex_);
      wake_.wait(lock, [this] { return stopping_ || !jobs_.empty(); });
      if (stopping_) return;
      job = std::move(jobs_.front());
      jobs_.pop_front();
    }
    job();
  }
}

}  // namespace trunnion::gateway
