// SPDX-License-Identifier: Apache-2.0
// Comments that are orders: (MSG,..), (DEBUG,..), (PRINT,..), (ABORT,..) and those of files.
#include <array>
#include <cmath>
#include <cstdio>

#include "language/linuxcnc_reader.hpp"

namespace trunnion::language {
namespace {

constexpr int plain_decimals = 6, short_decimals = 4;
/// Of a value that cannot be written, as LinuxCNC shows a parameter without a value.
constexpr std::string_view no_value = "######";

/// A word that makes a comment an order; of a comma behind it nothing is said.
enum class CommentOrder : std::uint8_t { message, expanded, abort, file, python, none };
struct CommentWord {
  std::string_view word;
  CommentOrder order;
};
constexpr std::array comment_words = {
    CommentWord{"MSG", CommentOrder::message},    CommentWord{"DEBUG", CommentOrder::expanded},
    CommentWord{"PRINT", CommentOrder::expanded}, CommentWord{"ABORT", CommentOrder::abort},
    CommentWord{"PY", CommentOrder::python},      CommentWord{"LOGOPEN", CommentOrder::file},
    CommentWord{"LOGAPPEND", CommentOrder::file}, CommentWord{"PROBEOPEN", CommentOrder::file},
};

/// What a comment orders; `rest` is then behind its comma.
CommentOrder order_of(std::string_view comment, std::string_view& rest) {
  for (const CommentWord& row : comment_words) {
    LinuxcncScanner scanner(comment);
    if (!scanner.take_word(row.word)) continue;
    // (PROBEOPEN file) has no comma, and a comment may begin with the same letters.
    if (scanner.peek() != ',') return row.word == "PROBEOPEN" ? row.order : CommentOrder::none;
    rest = comment.substr(std::size_t{scanner.offset()} + 1);
    return row.order;
  }
  return CommentOrder::none;
}

}  // namespace

Fault LinuxcncReader::complete_comment() {
  std::string_view rest;
  switch (order_of(comment_, rest)) {
    case CommentOrder::message:
      return show(rest, false);
    case CommentOrder::expanded:
      return show(rest, true);
    case CommentOrder::abort:
      return {AlarmNumber::program_alarm, comment_at_};
    case CommentOrder::file:
      return {AlarmNumber::linuxcnc_function_missing, comment_at_, "files that a program writes"};
    case CommentOrder::python:
      return {AlarmNumber::linuxcnc_function_missing, comment_at_, "Python"};
    case CommentOrder::none:
      break;
  }
  return {};
}

// %d, %f and %.3f hold from their place on.
Fault LinuxcncReader::show(std::string_view text, bool expands) {
  int decimals = plain_decimals;
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty()) {
    const char c = text.front();
    text.remove_prefix(1);
    if (expands && c == '#') {
      expand(text, decimals);
      continue;
    }
    if (expands && c == '%' && text.starts_with("d")) {
      decimals = 0;
      text.remove_prefix(1);
    } else if (expands && c == '%' && text.starts_with("f")) {
      decimals = short_decimals;
      text.remove_prefix(1);
    } else if (expands && c == '%' && text.starts_with("lf")) {
      decimals = plain_decimals;
      text.remove_prefix(2);
    } else if (expands && c == '%' && text.size() >= 3 && text[0] == '.' && is_digit(text[1]) &&
               text[2] == 'f') {
      decimals = text[1] - '0';
      text.remove_prefix(3);
    } else {
      append(c);
    }
  }
  block_.message = block_.text_size != 0;
  return {};
}

// A name ends with > and a number with its digits.
void LinuxcncReader::expand(std::string_view& text, int decimals) {
  const bool named = !text.empty() && text.front() == '<';
  std::size_t size = 0;
  while (size < text.size() && (named ? text[size] != '>' : is_digit(text[size]))) ++size;
  if (named && size < text.size()) ++size;
  const std::string_view name = text.substr(0, size);
  text.remove_prefix(size);
  LinuxcncScanner scanner(name);
  LinuxcncExpression expression(scanner, variables_);
  ParameterName parameter;
  double value = 0;
  if (!name.empty() && !expression.parameter(0, parameter) && !expression.read(parameter, value)) {
    append(value, decimals);
  } else {
    for (const char c : no_value) append(c);
  }
}

// Rounded to zero, a number has no sign.
void LinuxcncReader::append(double value, int decimals) {
  if (std::abs(value) < 0.5 * std::pow(10, -decimals)) value = 0;
  std::array<char, 48> digits{};
  const int size = std::snprintf(digits.data(), digits.size(), "%.*f", decimals, value);
  for (int i = 0; i < size && i < static_cast<int>(digits.size()) - 1; ++i)
    append(digits[static_cast<std::size_t>(i)]);
}

}  // namespace trunnion::language
