// SPDX-License-Identifier: Apache-2.0
// What the language room says of a fault. Numbers and texts are those of libs/machine/machine/alarms.yaml.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "language/alarm_numbers.hpp"

namespace trunnion::language {

constexpr std::string_view alarm_text(AlarmNumber number) {
  for (const AlarmText& entry : alarm_texts) {
    if (entry.number == number) return entry.text;
  }
  return "";
}

/// A fault inside one line, before the line's text is looked up.
struct Fault {
  AlarmNumber number = AlarmNumber::none;
  std::uint16_t offset = 0;      ///< byte of the line, from 0
  const char* detail = nullptr;  ///< static text that ends the message, at most 48 characters
  explicit operator bool() const { return number != AlarmNumber::none; }
};

/// The detail of a missing word: "needs P". `letter` is A to Z.
const char* needs(char letter);

/// Subprograms, macros and cycles inside each other.
inline constexpr std::size_t max_nesting = 8;

/// The name of a file that a program calls by its name (LinuxCNC), ends with a zero; empty for other texts.
using FileName = std::array<char, 48>;

/// A place in a text: a call that led to an alarm.
struct CallSite {
  std::uint32_t program = 0;  ///< as Command::program
  std::uint32_t line = 0;     ///< from 1
  FileName file{};            ///< of `program`
};

struct ForeignWord;

/// An alarm with its place. The caller knows the file name and formats `file:line:column: text`.
struct Alarm {
  AlarmNumber number = AlarmNumber::none;
  std::uint32_t program = 0;                  ///< as Command::program
  FileName file_name{};                       ///< of `program`
  std::uint32_t line = 0;                     ///< from 1
  std::uint32_t column = 0;                   ///< in characters (code points) from 1
  std::array<char, 192> text{};               ///< what is wrong and the word at fault, ends with a zero
  std::uint8_t calls = 0;                     ///< how many calls led here
  std::array<CallSite, max_nesting> chain{};  ///< their places, the main program's first
  const ForeignWord* foreign = nullptr;       ///< the word at fault is one of another control
};

/// Composes the alarm for a fault in `line_text`, which may be empty when the line is not at hand. The
/// fault's detail, or else `detail` (at most 48 printable characters) ends the text.
Alarm make_alarm(const Fault& fault, std::string_view line_text, std::uint32_t program, std::uint32_t line,
                 std::string_view detail = {});

}  // namespace trunnion::language
