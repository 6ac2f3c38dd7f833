// SPDX-License-Identifier: Apache-2.0
// Between the thread that empties the readers and the one that writes the file: bounded; push() never waits.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <vector>

namespace trunnion::recorder {

/// One sample for the file.
struct Message {
  std::uint16_t topic = 0;       ///< channel number of the recording
  std::uint32_t sequence = 0;    ///< of the topic, from 1
  std::int64_t source_time = 0;  ///< ns since the epoch
  std::vector<std::uint8_t> cdr;
};

class MessageQueue {
 public:
  explicit MessageQueue(std::size_t most_bytes) : most_bytes_(most_bytes) {}

  /// Takes the message's bytes and leaves a used buffer in their place. False, and nothing taken, when the
  /// queue is full: the message is counted as dropped.
  bool push(Message& message);
  /// Lets pop_all() return. Once for all that was pushed: a wake-up for each would cost more than the
  /// messages.
  void wake() { arrived_.notify_one(); }
  /// Everything queued, waiting up to `seconds` for messages; the buffers of `messages` are used again. False
  /// when the queue was closed and is empty.
  bool pop_all(std::vector<Message>& messages, double seconds);
  /// Nothing more will be pushed.
  void close();

  std::uint64_t dropped() const;
  /// More than half of the bound is in use: the disk is slower than the stream.
  bool crowded() const;
  std::size_t most_used() const;  ///< bytes

 private:
  static constexpr std::size_t most_buffers = 4096;
  const std::size_t most_bytes_;
  mutable std::mutex mutex_;
  std::condition_variable arrived_;
  std::vector<Message> messages_;
  std::vector<std::vector<std::uint8_t>> buffers_;
  std::size_t bytes_ = 0, taken_ = 0, most_used_ = 0;  // queued, at the other thread, and together at most
  std::uint64_t dropped_ = 0;
  bool closed_ = false;
};

}  // namespace trunnion::recorder
