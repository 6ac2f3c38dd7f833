// SPDX-License-Identifier: Apache-2.0
// What a channel leaves to another process as text that another build can read, too: a line `name value` for
// each number, enumerator, truth value and text in the fields of a class. Names of inner fields stand behind
// a point.
#pragma once

#include <algorithm>
#include <charconv>
#include <cmath>
#include <stdexcept>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <vector>

#include "contracts/types.hpp"
#include "language/canonical.hpp"

namespace trunnion::channel {

namespace field_lines {

// The last value of each enumeration that this build knows.
constexpr auto last(idl::channel::Mode) { return idl::channel::Mode::REF; }
constexpr auto last(language::Plane) { return language::Plane::yz; }
constexpr auto last(language::FeedMode) { return language::FeedMode::per_revolution; }
constexpr auto last(language::PathControl) { return language::PathControl::exact_stop; }
constexpr auto last(language::Transformation) { return language::Transformation::rtcp; }
constexpr auto last(language::CutterSide) { return language::CutterSide::right; }
constexpr auto last(language::SpindleMode) { return language::SpindleMode::surface; }
constexpr auto last(language::SpindleDirection) { return language::SpindleDirection::ccw; }
constexpr auto last(bool) { return true; }

template <class T>
constexpr bool is_one_line = std::is_arithmetic_v<T> || std::is_enum_v<T> || std::is_same_v<T, std::string>;

/// visit(name, field) for everything that has a line.
template <class T, class Visit>
void visit_each(T& value, const std::string& name, Visit& visit) {
  using Plain = std::remove_const_t<T>;
  if constexpr (is_one_line<Plain>) {
    visit(name, value);
  } else if constexpr (requires { std::tuple_size<Plain>::value; }) {  // an array
    for (std::size_t i = 0; i < value.size(); ++i)
      visit_each(value[i], name + "." + std::to_string(i), visit);
  } else {
    Plain::fields(value, [&](const char* inner, auto& field) {
      visit_each(field, name.empty() ? std::string(inner) : name + "." + inner, visit);
    });
  }
}

template <class Value>
std::string text_of(const Value& value) {
  char text[64];
  if constexpr (std::is_same_v<Value, std::string>)
    return value;
  else if constexpr (std::is_enum_v<Value> || std::is_same_v<Value, bool>)
    return std::to_string(static_cast<unsigned>(value));
  else
    return {text, std::to_chars(text, text + sizeof text, value).ptr};
}

template <class Number>
bool parse(std::string_view text, Number& value) {
  const auto result = std::from_chars(text.data(), text.data() + text.size(), value);
  return result.ec == std::errc{} && result.ptr == text.data() + text.size();
}

// An enumeration may have grown in another build: what this one does not know it refuses.
template <class Value>
bool assign(std::string_view text, Value& value) {
  if constexpr (std::is_same_v<Value, std::string>) {
    value = text;
    return true;
  } else if constexpr (std::is_enum_v<Value> || std::is_same_v<Value, bool>) {
    unsigned number = 0;
    if (!parse(text, number) || number > static_cast<unsigned>(last(Value{}))) return false;
    value = static_cast<Value>(number);
    return true;
  } else if constexpr (std::is_floating_point_v<Value>) {
    Value number = 0;
    if (!parse(text, number) || !std::isfinite(number)) return false;
    value = number;
    return true;
  } else {
    return parse(text, value);
  }
}

template <class T>
std::vector<std::string> lines_of(const T& value) {
  std::vector<std::string> lines;
  const auto add = [&](const std::string& name, const auto& field) {
    lines.push_back(name + " " + text_of(field) + "\n");
  };
  visit_each(value, "", add);
  return lines;
}

}  // namespace field_lines

/// The lines that differ from those of a new T, so that an older build can read what it has, too. Numbers are
/// exact to the bit.
template <class T>
std::string write_lines(const T& value) {
  const auto lines = field_lines::lines_of(value), usual = field_lines::lines_of(T{});
  std::string out;
  for (std::size_t i = 0; i < lines.size(); ++i)
    if (lines[i] != usual[i]) out += lines[i];
  return out;
}

/// `value` with the lines of `text`, whose first line is something else. Throws std::runtime_error with
/// file:line for what is no such line.
template <class T>
T read_lines(const std::string& text, const std::string& file, T value) {
  const std::string_view all = text;
  std::size_t line = 1;
  for (std::size_t at = std::min(all.find('\n'), all.size() - 1) + 1; at < all.size();) {
    ++line;
    const auto end = std::min(all.find('\n', at), all.size());
    const auto row = all.substr(at, end - at);
    at = end + 1;
    const auto space = std::min(row.find(' '), row.size());
    bool good = false;
    const auto take = [&](const std::string& name, auto& field) {
      if (!good && name == row.substr(0, space) && space < row.size())
        good = field_lines::assign(row.substr(space + 1), field);
    };
    field_lines::visit_each(value, "", take);
    if (!good)
      throw std::runtime_error(file + ":" + std::to_string(line) + ": '" + std::string(row.substr(0, 60)) +
                               "' is nothing a channel keeps");
  }
  return value;
}

}  // namespace trunnion::channel
