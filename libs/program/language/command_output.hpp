// SPDX-License-Identifier: Apache-2.0
// From the state of a program to commands in the queue, through cutter radius compensation when it is active.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "language/command_queue.hpp"
#include "language/corner.hpp"
#include "language/cutter_compensation.hpp"
#include "language/program_state.hpp"

namespace trunnion::language {

/// What a straight move is besides its end.
struct StraightMove {
  CommandKind kind = CommandKind::line;
  bool chord = false;        ///< as Command::chord
  std::uint32_t number = 0;  ///< as Command::number of kinds skip, tap and thread
  double value = 0;          ///< as Command::value of kinds tap and thread
  double lead_change = 0;    ///< as Command::lead_change
  double start_angle = 0;    ///< as Command::start_angle
  double spindle_speed = 0;  ///< as Command::spindle_speed
  double hole_speed = 0;     ///< as Command::hole_speed
  bool out = false;          ///< as Command::out
};

/// Makes commands out of the program's state and numbers them. It keeps the frames that commands were made
/// in. Memory is fixed.
class CommandOutput {
 public:
  CommandOutput(const Environment& environment, ProgramState& state)
      : environment_(environment), state_(state) {}

  /// A text begins: nothing held, sequence numbers from 1.
  void start();
  /// Commands to come belong to this line of this text and go to `queue`.
  void begin(std::uint32_t program, std::uint32_t line, CommandQueue& queue) {
    program_ = program;
    line_ = line;
    queue_ = &queue;
  }
  /// The same for the words of a block.
  void begin_block(std::uint32_t program, std::uint32_t line, CommandQueue& queue) {
    begin(program, line, queue);
    moves_ = exact_stop_once_ = false;
  }
  /// Where a command belongs, as Command::program and Command::line.
  struct Place {
    std::uint32_t program = 0;
    std::uint32_t line = 0;
  };
  Place place() const { return {program_, line_}; }
  void set_place(Place place) { program_ = place.program, line_ = place.line; }
  /// The rest of a block goes to `queue`, which must be empty.
  void resume(CommandQueue& queue) {
    queue_ = &queue;
    draining_ = false;
  }
  /// Takes the block's commands out of the queue.
  void discard();

  /// A command of the present state, to be completed by the caller.
  Command& push(CommandKind kind);
  /// The end of the program.
  Fault push_end(std::uint32_t number);
  /// Moves the axes to `program` (program coordinates), unless they are there already.
  Fault move_straight(const StraightMove& move, const AxisValues& program);
  /// The same to `command` (frame of the commands), without compensation.
  Fault move_straight_in_command_frame(CommandKind kind, const AxisValues& command);
  /// `move` is a line, rapid or arc in contour coordinates, its end `program` in program coordinates.
  Fault move_compensated(const Command& move, const AxisValues& program);
  /// The same in any case, with what the block asks for at its end; nothing: the end of a corner that is
  /// held. A move that ends in a corner is held until the next one is known, which must be a line or an arc
  /// at feed in the same plane, in the same frame and with the same compensation.
  Fault move_with_corner(const Command& move, const AxisValues& program, const std::optional<Corner>& corner);
  bool holds_corner() const { return corner_.has_value(); }
  /// Line of the corner of the last alarm, its size and the lengths of its moves, mm.
  struct CornerMeasures {
    std::uint32_t line = 0;
    double size = 0, before = 0, behind = 0;
  };
  const CornerMeasures& corner_measures() const { return corner_measures_; }
  /// Whether the axes would move to `command`, and whether linear ones would.
  bool moves_to(const AxisValues& command, bool& linear) const;
  /// A tilted plane without tool tip control has its rotary axes at rest; this move would turn one.
  bool turns_in_plane(const AxisValues& command) const;

  bool queue_empty() const { return queue_->empty(); }
  /// A command of this block moves the axes.
  bool moves() const { return moves_; }
  std::uint32_t sequence() const { return sequence_; }
  /// Every command of this block ends with an exact stop (G9).
  void stop_exactly_once() { exact_stop_once_ = true; }

  /// Gives out what the compensation has settled, as far as the queue has room.
  Fault drain();
  /// The queue had no room: more comes with resume().
  bool draining() const { return draining_; }
  /// The end of what pushed commands outside a block.
  Fault settle();
  /// An alarm when a command found no room in the compensation.
  Fault check_room();

  CutterCompensation& compensation() { return compensation_; }
  bool compensating() const { return compensation_.active(); }
  Fault refuse_in_compensation(std::uint16_t at) const {
    return compensation_.active() ? Fault{AlarmNumber::compensation_active, at} : Fault{};
  }
  /// Ends the compensation where the tool is.
  void drop_compensation();

  static constexpr std::size_t frames_kept = 128;
  const ProgramFrame& frame_of(std::uint32_t number) const { return kept_[number % frames_kept]; }

 private:
  /// A move whose end is a corner, in contour coordinates.
  struct HeldCorner {
    Command move;
    AxisValues start{};
    Corner corner;
    CutterSide side = CutterSide::off;
    std::uint32_t frame = 0;  // its revision
  };

  /// A move in contour coordinates from `start`, of this block.
  Command contour_move(const Command& move, const AxisValues& program);
  Fault give(Command command, const AxisValues& start);
  Fault end_corner(Command& move, AxisValues& start);
  /// The corner that is held, or the line of ,A, has no move behind it: an alarm of check_room().
  bool lose_corner();
  /// Of a move at feed from `start` to the position: the pieces but for the last.
  void push_turned_pieces(const AxisValues& start);
  /// The state of a command that is made now; its frame is kept.
  ModalState command_modal();

  const Environment& environment_;
  ProgramState& state_;
  CommandQueue* queue_ = nullptr;
  CutterCompensation compensation_;
  std::optional<HeldCorner> corner_;
  CornerMeasures corner_measures_;
  std::array<ProgramFrame, frames_kept> kept_;  // by number, those that commands were made in
  std::uint32_t frame_number_ = 0;              // the newest of them
  std::optional<std::uint32_t> kept_revision_;  // of the frame
  std::uint32_t program_ = 0;
  std::uint32_t line_ = 0;
  std::uint32_t sequence_ = 0;
  bool moves_ = false;
  bool exact_stop_once_ = false;
  bool draining_ = false;
  bool held_too_many_ = false;            // a command found no place in the compensation
  AlarmNumber lost_ = AlarmNumber::none;  // another command came where a corner or a line needs a move
  Command scratch_;
};

}  // namespace trunnion::language
