// SPDX-License-Identifier: Apache-2.0
#include "message_queue.hpp"

#include <algorithm>
#include <chrono>
#include <utility>

namespace trunnion::recorder {
namespace {
// What a message costs beside its bytes, so that a flood of small ones is bounded too.
constexpr std::size_t queued_overhead = sizeof(Message) + 32;
}  // namespace

bool MessageQueue::push(Message& message) {
  const std::lock_guard lock(mutex_);
  const std::size_t size = message.cdr.size() + queued_overhead;
  if (closed_ || bytes_ + taken_ + size > most_bytes_) {
    ++dropped_;
    return false;
  }
  bytes_ += size;
  most_used_ = std::max(most_used_, bytes_ + taken_);
  std::vector<std::uint8_t> buffer;
  if (!buffers_.empty()) {
    buffer = std::move(buffers_.back());
    buffers_.pop_back();
  }
  messages_.push_back(
      {message.topic, message.sequence, message.source_time, std::exchange(message.cdr, std::move(buffer))});
  return true;
}

bool MessageQueue::pop_all(std::vector<Message>& messages, double seconds) {
  std::unique_lock lock(mutex_);
  for (auto& used : messages)
    if (buffers_.size() < most_buffers) buffers_.push_back(std::move(used.cdr));
  messages.clear();
  taken_ = 0;
  arrived_.wait_for(lock, std::chrono::duration<double>(seconds),
                    [this] { return closed_ || !messages_.empty(); });
  messages.swap(messages_);
  taken_ = std::exchange(bytes_, 0);
  return !messages.empty() || !closed_;
}

void MessageQueue::close() {
  {
    const std::lock_guard lock(mutex_);
    closed_ = true;
  }
  arrived_.notify_one();
}

std::uint64_t MessageQueue::dropped() const {
  const std::lock_guard lock(mutex_);
  return dropped_;
}

bool MessageQueue::crowded() const {
  const std::lock_guard lock(mutex_);
  return bytes_ + taken_ > most_bytes_ / 2;
}

std::size_t MessageQueue::most_used() const {
  const std::lock_guard lock(mutex_);
  return most_used_;
}

}  // namespace trunnion::recorder
