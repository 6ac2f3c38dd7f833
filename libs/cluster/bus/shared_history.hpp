// SPDX-License-Identifier: Apache-2.0
// The newest messages of a writer in memory, where a recorder on the same host reads them. To send every
// batch once more by DDS cost the stream 7 % of its speed on Fast DDS; this costs the writer a copy.
#pragma once

#include <memory>
#include <string>

#include "bus/endpoint.hpp"

namespace trunnion::bus {

struct SharedMemory;

/// The writer's side. Nobody who reads is known to it, and nothing is left of it when its process ends; who
/// has it open by then still reads what is in it.
class SharedHistory {
 public:
  /// Bytes. As many batches as the DDS writer of a long lead keeps, a thousand of four kilobytes.
  static constexpr std::uint64_t capacity = std::uint64_t{4} << 20;

  /// Null when the system gives no memory for it.
  static std::unique_ptr<SharedHistory> make();
  ~SharedHistory();
  SharedHistory(const SharedHistory&) = delete;
  SharedHistory& operator=(const SharedHistory&) = delete;

  /// Where it is: the DDS writer's user data, by which a recorder finds it.
  const std::string& address() const { return address_; }
  /// Neither waits nor allocates. `source_time` as in SampleInfo.
  void write(std::int64_t source_time, std::span<const std::uint8_t> cdr);

 private:
  SharedHistory() = default;
  int file_ = -1;
  SharedMemory* memory_ = nullptr;
  std::string address_;
};

/// The reader's side; it changes nothing in that memory and trusts nothing that it finds there.
class SharedHistoryReader {
 public:
  enum class Place {
    here,       ///< it can be read
    gone,       ///< it was on this host, and its writer is no more
    elsewhere,  ///< on another host, of another user, or `address` is none: what it has comes by DDS alone
  };
  struct Found;
  static Found find(const std::string& address);
  ~SharedHistoryReader();
  SharedHistoryReader(const SharedHistoryReader&) = delete;
  SharedHistoryReader& operator=(const SharedHistoryReader&) = delete;

  /// The next message, beginning with the oldest there was when it was found; false when there is none yet.
  bool take(Bytes& cdr, SampleInfo& info);
  /// Messages that were overwritten before they were taken.
  std::uint64_t lost() const { return lost_; }

 private:
  SharedHistoryReader(const SharedMemory* memory);
  const SharedMemory* memory_;
  std::uint64_t at_;
  std::uint32_t next_ = 0;  // number of the message expected
  bool counting_;           // it is known
  std::uint64_t lost_ = 0;
};

struct SharedHistoryReader::Found {
  Place place = Place::elsewhere;
  std::unique_ptr<SharedHistoryReader> reader;  ///< when it is here
};

}  // namespace trunnion::bus
