// SPDX-License-Identifier: Apache-2.0
#include "core/worker.hpp"

#include <pthread.h>
#include <sys/resource.h>
#include <unistd.h>

#include <limits>

namespace trunnion::gateway {

bool Worker::offer(std::function<void()> job) { return add(std::move(job), most_); }

void Worker::post(std::function<void()> job) { add(std::move(job), std::numeric_limits<std::size_t>::max()); }

bool Worker::add(std::function<void()> job, std::size_t most) {
  const std::lock_guard lock(mutex_);
  if (stopping_ || jobs_.size() >= most) return false;
  jobs_.push_back(std::move(job));
  if (!thread_.joinable()) thread_ = std::thread([this] { work(); });
  wake_.notify_one();
  return true;
}

void Worker::stop() {
  std::deque<std::function<void()>> dropped;
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
    std::swap(dropped, jobs_);
  }
  wake_.notify_one();
  if (thread_.joinable()) thread_.join();
}

void Worker::work() {
  pthread_setname_np(pthread_self(), name_.c_str());
  // Without the permission it is as any other thread.
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
