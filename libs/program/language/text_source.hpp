// SPDX-License-Identifier: Apache-2.0
// Where program text comes from: a file's revision over the bus in chunks, or a line typed by the operator.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <string_view>

namespace trunnion::language {

enum class ReadStatus : std::uint8_t {
  bytes,    ///< size > 0 bytes are in the buffer
  end,      ///< there is nothing at this offset and never will be
  pending,  ///< the bytes have not arrived yet: ask again
  failed,   ///< the text cannot be had
};

struct ReadResult {
  ReadStatus status = ReadStatus::end;
  std::size_t size = 0;
};

/// A text that does not change while it is interpreted. It may be read more than once and in any order.
class TextSource {
 public:
  virtual ~TextSource() = default;
  /// Copies at most `capacity` (> 0) bytes from `offset` on into `buffer`.
  virtual ReadResult read(std::uint64_t offset, char* buffer, std::size_t capacity) = 0;
};

/// A text in memory that its user keeps alive: MDI lines, tests.
class StringSource final : public TextSource {
 public:
  explicit StringSource(std::string_view text) : text_(text) {}
  ReadResult read(std::uint64_t offset, char* buffer, std::size_t capacity) override {
    if (offset >= text_.size()) return {ReadStatus::end, 0};
    const std::size_t size = std::min<std::size_t>(capacity, text_.size() - offset);
    std::memcpy(buffer, text_.data() + offset, size);
    return {ReadStatus::bytes, size};
  }

 private:
  std::string_view text_;
};

}  // namespace trunnion::language
