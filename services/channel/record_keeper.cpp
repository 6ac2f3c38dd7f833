// SPDX-License-Identifier: Apache-2.0
#include "record_keeper.hpp"

#include <utility>

#include "storage/file.hpp"
#include "storage/kept_file.hpp"

namespace trunnion::channel {

RecordKeeper::RecordKeeper(std::string file) : file_(std::move(file)), thread_([this] { write_on(); }) {}

RecordKeeper::~RecordKeeper() {
  {
    const std::lock_guard lock(mutex_);
    ending_ = true;
  }
  news_.notify_one();
  thread_.join();
}

void RecordKeeper::put(std::string record) {
  {
    const std::lock_guard lock(mutex_);
    wanted_ = std::move(record);
  }
  news_.notify_one();
}

std::string RecordKeeper::error() {
  const std::lock_guard lock(mutex_);
  return error_;
}

void RecordKeeper::write_on() {
  std::unique_lock lock(mutex_);
  for (;;) {
    news_.wait(lock, [this] { return wanted_ || ending_; });
    if (!wanted_) return;
    const auto record = std::exchange(wanted_, std::nullopt);
    lock.unlock();
    std::string error;
    try {
      storage::write_kept(file_, *record);
    } catch (const storage::StorageError& e) {
      error = e.what();
    }
    lock.lock();
    error_ = error;
  }
}

}  // namespace trunnion::channel
