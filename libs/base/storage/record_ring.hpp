// SPDX-License-Identifier: Apache-2.0
// Records in memory that several processes have mapped: one writes, others read.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <span>
#include <vector>

namespace trunnion::storage {

/// The writer never waits: it overwrites the oldest records. Memory that is all zero is an empty ring. A
/// reader only reads, so any number of them may be there, and none is known to the writer.
template <std::uint64_t capacity>
class RecordRing {
 public:
  enum class Read { nothing, record, overwritten };
  struct Header {
    std::uint32_t length = 0;  ///< bytes that follow
    std::uint32_t number = 0;  ///< counts all records, so that a reader sees how many it has missed
    std::int64_t stamp = 0;    ///< what the writer gave with it
  };

  /// False, and nothing written, when the record does not fit into the whole ring.
  bool write(std::int64_t stamp, std::span<const std::uint8_t> bytes) {
    const std::uint64_t at = written_.load(std::memory_order_relaxed);
    const std::uint64_t size = sizeof(Header) + bytes.size();
    if (size > capacity) return false;
    make_room(at, at + size);
    const Header header{static_cast<std::uint32_t>(bytes.size()), number_++, stamp};
    put(at, &header, sizeof header);
    put(at + sizeof header, bytes.data(), bytes.size());
    written_.store(at + size, std::memory_order_release);
    return true;
  }

  /// Places to begin reading at: the oldest record there is, and the next one to be written.
  std::uint64_t oldest() const { return oldest_.load(std::memory_order_acquire); }
  std::uint64_t end() const { return written_.load(std::memory_order_acquire); }

  /// The record at `at`, which then is the place of the next one. When it is overwritten, `at` stays. No
  /// length is trusted.
  Read read(std::uint64_t& at, Header& header, std::vector<std::uint8_t>& bytes) const {
    const std::uint64_t written = end();
    if (at == written) return Read::nothing;
    get(at, &header, sizeof header);
    const std::uint64_t room = written - at;
    if (gone(at) || room > capacity || room < sizeof header || room - sizeof header < header.length)
      return Read::overwritten;
    bytes.resize(header.length);
    get(at + sizeof header, bytes.data(), header.length);
    if (gone(at)) return Read::overwritten;
    at += sizeof header + header.length;
    return Read::record;
  }

 private:
  // Marks records as gone before it overwrites them.
  void make_room(std::uint64_t written, std::uint64_t end) {
    std::uint64_t oldest = oldest_.load(std::memory_order_relaxed);
    if (written - oldest > capacity) oldest = written;  // the memory was no ring
    while (end - oldest > capacity && oldest < written) {
      Header header;
      get(oldest, &header, sizeof header);
      oldest = std::min(written, oldest + sizeof header + header.length);
    }
    oldest_.store(oldest, std::memory_order_relaxed);
    std::atomic_thread_fence(std::memory_order_seq_cst);
  }
  bool gone(std::uint64_t at) const {
    std::atomic_thread_fence(std::memory_order_seq_cst);
    return oldest_.load(std::memory_order_relaxed) > at;
  }

  void put(std::uint64_t at, const void* data, std::size_t size) {
    const auto* source = static_cast<const std::uint8_t*>(data);
    const auto from = at % capacity, first = std::min<std::uint64_t>(size, capacity - from);
    std::copy_n(source, first, bytes_ + from);
    std::copy_n(source + first, size - first, bytes_);
  }
  void get(std::uint64_t at, void* data, std::size_t size) const {
    auto* target = static_cast<std::uint8_t*>(data);
    const auto from = at % capacity, first = std::min<std::uint64_t>(size, capacity - from);
    std::copy_n(bytes_ + from, first, target);
    std::copy_n(bytes_, size - first, target + first);
  }

  static_assert(std::atomic<std::uint64_t>::is_always_lock_free);
  // Both count bytes since the ring was made.
  std::atomic<std::uint64_t> oldest_, written_;
  std::uint32_t number_;
  std::uint8_t bytes_[capacity];
};

}  // namespace trunnion::storage
