// SPDX-License-Identifier: Apache-2.0
// Warnings that the words of a block give, and what its moves are judged with.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "analysis/block_calls.hpp"
#include "analysis/warnings.hpp"
#include "language/block_watch.hpp"
#include "language/environment.hpp"

namespace trunnion::analysis {

/// What the program has stated so far.
struct Stated {
  bool units = false, distance = false, work_offset = false;
  bool feed = false;
};

class BlockChecks {
 public:
  /// `functions_known`: the M codes are checked against those of the machine. `environment` and `warnings`
  /// must outlive the checks.
  BlockChecks(const language::Environment& environment, bool functions_known, Warnings& warnings);

  void see(const language::SeenBlock& seen);

  /// The block that was seen last has made `command`.
  bool has(const language::Command& command) const {
    return command.program == program_ && command.line == number_;
  }
  /// Of that block: where its first axis word is, or its line.
  WarningPlace place() const { return place_in(program_, number_, line_, offset_); }
  /// It is written in the NUM dialect.
  bool num() const { return num_; }
  /// It calls a macro or a cycle of the user: its letters are arguments.
  bool calls() const { return calls_; }
  /// Tenths of its code that moves the axes in a way of its own (G28, G53 ...), or 0.
  std::uint16_t one_block() const { return one_block_; }

  const Stated& stated() const { return stated_; }
  /// The program touches: G31, or a cycle that does.
  bool probes() const { return probes_; }
  /// M13 or M14 of a machine that has them turns the spindle.
  bool spindle_by_logic() const { return spindle_by_logic_; }
  /// The newest line of the main program has M99.
  bool returns() const { return returns_; }
  /// The newest line of the main program, with words.
  std::uint32_t last_line() const { return last_line_; }

 private:
  void note(const language::SeenBlock& seen);
  void check_change(const language::SeenBlock& seen);
  /// The tool that M6 of the block brings into the spindle.
  double changed_to(const language::SeenBlock& seen) const;
  void check_length(const language::SeenBlock& seen);
  void check_radius(const language::SeenBlock& seen);
  void check_return(const language::SeenBlock& seen);
  void check_m(const language::SeenBlock& seen);
  void check_cycle(const language::SeenBlock& seen);
  void check_cycle_level(const language::SeenBlock& seen);
  void check_condition(const language::SeenBlock& seen);

  Warnings& warnings_;
  bool functions_known_ = false;
  bool makes_ready_ = false;  // of two T words the second one is for the next M6
  BlockCalls block_calls_;
  bool num_ = false;
  Stated stated_;
  bool selected_ = false;  // a T came since the newest M6
  bool probes_ = false, spindle_by_logic_ = false, returns_ = false, calls_ = false;
  std::uint32_t last_line_ = 0;
  std::optional<WarningPlace> returned_;  // G28 or G30 while a cycle was active, and it still is
  std::uint16_t one_block_ = 0;
  std::uint32_t program_ = 0, number_ = 0;
  std::size_t offset_ = 0;
  std::string line_;
};

/// The condition of an IF, ELSEIF or WHILE, up to what is behind it; empty when the line has none.
std::string_view condition_of(std::string_view line);
/// Its first character opens a bracket.
bool in_brackets(std::string_view condition);
/// AND, OR or XOR is beside a comparison, with no bracket between them.
bool mixes_order(std::string_view condition);

}  // namespace trunnion::analysis
