// SPDX-License-Identifier: Apache-2.0
// What one block means: modal state, position and the commands it makes. Knows neither lines nor subprograms.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "language/block_handlers.hpp"

namespace trunnion::language {

/// How much of what was before a text begins is still there.
enum class Beginning : std::uint8_t {
  program,  ///< only the modal state handed over: a program means the same whatever was before it
  line,     ///< everything but cutter radius compensation: a further line of manual data input
};

/// Number of a CommandKind::message whose text is behind the $ of its line; those of #3006 are at most 9999.
inline constexpr std::uint32_t line_message = 10000;

/// Where the program continues after a block.
struct Flow {
  enum class Kind : std::uint8_t { next, call, go_back, end };
  Kind kind = Kind::next;
  bool to_label = false;          ///< go_back to the sequence number `subprogram`
  std::uint32_t subprogram = 0;   ///< of call
  std::uint32_t repetitions = 1;  ///< of call
  bool counted = false;           ///< the repetitions were given
  bool local = false;             ///< call of what begins at the sequence number `subprogram` of this text
  bool from_label = false;        ///< of call: it begins at the sequence number `label`
  std::uint32_t label = 0;
  std::uint16_t label_offset = 0;
  std::uint16_t offset = 0;  ///< of the M word in its line
};

/// Executes blocks one after the other. Order within a block, which is not the order of its words:
///  1. units, feed mode, F            2. M64 to M66 of the NUM dialect, S    3. T
///  4. M that act before the motion   5. plane, distance, path control, work offset, polar, G98 G99, G5.1
///  6. tool length, tool tip control, cutter radius compensation, cycle off
///  7. forbidden zone, scaling, mirror, rotation, tilted plane
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

  /// G99, before the first block.
  void return_to_r() { context_.state.modal.return_to_initial = false; }

  /// Appends the block's commands to `out`, which must be empty; sequence numbers count from start().
  Fault execute(const Block& block, std::uint32_t program, std::uint32_t line, CommandQueue& out, Flow& flow);

  /// The last block moves the axes, or has a cycle do so.
  bool moves() const { return context_.output.moves() || context_.activity != Activity::none; }

  /// The last block has more commands: resume() appends some of them to `out`, which must be empty.
  bool busy() const { return context_.activity != Activity::none || context_.output.draining(); }
  Fault resume(CommandQueue& out);

  /// A skip move (G31) or a search for references (G28.2) was given out: nothing can be executed before
  /// set_position() reports where it ended.
  bool needs_position() const { return context_.state.needs_position; }
  /// It is the search.
  bool homing() const { return context_.state.homing; }
  /// The axes that the searches since start() name, bit a for Axis a.
  std::uint16_t homed() const { return context_.state.homed; }

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

  /// Appends the printing of a line (DPRNT). Not with cutter radius compensation: only the newest line has
  /// its text.
  Fault print(std::uint32_t program, std::uint32_t line, CommandQueue& out);

  /// Appends the search for the reference of `axis` at F, if the channel has it.
  Fault home_axis(std::size_t axis, std::uint32_t program, std::uint32_t line, CommandQueue& out);

  /// Appends the call of a cycle of another service, `number` as Command::number. Not with cutter radius
  /// compensation: its moves need blocks that are not read yet.
  Fault call_cycle(std::uint32_t number, std::uint32_t program, std::uint32_t line, CommandQueue& out);

  /// Appends the reading of a value, `number` as Command::number. Not with cutter radius compensation, as
  /// above.
  Fault read_value(std::uint32_t number, std::uint32_t program, std::uint32_t line, CommandQueue& out);
  /// Appends an order for a spindle, `number` as Command::number.
  Fault order_spindle(std::uint32_t number, double value, std::uint32_t program, std::uint32_t line,
                      CommandQueue& out);
  /// What M70 of LinuxCNC saves.
  SavedModes save_modes() const { return handlers_.linuxcnc_modal_state.save(); }
  /// Appends what brings that back (M72).
  Fault restore_modes(const SavedModes& saved, std::uint32_t program, std::uint32_t line, CommandQueue& out);
  /// Appends the change of a parameter as G10 L50 does.
  Fault write_parameter(std::uint32_t number, double value, std::uint32_t program, std::uint32_t line,
                        CommandQueue& out);

  /// Appends the number of parts that the channel has machined.
  Fault write_parts(double parts, std::uint32_t program, std::uint32_t line, CommandQueue& out);
  /// `value` of #3003 when `single_block`, else of #3004: from the next command on.
  void suppress(bool single_block, std::uint8_t value);

  const ModalState& modal() const { return context_.state.modal; }
  /// Beside it what LinuxCNC has set.
  const BlockState& state() const { return context_.state; }
  const LinuxcncFrame& linuxcnc_frame() const { return context_.state.settings().linuxcnc; }
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

  /// Of the active D, mm, with its wear; nothing when the tool has none.
  std::optional<double> cutter_radius() const { return handlers_.tool.cutter_radius(); }

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
  Fault report_unused() const;
  Fault auxiliary(When when);
  Fault carry_out(const MCode& code, std::uint16_t at);
  Fault select_spindle();
  bool selects_spindle(const MCode& code) const;
  /// The block of M`code` may give an angle.
  bool takes_angle(std::uint16_t code) const;
  /// The letter of the angle of such an M code (M19), R or P; 0 when the block has none.
  char orientation_word() const;
  /// deg in [0, 360), of M`code`.
  Fault orientation(std::uint16_t code, char word, double& angle);
  Fault set_flow(Flow& flow);
  Fault set_call(Flow& flow);
  Fault set_label(Flow& flow);
  /// An M code of the block calls a subprogram.
  bool calls() const;

  BlockContext context_;
  BlockHandlers handlers_;
  Beginning beginning_ = Beginning::program;
  AngleMCodes angle_codes_{};
  bool m_codes_due_ = false;  // those behind the motion, when the activity has ended
};

}  // namespace trunnion::language
