// SPDX-License-Identifier: Apache-2.0
#include "text/utf8.hpp"

#include <algorithm>
#include <array>
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

/// The characters 80 to 9f of Windows-1252 in Unicode; 0: it has none.
constexpr std::array<std::uint16_t, 32> windows_1252 = {
    0x20ac, 0,      0x201a, 0x0192, 0x201e, 0x2026, 0x2020, 0x2021, 0x02c6, 0x2030, 0x0160,
    0x2039, 0x0152, 0,      0x017d, 0,      0,      0x2018, 0x2019, 0x201c, 0x201d, 0x2022,
    0x2013, 0x2014, 0x02dc, 0x2122, 0x0161, 0x203a, 0x0153, 0,      0x017e, 0x0178};

struct Character {
  std::array<char, 4> bytes{'?'};
  std::size_t size = 1;
};

/// Of a byte from 0x80.
Character old_character(unsigned char byte) {
  Character character;
  const unsigned code = byte >= 0xa0 ? byte : windows_1252[byte - 0x80u];
  const auto low = static_cast<char>(0x80u | (code & 0x3fu));
  if (code >= 0x800) {
    character.bytes = {static_cast<char>(0xe0u | (code >> 12)),
                       static_cast<char>(0x80u | ((code >> 6) & 0x3fu)), low};
    character.size = 3;
  } else if (code != 0) {
    character.bytes = {static_cast<char>(0xc0u | (code >> 6)), low};
    character.size = 2;
  }
  return character;
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

std::size_t character_count(std::string_view text) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < text.size(); ++count) {
    const bool ascii = static_cast<unsigned char>(text[i]) < 0x80;
    i += ascii ? 1 : std::max<std::size_t>(sequence_length(text, i), 1);
  }
  return count;
}

std::size_t copy_readable(std::string_view text, std::span<char> out) {
  std::size_t size = 0;
  for (std::size_t i = 0; i < text.size();) {
    const auto first = static_cast<unsigned char>(text[i]);
    const std::size_t length = first < 0x80 ? 1 : sequence_length(text, i);
    Character shown;
    if (length == 0) {
      shown = old_character(first);
    } else if (first >= 0x20 && first != 0x7f) {
      std::copy_n(text.begin() + static_cast<std::ptrdiff_t>(i), length, shown.bytes.begin());
      shown.size = length;
    }
    if (size + shown.size > out.size()) break;
    std::copy_n(shown.bytes.begin(), shown.size, out.begin() + static_cast<std::ptrdiff_t>(size));
    size += shown.size;
    i += std::max<std::size_t>(length, 1);
  }
  return size;
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
