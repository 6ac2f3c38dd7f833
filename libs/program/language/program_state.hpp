// SPDX-License-Identifier: Apache-2.0
// What a program has set so far: modal state, position and frames. A block with a fault leaves it as it was.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "language/alarms.hpp"
#include "language/canonical.hpp"
#include "language/drawn_line.hpp"
#include "language/environment.hpp"
#include "language/hole_cycle.hpp"
#include "language/program_frame.hpp"

namespace trunnion::language {

/// As BlockState::own_motion behind G80 of LinuxCNC: axis words need a code.
inline constexpr std::uint16_t no_motion = 800;
/// Bits of BlockState::coolant.
inline constexpr std::uint8_t mist_on = 1, flood_on = 2;

/// Words of a canned cycle as LinuxCNC keeps them, mm and seconds; in G91 they are increments.
struct LinuxcncCycleWords {
  double initial = 0;  ///< level before the first cycle, program coordinates
  double depth = 0;
  double retract = 0;
  double peck = 0;
  double dwell = 0;
};

/// What LinuxCNC adds to a coordinate system.
struct LinuxcncFrame {
  AxisValues shift{};                 ///< of G52 and G92, mm and degrees, in axes that the rotation turns
  bool shifted = false;               ///< it acts: G92.2 only suspends it
  std::array<double, 9> rotations{};  ///< of G54 .. G59.3 about Z, degrees
};

/// The words of a canned cycle, which stay until G80 or a motion code.
struct CycleWords {
  HoleParameters hole;
  LinuxcncCycleWords linuxcnc;
  bool has_depth = false;
  bool has_r = false;
  bool has_q = false;              ///< of pecks, 0 too
  std::array<double, 2> shift{};   ///< of G76 and G87, mm in the plane
  std::uint32_t tapping_axis = 0;  ///< as Command::number of kind tap
  double retract_multiple = 1;     ///< of S, when a tap comes out of its hole (Haas)

  /// The code `cycle` comes while `before` is active, 80: none; the axis across the plane is at `level`, mm.
  void begin(std::uint8_t before, std::uint8_t cycle, double level);
};

/// What only few blocks change.
struct ProgramSettings {
  ProgramFrame frame;
  double polar_radius = 0;  ///< mm, of the last polar words
  double polar_angle = 0;   ///< degrees
  std::array<double, 2> polar_centre{};
  std::optional<AxisValues> intermediate;  ///< program coordinates, of the last G28 or G30
  CycleWords cycle;
  OpenLine open_line;  ///< while BlockState::line_open
  /// With a setting error (G54.4): the rotary axes of the position as the words have them, in the frame of
  /// the commands; those of the position stand so that the tool has that direction in the workpiece as it is.
  AxisValues drawn_rotary{};
  LinuxcncFrame linuxcnc;
};

/// Everything a block can change and a faulty one must not have changed: what is copied at the beginning of
/// every block. Of the settings only the place is copied: ProgramState writes changes to another place.
struct BlockState {
  ModalState modal{};
  AxisValues position{};          ///< end of the last move, in the frame of the commands
  AxisValues program_position{};  ///< the same as a word would give it
  bool parameter_input = false;   ///< between G10 L50 and G11
  bool swing_due = false;         ///< G68.1..3 was the block before
  bool needs_position = false;    ///< a skip move (G31) or a search for references (G28.2) was given out
  bool homing = false;            ///< it is the search
  std::uint16_t homed = 0;        ///< axes named by the searches so far, bit a for Axis a
  bool needs_contact = false;     ///< the skip move has failed without one (G38.2)
  std::uint16_t own_motion = 0;   ///< motion code that only LinuxCNC has, in tenths; 0: modal.motion acts
  std::uint8_t coolant = 0;       ///< what a LinuxCNC program has switched on: mist_on, flood_on
  double thread_lead = 0;         ///< F of G33 and G34, mm per revolution; 0 = none yet
  SpindleDirection parked = SpindleDirection::stopped;  ///< how it turned before tapping stopped it
  std::uint8_t machining_mode = 0;  ///< of G5.1 and its like: ModalState::smoothing but for G61.1
  bool accurate_path = false;       ///< G61.1
  bool line_open = false;           ///< the line of a block with ,A alone waits for the next one
  std::uint8_t settings_place = 0;
  bool length_given = false;       ///< the program has had an H for a tool length
  std::uint16_t length_entry = 0;  ///< the last one
  std::uint16_t length_tool = 0;   ///< the tool in the spindle then
};

class ProgramState : public BlockState {
 public:
  /// `machine` must outlive this.
  explicit ProgramState(const Environment& machine) : environment_(machine) {}

  void begin_block() {
    saved_ = *this;
    setting_fault_ = AlarmNumber::none;
  }
  /// Makes everything what it was at begin_block().
  void roll_back() { static_cast<BlockState&>(*this) = saved_; }
  const BlockState& at_block_begin() const { return saved_; }

  const ProgramSettings& settings() const { return settings_[settings_place]; }
  /// For a change; references of settings() from before are void.
  ProgramSettings& change_settings();
  const ProgramFrame& frame() const { return settings().frame; }
  ProgramFrame& change_frame() { return change_settings().frame; }

  /// Takes a position in the frame of the commands, after a move or a change of frames.
  void locate(const AxisValues& command);
  /// Takes the end of a move, which is `program` in program coordinates.
  void reach(const AxisValues& command, const AxisValues& program);
  /// Switches the setting error on or off: the rotary axes of the words stay, so that the next move turns the
  /// tool.
  void set_setting_error(std::uint8_t number, const AxisValues& values);
  /// Why a position since begin_block() cannot be reached with the setting error, or none.
  AlarmNumber setting_fault() const { return setting_fault_; }
  /// A position in program coordinates, in the frame of the commands.
  AxisValues command_from_program(const AxisValues& program) const;
  /// A command in contour coordinates, in the frame of the commands.
  void to_command_frame(Command& command) const;
  /// The position as coordinates of the machine's control point.
  AxisValues machine_position(const Environment& environment) const;
  /// The position in the workpiece frame, without rotation, scaling, mirror or tilted plane.
  AxisValues workpiece_position() const;

 private:
  double tool_length_in_z() const {
    return modal.transformation == Transformation::none ? modal.tool_length : 0.0;
  }

  bool sets_up_tool() const;
  Vector3 tool_direction(const AxisValues& rotary) const;
  /// Turns the rotary axes of the words to those that the workpiece as it stands needs.
  void set_up_tool(AxisValues& command) const;
  /// Remembers the rotary axes of a position as the words have them.
  void keep_drawn(const AxisValues& command);

  const Environment& environment_;
  BlockState saved_;
  std::array<ProgramSettings, 2> settings_;
  mutable AlarmNumber setting_fault_ = AlarmNumber::none;
};

}  // namespace trunnion::language
