// SPDX-License-Identifier: Apache-2.0
// What the handlers of a block share: its words, the state of the program and the output of commands.
#pragma once

#include <array>
#include <cstdint>

#include "language/block_words.hpp"
#include "language/command_output.hpp"
#include "language/environment.hpp"
#include "language/offset_tables.hpp"
#include "language/program_state.hpp"

namespace trunnion::language {

/// What gives more commands after its block has been executed.
enum class Activity : std::uint8_t { none, holes, curve, vector, spline, passes };

/// The text of a fault beyond its number.
struct FaultDetail {
  AlarmNumber number = AlarmNumber::none;
  std::array<char, 64> text{};
};

struct BlockContext {
  explicit BlockContext(Environment& machine)
      : environment(machine), state(machine), words(state.modal), output(machine, state) {}
  BlockContext(const BlockContext&) = delete;
  BlockContext& operator=(const BlockContext&) = delete;

  Environment& environment;
  ProgramState state;
  BlockWords words;
  OffsetTables tables;
  CommandOutput output;
  Activity activity = Activity::none;
  FaultDetail detail;
};

/// A handler carries out the codes of one concern. The functions that rows of `g_codes` name take the place
/// of the code in its line, and what distinguishes codes that share a function.
class BlockHandler {
 protected:
  explicit BlockHandler(BlockContext& context)
      : environment_(context.environment),
        words_(context.words),
        state_(context.state),
        output_(context.output),
        context_(context) {}

  /// The end of a move by the axis words of `axes`, program coordinates; remembers polar words.
  AxisValues programmed_target(std::uint32_t axes);
  /// Of an axis at `position` for an absolute word, both in the same coordinates.
  double absolute_target(std::size_t axis, double word, double position) const;
  /// A feed applies to a move of this block; the default one when the machine has one and no F came before.
  Fault check_feed(std::uint16_t at) const;

  Environment& environment_;
  BlockWords& words_;
  ProgramState& state_;
  CommandOutput& output_;
  BlockContext& context_;

 private:
  void apply_polar(std::uint32_t axes, AxisValues& target);
};

}  // namespace trunnion::language
