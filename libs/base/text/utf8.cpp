// SPDX-License-Identifier: Apache-2.0
#include "text/utf8.hpp"

#include <cctype>
#include <cstdint>
#include <cstring>

namespace trunnion::text {
namespace {

constexpr std::uint64_t high_bits = 0x8080808080808080ull;

std::size_t ascii_prefix(std::string_view text, std::size_t from) {
  std::size_t i = from;
  for (; i + 8 <= text.size(); i += 8) {
    std::uint64_t chunk = 0;
    std::memcpy(&chunk, text.data() + i, 8);
    if ((chunk & high_bits) != 0) break;
  }
  while (i < text.size() && static_cast<unsigned char>(text[i]) < 0x80) ++i;
  return i;
}

/// Length of the well-formed sequence that begins at `i` with a byte >= 0x80, or 0.
std::size_t sequence_length(std::string_view text, std::size_t i) {
  const auto byte = [&](std::size_t k) -> unsigned {
    return i + k < text.size() ? static_cast<unsigned char>(text[i + k]) : 0u;
  };
  const auto continuation = [&](std::size_t k) { return (byte(k) & 0xc0u) == 0x80u; };
  const unsigned first = byte(0);
  if (first >= 0xc2 && first <= 0xdf) return continuation(1) ? 2 : 0;
  if (first >= 0xe0 && first <= 0xef) {
    // E0 excludes overlong forms, ED the surrogates.
    const bool second =
        byte(1) >= (first == 0xe0 ? 0xa0u : 0x80u) && byte(1) <= (first == 0xed ? 0x9fu : 0xbfu);
    return second && continuation(2) ? 3 : 0;
  }
  if (first >= 0xf0 && first <= 0xf4) {
    const bool second =
        byte(1) >= (first == 0xf0 ? 0x90u : 0x80u) && byte(1) <= (first == 0xf4 ? 0x8fu : 0xbfu);
    return second && continuation(2) && continuation(3) ? 4 : 0;
  }
  return 0;
}

}  // namespace

std::size_t valid_utf8_prefix(std::string_view text) {
  std::size_t i = ascii_prefix(text, 0);
  while (i < text.size()) {
    const std::size_t length = sequence_length(text, i);
    if (length == 0) break;
    i = ascii_prefix(text, i + length);
  }
  return i;
}

std::string shortened(std::string text, std::size_t most) {
  constexpr std::string_view mark = " ...";
  if (text.size() <= most) return text;
  std::size_t end = most - mark.size();
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xc0u) == 0x80u) --end;
  while (end > 0 && text[end - 1] == ' ') --end;
  text.replace(end, std::string::npos, mark);
  return text;
}

std::string lower_case(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

}  // namespace trunnion::text
