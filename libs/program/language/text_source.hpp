// SPDX-License-Identifier: Apache-2.0
// Where program text comes from: a file's revision over the bus in chunks, or a line typed by the operator.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string_view>

#include "canonical/program_dialect.hpp"

namespace trunnion::language {

using canonical::ProgramDialect;

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
  /// Of the stored program; empty when the text is none.
  virtual std::string_view name() const { return {}; }
  /// That of a text which has the same on every machine; nothing: its name or the channel decides.
  virtual std::optional<ProgramDialect> dialect() const { return std::nullopt; }
};

/// A text in memory that its user keeps alive, as its name: MDI lines, macros of the control, tests.
class StringSource final : public TextSource {
 public:
  explicit StringSource(std::string_view text, std::string_view name = {},
                        std::optional<ProgramDialect> dialect = std::nullopt)
      : text_(text), name_(name), dialect_(dialect) {}
  std::string_view name() const override { return name_; }
  std::optional<ProgramDialect> dialect() const override { return dialect_; }
  ReadResult read(std::uint64_t offset, char* buffer, std::size_t capacity) override {
    if (offset >= text_.size()) return {ReadStatus::end, 0};
    const std::size_t size = std::min<std::size_t>(capacity, text_.size() - offset);
    std::memcpy(buffer, text_.data() + offset, size);
    return {ReadStatus::bytes, size};
  }

 private:
  std::string_view text_, name_;
  std::optional<ProgramDialect> dialect_;
};

}  // namespace trunnion::language
