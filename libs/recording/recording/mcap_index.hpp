// SPDX-License-Identifier: Apache-2.0
// The summary at the end of a whole recording: where its chunks are, and its topics once more.
#pragma once

#include <map>
#include <vector>

#include "recording/mcap_format.hpp"

namespace trunnion::recording {

struct ChunkPlace {
  std::uint64_t offset = 0, length = 0;  ///< bytes, of the record
  std::uint64_t index_length = 0;        ///< bytes, of the message indexes behind it
  std::uint64_t first_time = 0, last_time = 0;
  std::uint64_t end() const { return offset + length + index_length; }
};

struct McapIndex {
  enum class State {
    missing,  ///< the file does not end as a whole one
    damaged,  ///< it does, and its summary contradicts itself or its checksum
    none,     ///< it was written without one, or with one beyond the limit
    known
  };
  State state = State::missing;
  std::uint64_t summary = 0;       ///< where it begins: the end of the data
  std::vector<ChunkPlace> chunks;  ///< ascending; none overlaps the next
  std::map<std::uint16_t, Schema> schemas;
  std::map<std::uint16_t, Channel> channels;
};

/// Trusts no length, and needs less than `largest_record` bytes.
McapIndex read_index(Source& source, std::uint64_t largest_record);

}  // namespace trunnion::recording
