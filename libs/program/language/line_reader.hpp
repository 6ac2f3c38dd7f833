// SPDX-License-Identifier: Apache-2.0
// Cuts a text source into lines with a window of fixed size.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "language/text_source.hpp"

namespace trunnion::language {

/// Longest line in bytes, without its line end: beyond the comments with which posts describe a whole set-up,
/// and little enough that a file that is no program is refused at once.
inline constexpr std::size_t max_line_length = 16384;

/// The beginning of a line in a text.
struct TextPosition {
  std::uint64_t offset = 0;
  std::uint32_t line = 1;
};

/// Lines end with CR LF, LF or CR; the last one may end with the text. A byte order mark before the first
/// line is left out.
class LineReader {
 public:
  enum class Status : std::uint8_t { line, end, pending, failed, too_long };

  LineReader();

  /// Forgets what it has read of any source.
  void reset() { source_ = nullptr; }

  /// Continues at `position` of `source`, which must outlive the reading. Bytes already here are not read
  /// again; some of those that were passed stay, so that a loop reads the source once.
  void seek(TextSource& source, TextPosition position);

  /// The next line. After pending, ask again; after failed or too_long the position has not moved. `line` is
  /// valid until the next call of next() or seek().
  Status next(std::string_view& line);

  /// Where the next line begins.
  TextPosition position() const { return {base_ + begin_, line_}; }

 private:
  ReadStatus refill();

  TextSource* source_ = nullptr;
  std::vector<char> buffer_;
  std::size_t chunk_ = 0;   // bytes the next refill asks for
  std::uint64_t base_ = 0;  // offset of buffer_[0] in the source
  std::size_t begin_ = 0;   // the next line
  std::size_t end_ = 0;     // bytes in the buffer
  std::uint32_t line_ = 1;
  bool at_end_ = false;  // the source has nothing behind the buffer
};

}  // namespace trunnion::language
