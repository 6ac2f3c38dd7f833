// SPDX-License-Identifier: Apache-2.0
#include "plc/machine/strings.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstring>
#include <string_view>

#include "plc/machine/arithmetic.hpp"
#include "text/utf8.hpp"

namespace trunnion::st {
namespace {

using Text = std::string_view;

bool read(std::span<const std::uint64_t> memory, std::uint64_t address, Text& text) {
  if (address >= memory.size()) return false;
  const auto length = std::min<std::uint64_t>(memory[address], longest_string);
  if (address + string_cells(static_cast<std::uint32_t>(length)) > memory.size()) return false;
  text = Text(reinterpret_cast<const char*>(memory.data() + address + 1), length);
  return true;
}

/// A result in the making: it may overlap the arguments.
class Buffer {
 public:
  void add(Text text) {
    const auto count = std::min(text.size(), bytes_.size() - size_);
    if (count == 0) return;
    std::memcpy(bytes_.data() + size_, text.data(), count);
    size_ += count;
  }
  char* data() { return bytes_.data(); }
  char* end() { return bytes_.data() + bytes_.size(); }
  void resize(const char* last) { size_ = static_cast<std::size_t>(last - bytes_.data()); }
  Text text() const { return {bytes_.data(), size_}; }

 private:
  std::array<char, longest_string> bytes_;
  std::size_t size_ = 0;
};

/// What positions of a text mean.
class Parts {
 public:
  explicit Parts(bool wide) : wide_(wide) {}
  std::int64_t size(Text text) const {
    return static_cast<std::int64_t>(wide_ ? characters(text) : text.size());
  }
  /// From position `from` (1 is the first) `count` bytes or characters, as far as there are.
  Text part(Text text, std::int64_t from, std::int64_t count) const {
    if (count <= 0 || from > size(text)) return {};
    if (from < 1) from = 1;
    const auto behind = text.substr(bytes(text, from - 1));
    return behind.substr(0, bytes(behind, count));
  }
  Text before(Text text, std::int64_t position) const { return part(text, 1, position - 1); }
  Text behind(Text text, std::int64_t position) const {
    return part(text, std::max<std::int64_t>(position, 0) + 1, longest_string);
  }

 private:
  std::size_t bytes(Text text, std::int64_t count) const {
    const auto number = static_cast<std::size_t>(count);
    return wide_ ? bytes_of_characters(text, number) : std::min(number, text.size());
  }
  bool wide_;
};

/// What is no character of WSTRING becomes '?', each byte of it.
void add_wide(Buffer& buffer, Text text) {
  while (!text.empty()) {
    const auto good = std::min(text::valid_utf8_prefix(text), text.size());
    std::size_t end = 0;
    while (end < good && static_cast<unsigned char>(text[end]) < 0xf0) ++end;
    buffer.add(text.substr(0, end));
    text.remove_prefix(end);
    if (text.empty()) return;
    buffer.add("?");
    text.remove_prefix(1);
  }
}

void add_time(Buffer& buffer, std::int64_t ns) {
  buffer.add("T#");
  auto rest = static_cast<std::uint64_t>(ns);
  if (ns < 0) {
    buffer.add("-");
    rest = 0 - rest;
  }
  constexpr std::pair<std::uint64_t, const char*> units[] = {
      {86400000000000u, "d"}, {3600000000000u, "h"}, {60000000000u, "m"}, {1000000000u, "s"},
      {1000000u, "ms"},       {1000u, "us"},         {1u, "ns"}};
  bool any = false;
  for (const auto& [size, name] : units) {
    const bool last_chance = size == 1000000u && rest == 0 && !any;
    if (rest < size && !last_chance) continue;
    std::array<char, 24> digits;
    const auto* end = std::to_chars(digits.data(), digits.data() + digits.size(), rest / size).ptr;
    buffer.add(Text(digits.data(), static_cast<std::size_t>(end - digits.data())));
    buffer.add(name);
    rest %= size;
    any = true;
  }
}

template <class T>
void add_number(Buffer& buffer, T value) {
  buffer.resize(std::to_chars(buffer.data(), buffer.end(), value).ptr);
}

Text trimmed(Text text) {
  while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
  while (!text.empty() && text.back() == ' ') text.remove_suffix(1);
  if (!text.empty() && text.front() == '+') text.remove_prefix(1);
  return text;
}

/// The number at the start of the text; 0 when there is none.
template <class T>
T number(Text text) {
  T value{};
  text = trimmed(text);
  std::from_chars(text.data(), text.data() + text.size(), value);
  return value;
}

}  // namespace

int arguments(StringFunction function) {
  using enum StringFunction;
  switch (function) {
    case concat:
    case left:
    case right:
    case find:
    case compare:
      return 2;
    case mid:
    case insert:
    case erase:
      return 3;
    case replace:
      return 4;
    default:
      return 1;
  }
}

std::size_t bytes_of_characters(std::string_view text, std::size_t count) {
  std::size_t i = 0;
  for (; i < text.size(); ++i)
    if ((static_cast<unsigned char>(text[i]) & 0xc0u) != 0x80u && count-- == 0) break;
  return i;
}

std::size_t characters(std::string_view text) {
  return static_cast<std::size_t>(std::count_if(
      text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xc0u) != 0x80u; }));
}

bool is_wide_text(std::string_view text) {
  return text::valid_utf8_prefix(text) == text.size() &&
         std::none_of(text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) >= 0xf0; });
}

bool make_string(StringFunction function, bool wide, std::span<std::uint64_t> memory, std::uint64_t result,
                 std::uint32_t limit, const std::uint64_t* arg) {
  using enum StringFunction;
  const auto room = wide ? 3 * limit : limit;  // bytes
  const Parts parts(wide);
  if (result >= memory.size() || result + string_cells(room) > memory.size()) return false;
  Buffer buffer;
  Text first, second;
  const bool from_text = function <= to_wide;
  if (from_text && !read(memory, arg[0], first)) return false;
  if ((function == concat || function == insert || function == replace) && !read(memory, arg[1], second))
    return false;
  const auto number_at = [&](int i) {
    return std::clamp<std::int64_t>(as_signed(arg[i]), -longest_string, 2 * longest_string);
  };
  switch (function) {
    case copy:
      buffer.add(first);
      break;
    case to_wide:
      add_wide(buffer, first);
      break;
    case concat:
      buffer.add(first), buffer.add(second);
      break;
    case left:
      buffer.add(parts.part(first, 1, number_at(1)));
      break;
    case right: {
      const auto size = parts.size(first);
      buffer.add(parts.behind(first, size - std::clamp<std::int64_t>(number_at(1), 0, size)));
      break;
    }
    case mid:  // MID(IN, L, P)
      buffer.add(parts.part(first, number_at(2), number_at(1)));
      break;
    case insert:  // INSERT(IN1, IN2, P): behind position P
      buffer.add(parts.part(first, 1, number_at(2))), buffer.add(second);
      buffer.add(parts.behind(first, number_at(2)));
      break;
    case erase:  // DELETE(IN, L, P)
      buffer.add(parts.before(first, number_at(2)));
      buffer.add(parts.behind(
          first, std::max<std::int64_t>(number_at(2), 1) - 1 + std::max<std::int64_t>(number_at(1), 0)));
      break;
    case replace:  // REPLACE(IN1, IN2, L, P)
      buffer.add(parts.before(first, number_at(3))), buffer.add(second);
      buffer.add(parts.behind(
          first, std::max<std::int64_t>(number_at(3), 1) - 1 + std::max<std::int64_t>(number_at(2), 0)));
      break;
    case from_int:
      add_number(buffer, as_signed(arg[0]));
      break;
    case from_uint:
      add_number(buffer, arg[0]);
      break;
    case from_real:
      add_number(buffer, as_float(arg[0]));
      break;
    case from_lreal:
      add_number(buffer, as_double(arg[0]));
      break;
    case from_time:
      add_time(buffer, as_signed(arg[0]));
      break;
    case from_bool:
      buffer.add(arg[0] != 0 ? "TRUE" : "FALSE");
      break;
    default:
      return false;
  }
  auto text = buffer.text();
  text = text.substr(0, std::min<std::size_t>(wide ? bytes_of_characters(text, limit) : limit, room));
  auto* cells = memory.data() + result;
  // The unused bytes are zero, so that equal strings are equal cells.
  std::fill_n(cells, string_cells(room), 0);
  cells[0] = text.size();
  std::memcpy(cells + 1, text.data(), text.size());
  return true;
}

bool query_string(StringFunction function, bool wide, std::span<const std::uint64_t> memory,
                  const std::uint64_t* arg, std::uint64_t& result) {
  using enum StringFunction;
  Text first, second;
  if (!read(memory, arg[0], first)) return false;
  if ((function == find || function == compare) && !read(memory, arg[1], second)) return false;
  switch (function) {
    case length:
      result = wide ? characters(first) : first.size();
      return true;
    case find: {
      const auto at = second.empty() ? Text::npos : first.find(second);
      result = at == Text::npos ? 0 : (wide ? characters(first.substr(0, at)) : at) + 1;
      return true;
    }
    case compare: {
      const int order = first.compare(second);
      result = static_cast<std::uint64_t>(std::int64_t{order < 0 ? -1 : order > 0 ? 1 : 0});
      return true;
    }
    case to_int:
      result = trimmed(first).starts_with('-') ? static_cast<std::uint64_t>(number<std::int64_t>(first))
                                               : number<std::uint64_t>(first);
      return true;
    case to_real:
      result = cell_of(number<float>(first));
      return true;
    case to_lreal:
      result = cell_of(number<double>(first));
      return true;
    case to_bool: {
      const auto text = trimmed(first);
      result = text == "1" || text == "TRUE" || text == "true" || text == "True" ? 1 : 0;
      return true;
    }
    default:
      return false;
  }
}

}  // namespace trunnion::st
