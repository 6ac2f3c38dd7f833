// SPDX-License-Identifier: Apache-2.0
// What is doubtful in a program that runs: docs/program-check.md has each warning with its cause.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace trunnion::analysis {

enum class WarningKind : std::uint8_t {
  head,
  change_without_tool,
  other_length,
  length_missing,
  radius_missing,
  feed_missing,
  spindle_stopped,
  tip_control,
  rapid_down,
  return_over_zero,
  arc_side,
  arc_half,
  arc_full,
  arc_end,
  condition_brackets,
  condition_order,
  foreign_m,
  cycle_active,
  cycle_below,
  end_missing,
};

struct WarningRule {
  const char* name;    ///< in JSON and in the document
  const char* text;    ///< what was found; a detail may follow
  const char* remedy;  ///< what to write
};

/// In the order of WarningKind.
inline constexpr std::array warning_rules = {
    WarningRule{"head", "not stated before the first move", "write them in the head of the program"},
    WarningRule{"change_without_tool", "M6 without a T since the change before", "write T_ M6"},
    WarningRule{"other_length", "the length is not that of the tool in the spindle",
                "write H with the number of the tool, or check that this entry is meant"},
    WarningRule{"length_missing", "the tool goes down at feed without its length", "write G43 H_ before"},
    WarningRule{"radius_missing", "G41 or G42 without D, or with D0: the radius is 0",
                "write D with the number of the tool"},
    WarningRule{"feed_missing", "motion at feed before any F", "write F_"},
    WarningRule{"spindle_stopped", "the spindle is at rest at the first move at feed",
                "write S_ M3 before it"},
    WarningRule{"tip_control", "rotary axes move together with X Y Z at feed without tool tip control",
                "write G43.4 H_ before, unless the program is posted for the axes of this machine"},
    WarningRule{"rapid_down", "rapid down and sideways at once, below a level that has been cut",
                "write X Y first, then Z"},
    WarningRule{"return_over_zero", "with G90 the return goes over the zero of the workpiece",
                "write G91 in the block"},
    WarningRule{"arc_side", "the circle with R turns back at both ends, on its other side it would be smooth",
                "check G2, G3 and the sign of R, or write I J K"},
    WarningRule{"arc_half", "circle with R of nearly half a turn: the last digit moves its centre",
                "write I J K"},
    WarningRule{"arc_full", "circle with R of nearly a full turn: the last digit moves its centre",
                "write I J K"},
    WarningRule{"arc_end", "the end of the circle is not on it",
                "post the program with more digits, or correct I J K"},
    WarningRule{"condition_brackets", "condition without brackets, which other controls do not read",
                "write IF [_]"},
    WarningRule{"condition_order", "AND, OR or XOR beside a comparison: here it is computed first",
                "write each comparison in brackets"},
    WarningRule{"foreign_m", "M code that means something of its own on another control",
                "name the machine with --machine, which knows its M codes"},
    WarningRule{"cycle_active", "a drilling cycle continues behind a tool change or a return",
                "write G80 before, or the next X Y is a hole"},
    WarningRule{"cycle_below", "the cycle begins below R, and goes to the hole there",
                "write G0 Z_ above R before"},
    WarningRule{"end_missing", "the program ends without M30 or M2", "write M30"},
};

/// A place in a text, from 1.
struct WarningPlace {
  std::uint32_t program = 0;  ///< as Command::program
  std::uint32_t line = 0;
  std::uint32_t column = 0;
};

struct Warning {
  WarningKind kind{};
  WarningPlace place;
  std::uint32_t about = 0;   ///< what of this kind it is, for example a tool
  std::uint64_t blocks = 0;  ///< how many have it
  std::string detail;        ///< with numbers and units; may be empty
};

const WarningRule& rule_of(const Warning& warning);
/// What was found and what to write, without the place.
std::string text_of(const Warning& warning);

/// Keeps the first of each kind and subject, and counts the others.
class Warnings {
 public:
  /// The first of its kind and subject, which may get its detail before the next call; null: there was one.
  Warning* add(WarningKind kind, const WarningPlace& place, std::uint32_t about = 0);
  /// In the order of their places, those of the main program first.
  std::vector<Warning> sorted() const;

 private:
  static constexpr std::size_t most = 200;  // a program of another kind could fill the memory
  std::vector<Warning> found_;
};

/// The place of byte `offset`, from 0, of a line.
WarningPlace place_in(std::uint32_t program, std::uint32_t number, std::string_view line, std::size_t offset);

}  // namespace trunnion::analysis
