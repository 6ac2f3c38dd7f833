// SPDX-License-Identifier: Apache-2.0
#include "language/line_reader.hpp"

#include <algorithm>
#include <cstring>

namespace trunnion::language {
namespace {

// A line that is not complete, what was passed before it, and room for the next bytes.
constexpr std::size_t history = 16384;
constexpr std::size_t most_at_once = 32768;
constexpr std::size_t window = history + max_line_length + most_at_once;
// A jump to another place reads little at first: a short subprogram is soon left again.
constexpr std::size_t least_at_once = 2048;

std::size_t find(const char* begin, std::size_t size, char c) {
  const void* const at = size == 0 ? nullptr : std::memchr(begin, c, size);
  return at == nullptr ? size : static_cast<std::size_t>(static_cast<const char*>(at) - begin);
}

}  // namespace

LineReader::LineReader() : buffer_(window) {}

void LineReader::seek(TextSource& source, TextPosition position) {
  line_ = position.line;
  if (source_ == &source && position.offset >= base_ && position.offset - base_ <= end_) {
    begin_ = static_cast<std::size_t>(position.offset - base_);
    return;
  }
  source_ = &source;
  base_ = position.offset;
  begin_ = end_ = 0;
  chunk_ = least_at_once;
  at_end_ = false;
}

ReadStatus LineReader::refill() {
  if (buffer_.size() - end_ < chunk_ && begin_ > history) {
    const std::size_t drop = begin_ - history;
    std::memmove(buffer_.data(), buffer_.data() + drop, end_ - drop);
    base_ += drop;
    end_ -= drop;
    begin_ -= drop;
  }
  const std::size_t asked = std::min(chunk_, buffer_.size() - end_);
  chunk_ = std::min(2 * chunk_, most_at_once);
  const ReadResult result = source_->read(base_ + end_, buffer_.data() + end_, asked);
  // No bytes are no progress: asking again at once could be endless.
  if (result.status == ReadStatus::bytes && result.size == 0) return ReadStatus::pending;
  if (result.status == ReadStatus::bytes) end_ += std::min(result.size, asked);
  if (result.status == ReadStatus::end) at_end_ = true;
  return result.status;
}

LineReader::Status LineReader::next(std::string_view& line) {
  for (;;) {
    const char* const start = buffer_.data() + begin_;
    // One byte more than a line may have, so that a longer one is seen.
    const std::size_t searched = std::min(end_ - begin_, max_line_length + 1);
    const std::size_t size = find(start, find(start, searched, '\n'), '\r');
    const bool terminated = size < searched;
    // A CR needs the byte behind it: CR LF is one line end.
    const bool lone_cr_unsure = terminated && start[size] == '\r' && begin_ + size + 1 == end_ && !at_end_;
    if (!terminated && searched > max_line_length) return Status::too_long;
    if (at_end_ && !terminated && searched == 0) return Status::end;
    if ((terminated && !lone_cr_unsure) || at_end_) {
      line = {start, size};
      std::size_t consumed = size;
      if (terminated) {
        const bool crlf = start[size] == '\r' && begin_ + size + 1 < end_ && start[size + 1] == '\n';
        consumed += crlf ? 2 : 1;
      }
      constexpr std::string_view byte_order_mark = "\xef\xbb\xbf";
      if (base_ + begin_ == 0 && line.starts_with(byte_order_mark))
        line.remove_prefix(byte_order_mark.size());
      begin_ += consumed;
      ++line_;
      return Status::line;
    }
    switch (refill()) {
      case ReadStatus::pending:
        return Status::pending;
      case ReadStatus::failed:
        return Status::failed;
      case ReadStatus::bytes:
      case ReadStatus::end:
        break;
    }
  }
}

}  // namespace trunnion::language
