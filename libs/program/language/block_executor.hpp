// SPDX-License-Identifier: Apache-2.0
// What one block means: modal state, position and the commands it makes. Knows neither lines nor subprograms.
#pragma once

#include <cstdint>
#include <string_view>

#include "language/block_handlers.hpp"

namespace trunnion::language {

/// How much of what was before a text begins is still there.
enum class Beginning : std::uint8_t {
  program,  ///< only the modal state handed over: a program means the same whatever was before it
  line,     ///< everything but cutter radius compensation: a further line of manual data input
};

/// Where the program continues after a block.
struct Flow {
  enum class Kind : std::uint8_t { next, call, go_back, end };
  Kind kind = Kind::next;
  bool to_label = false;          ///< go_back to the sequence number `subprogram`
  std::uint32_t subprogram = 0;   ///< of call
  std::uint32_t repetitions = 1;  ///< of call
  bool counted = false;           ///< the repetitions were given
  std::uint16_t offset = 0;       ///< of the M word in its line
};

/// Executes blocks one after the other. Order within a block, which is not the order of its words:
///  1. units, feed mode, F            2. S                    3. T
///  4. M that act before the motion   5. plane, distance, path control, work offset, polar, G98 G99, G5.1
///  6. tool length, tool tip control, cutter radius compensation, cycle off
///  7. scaling, mirror, rotation, tilted plane
///  8. dwell, table, offset, positioning, cycle or motion
///  9. M that act after the motion   10. call, return or end
/// What a G code does is in the function that its row of `g_codes` names. A block with a fault makes no
/// command and leaves the program's state as it was; start() comes next. Codes of 7 and 8 that take axis
/// words exclude each other in one block.
///
/// A block may mean more commands than fit into a queue, or than can be counted in advance (a cycle with
/// pecks, a curve): busy() then asks for resume() until it is false.
///
/// Feeds: F is mm (inch) of the path of the linear axes per minute or revolution; a line of rotary axes alone
/// takes the number as degrees, in G20 too. A change of G93 G94 G95 forgets F.
class BlockExecutor {
 public:
  explicit BlockExecutor(Environment& environment) : context_(environment), handlers_(context_) {}

  /// Begins a text at `position`, in the frame `modal.transformation` says, and fetches the tables. In a
  /// program the frames but the work offset and the tilted plane, and cycles, begin switched off; in a line
  /// `modal` must be what modal() was at the end of the line before.
  void start(const AxisValues& position, const ModalState& modal, Beginning beginning = Beginning::program);

  /// Appends the block's commands to `out`, which must be empty; sequence numbers count from start().
  Fault execute(const Block& block, std::uint32_t program, std::uint32_t line, CommandQueue& out, Flow& flow);

  /// The last block moves the axes, or has a cycle do so.
  bool moves() const { return context_.output.moves() || context_.activity != Activity::none; }

  /// The last block has more commands: resume() appends some of them to `out`, which must be empty.
  bool busy() const { return context_.activity != Activity::none || context_.output.draining(); }
  Fault resume(CommandQueue& out);

  /// A skip move (G31) was given out: nothing can be executed before set_position() reports where it ended.
  bool needs_position() const { return context_.state.needs_position; }

  /// Appends the end of the program; `number` as Command::number.
  Fault end_program(std::uint32_t number, std::uint32_t program, std::uint32_t line, CommandQueue& out);

  /// The text of the last fault of a block beyond its number; empty when that is not `number`.
  std::string_view fault_detail(AlarmNumber number);
  /// The moves of the last alarm of interference.
  const CutterCompensation::Interference& interference() {
    return context_.output.compensation().interference();
  }

  /// Change a table as G10 does, `value` in mm or degrees in place of the old.
  Fault write_work_offset(std::uint8_t index, std::size_t axis, double value, std::uint32_t program,
                          std::uint32_t line, CommandQueue& out);
  Fault write_tool(Table table, std::uint16_t number, double value, std::uint32_t program, std::uint32_t line,
                   CommandQueue& out);

  /// Appends message `number`, whose text is the comment of its line, and the program stop that lets it be
  /// read.
  Fault message(std::uint32_t number, std::uint32_t program, std::uint32_t line, CommandQueue& out);

  /// Appends the call of a cycle of another service, `number` as Command::number. Not with cutter radius
  /// compensation: its moves need blocks that are not read yet.
  Fault call_cycle(std::uint32_t number, std::uint32_t program, std::uint32_t line, CommandQueue& out);

  const ModalState& modal() const { return context_.state.modal; }
  /// Where the last move that was read ends, in the frame of its commands. With cutter compensation this is
  /// the contour, not the centre of the tool.
  const AxisValues& position() const { return context_.state.position; }
  /// The same in program coordinates, as a word would give it: what G90 refers to.
  const AxisValues& program_position() const { return context_.state.program_position; }
  /// The same as coordinates of the machine's control point.
  AxisValues machine_position() const { return context_.state.machine_position(context_.environment); }
  /// The same in the workpiece frame, without rotation, scaling, mirror or tilted plane.
  AxisValues workpiece_position() const { return context_.state.workpiece_position(); }
  void set_position(const AxisValues& position);

  const ProgramFrame& frame() const { return context_.state.frame(); }
  /// That of a command, by its ModalState::frame, while no more than CommandOutput::frames_kept others came
  /// behind it. Enough for every command that has not been taken yet.
  const ProgramFrame& frame_of(std::uint32_t number) const { return context_.output.frame_of(number); }
  const OffsetTables& tables() const { return context_.tables; }

 private:
  Fault run(Flow& flow);
  /// The codes of these groups, in their order.
  Fault carry_out(std::uint32_t groups);
  /// Frames, then the block's positioning, cycle or motion.
  Fault act();
  Fault check_axis_words(bool& taken) const;
  Fault check_context() const;
  Fault finish_block();
  Fault auxiliary(When when);
  Fault set_flow(Flow& flow);
  Fault set_call(Flow& flow);

  BlockContext context_;
  BlockHandlers handlers_;
  Beginning beginning_ = Beginning::program;
  bool m_codes_due_ = false;  // those behind the motion, when the activity has ended
};

}  // namespace trunnion::language
