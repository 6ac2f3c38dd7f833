// SPDX-License-Identifier: Apache-2.0
// A stored program as a text source: fetched in chunks, a few of them kept.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "contracts/types.hpp"
#include "language/text_source.hpp"

namespace trunnion::channel {

/// What has to be fetched next.
struct ChunkWanted {
  std::string name;
  std::uint64_t revision = 0;
  std::uint64_t offset = 0;
};

/// The interpreter reads; who owns the bus asks wanted(), fetches and delivers. Memory does not grow with the
/// program.
class ProgramText : public language::TextSource {
 public:
  static constexpr std::size_t chunk_size = 32768;

  explicit ProgramText(const idl::program::ProgramEntry& program)
      : name_(program.name), revision_(program.revision), size_(program.size), role_(program.role) {}

  language::ReadResult read(std::uint64_t offset, char* buffer, std::size_t capacity) override;

  /// The chunk the interpreter waits for, else the one after the newest it read: nothing when all of that is
  /// here.
  std::optional<ChunkWanted> wanted() const;
  void deliver(std::uint64_t offset, std::vector<std::uint8_t> data);
  void fail() { failed_ = true; }
  std::string_view name() const override { return name_; }
  /// Of ProgramEntry.
  std::uint8_t role() const { return role_; }

 private:
  struct Chunk {
    std::uint64_t index = ~0ull;
    std::vector<std::uint8_t> data;
  };
  const Chunk* find(std::uint64_t index) const {
    return chunks_[index % chunks_.size()].index == index ? &chunks_[index % chunks_.size()] : nullptr;
  }
  std::string name_;
  std::uint64_t revision_, size_;
  std::uint8_t role_;
  std::array<Chunk, 4> chunks_;
  std::optional<std::uint64_t> missing_;
  std::uint64_t newest_ = 0;
  bool failed_ = false;
};

}  // namespace trunnion::channel
