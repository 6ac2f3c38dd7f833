// SPDX-License-Identifier: Apache-2.0
#include "program_text.hpp"

namespace trunnion::channel {

language::ReadResult ProgramText::read(std::uint64_t offset, char* buffer, std::size_t capacity) {
  if (failed_) return {language::ReadStatus::failed, 0};
  if (offset >= size_) return {language::ReadStatus::end, 0};
  const std::uint64_t index = offset / chunk_size;
  const auto* chunk = find(index);
  const std::size_t at = offset % chunk_size;
  if (chunk == nullptr) {
    missing_ = index;
    return {language::ReadStatus::pending, 0};
  }
  newest_ = index;
  if (at >= chunk->data.size()) return {language::ReadStatus::failed, 0};  // shorter than its entry says
  const std::size_t size = std::min(capacity, chunk->data.size() - at);
  std::memcpy(buffer, chunk->data.data() + at, size);
  return {language::ReadStatus::bytes, size};
}

std::optional<ChunkWanted> ProgramText::wanted() const {
  if (failed_) return std::nullopt;
  if (missing_) return ChunkWanted{name_, revision_, *missing_ * chunk_size};
  const std::uint64_t next = newest_ + 1;
  if (next * chunk_size >= size_ || find(next) != nullptr) return std::nullopt;
  return ChunkWanted{name_, revision_, next * chunk_size};
}

void ProgramText::deliver(std::uint64_t offset, std::vector<std::uint8_t> data) {
  const std::uint64_t index = offset / chunk_size;
  auto& chunk = chunks_[index % chunks_.size()];
  chunk.index = index;
  chunk.data = std::move(data);
  if (missing_ == index) missing_.reset();
}

}  // namespace trunnion::channel
