// SPDX-License-Identifier: Apache-2.0
// Canonical commands: what a program means once every word, offset, cycle and variable has been resolved.
// The interpreter writes them, motion reads them, and nothing between the two knows G code.
#pragma once

#include <array>
#include <cstdint>

#include "canonical/axes.hpp"

namespace trunnion::canonical {

enum class FeedMode : std::uint8_t { per_minute, inverse_time, per_revolution };  // G94, G93, G95
enum class PathControl : std::uint8_t { continuous, exact_stop };                 // G64, G61

/// How the linear axes of a command are to be read.
enum class Transformation : std::uint8_t {
  none,  ///< machine coordinates of the control point, tool length included
  rtcp,  ///< tool tip in the workpiece frame with all rotary axes at zero: machine coordinates minus the tool
         ///< length (G43.4)
};

enum class CutterSide : std::uint8_t { off, left, right };        // G40, G41, G42
enum class SpindleMode : std::uint8_t { speed, surface };         // G97, G96
enum class SpindleDirection : std::uint8_t { stopped, cw, ccw };  // M5, M3, M4

/// A tilted plane (G68.1, G68.2, G68.3): point of the workpiece frame = origin + matrix * programmed point.
struct Tilt {
  bool active = false;
  Vector3 origin{};                                         ///< mm, in the workpiece frame
  std::array<double, 9> matrix{1, 0, 0, 0, 1, 0, 0, 0, 1};  ///< rows; its columns are the plane's X, Y, Z
  /// Of the rotary axes: 0 the shortest way, 1 positive, 2 negative, 3 and 4 these where they are in travel.
  std::uint8_t solution = 0;
  bool operator==(const Tilt&) const = default;

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("active", self.active), visit("solution", self.solution);
    visit("origin", self.origin), visit("matrix", self.matrix);
  }
};

/// Bits of ModalState::suppressed: what a program keeps from acting on its blocks (#3003, #3004).
inline constexpr std::uint8_t no_single_block = 1;
inline constexpr std::uint8_t no_feed_hold = 2;  ///< of the operator; it acts behind the blocks
inline constexpr std::uint8_t no_override = 4;   ///< of the feed
inline constexpr std::uint8_t no_exact_stop = 8;
inline constexpr unsigned path_suppression = 1;  ///< the last three are #3004, so many bits to the left

/// The modal state a command was made in: what the HMI shows, and what a restart at this command restores.
struct ModalState {
  std::uint8_t motion = 0;  ///< 0, 1, 2, 3 (G0..G3), 33, 34 (G33 and G32, G34) or 62 (G6.2)
  Plane plane = Plane::xy;
  bool absolute = true;  ///< G90, else G91
  bool metric = true;    ///< G21, else G20
  FeedMode feed_mode = FeedMode::per_minute;
  PathControl path_control = PathControl::continuous;
  std::uint8_t work_offset = 0;  ///< 0 = G54 .. 5 = G59, 6 = G54.1 P1 .. 53 = G54.1 P48
  Transformation transformation = Transformation::none;
  std::uint16_t tool = 0;           ///< T in the spindle (after M6)
  std::uint16_t selected_tool = 0;  ///< T made ready, which the next M6 brings into the spindle
  std::uint16_t length_offset = 0;  ///< H of the active G43 / G43.4, 0 when G49
  double tool_length = 0;           ///< mm, of length_offset; negative with G44
  std::uint16_t radius_offset = 0;  ///< D, which G41 and G42 use
  CutterSide cutter_side = CutterSide::off;
  std::uint8_t cycle = 80;        ///< 73, 74, 76, 81..89, or 80 for none
  bool return_to_initial = true;  ///< G98, else G99
  std::uint8_t smoothing = 0;     ///< machining mode, Q of G5.1: 0..2
  bool tool_vector = false;       ///< G43.5: I J K give the tool's direction
  bool plane_only = false;  ///< transformation serves a tilted plane alone: rotary axes are at rest in it
  bool polar = false;       ///< G16
  bool scaled = false;      ///< G51
  bool mirrored = false;    ///< G51.1, G24
  bool rotated = false;     ///< G68
  bool absolute_centres = false;  ///< G90.1, else G91.1
  SpindleMode spindle_mode = SpindleMode::speed;
  SpindleDirection spindle_direction = SpindleDirection::stopped;
  double feed = 0;            ///< F as it applies: mm/min (deg/min for purely rotary moves), 1/min, mm/rev
  double spindle_speed = 0;   ///< S, 1/min; with G96 the one before it, behind G96 without S the one it had
  double surface_speed = 0;   ///< S of G96, m/min
  double spindle_limit = 0;   ///< S of G92, 1/min; 0 = none
  double path_tolerance = 0;  ///< P of G64, mm; 0 = the channel's own
  Tilt tilt{};                ///< words are in this plane; targets of commands never are
  std::uint32_t frame = 0;    ///< names the frame of the words: Interpreter::frame_of()
  /// Of no_single_block and those behind it.
  std::uint8_t suppressed = 0;
  bool operator==(const ModalState&) const = default;

  /// G43.4 or G43.5: the tool tip stays on the path while rotary axes move.
  bool tip_control() const { return transformation == Transformation::rtcp && !plane_only; }

  /// Every field that a channel keeps from one line or process to the next. No field, an interpreter names
  /// frames of its own: frame. No field, another process suppresses nothing: suppressed.
  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("motion", self.motion), visit("plane", self.plane), visit("absolute", self.absolute);
    visit("metric", self.metric), visit("feed_mode", self.feed_mode);
    visit("path_control", self.path_control), visit("work_offset", self.work_offset);
    visit("transformation", self.transformation), visit("tool", self.tool);
    visit("selected_tool", self.selected_tool), visit("length_offset", self.length_offset);
    visit("tool_length", self.tool_length), visit("radius_offset", self.radius_offset);
    visit("cutter_side", self.cutter_side), visit("cycle", self.cycle);
    visit("return_to_initial", self.return_to_initial), visit("smoothing", self.smoothing);
    visit("tool_vector", self.tool_vector), visit("plane_only", self.plane_only);
    visit("polar", self.polar), visit("scaled", self.scaled);
    visit("mirrored", self.mirrored), visit("rotated", self.rotated);
    visit("absolute_centres", self.absolute_centres);
    visit("spindle_mode", self.spindle_mode), visit("spindle_direction", self.spindle_direction);
    visit("feed", self.feed), visit("spindle_speed", self.spindle_speed);
    visit("surface_speed", self.surface_speed), visit("spindle_limit", self.spindle_limit);
    visit("path_tolerance", self.path_tolerance), visit("tilt", self.tilt);
  }
};

enum class CommandKind : std::uint8_t {
  rapid,           ///< move every axis to target, together
  line,            ///< straight line of the linear axes, rotary axes proportional to it
  arc,             ///< circle or helix in arc.plane, other axes proportional to the angle
  dwell,           ///< axes at rest for dwell_seconds
  tool,            ///< T word: number = tool selected
  spindle_speed,   ///< S word: value = 1/min
  auxiliary,       ///< M code: number
  transformation,  ///< modal.transformation or modal.tool_length changed without motion; target is the
                   ///< position in the new frame
  end,             ///< M2, M30, or the end of the text
  skip,   ///< as line, ends where the skip input `number` comes (G31); no further block is read before
          ///< Interpreter::set_position()
  tap,    ///< straight move along the tool coupled to the spindle: value = lead in mm per revolution. With a
          ///< positive lead (right-hand thread) the spindle turns clockwise on the way in and back on the way
          ///< out. number = tapping axis, 0 the spindle, 1..6 A B C U V W
  table,  ///< a table was changed by the program (G10): `table`, entry `number`, and `value` or target
  message,  ///< number; the text is the comment of its line
  cycle,    ///< number as written to #3100; nothing further is read before Interpreter::answer()
  home,     ///< search the references of the axes of `number` (bit a for Axis a) (G28.2), which end somewhere
            ///< near target; value = speed of the search per minute as programmed: mm, or inches when not
            ///< modal.metric, of linear axes, degrees of the others; 0 = the axis' own. No further block is
            ///< read before Interpreter::set_position()
  thread,   ///< straight move of linear axes that follows the turning spindle (G33, G34): value = lead at its
            ///< start in mm per revolution of the axis that goes farthest, the first of equal ones. Threads
            ///< with no other command and no exact stop between them are one thread; number = 1: begins
            ///< another one
  read,     ///< a value of a spindle (canonical/spindle_value.hpp) or a signal of the PLC (macro_signal.hpp)
            ///< behind dwell_seconds at rest, number as read_number() or the variable's; nothing further is
            ///< read before Interpreter::give_value()
  spindle_order,  ///< what the PLC is to do: with a spindle, number as order_master and others; or a signal
                  ///< that it is to have, number as the variable's; value
  print,          ///< a line for a file (DPRNT), with the axes at rest; its text is Interpreter::print_text()
};

/// What a command of kind table changed, for the owner of the tables; the interpreter has done so already.
enum class Table : std::uint8_t {
  none,
  work_offset,       ///< number as ModalState::work_offset, target = its new machine coordinates
  tool_length,       ///< number = tool entry, value = mm
  tool_length_wear,  ///< likewise
  tool_radius,       ///< likewise
  tool_radius_wear,  ///< likewise
  parameter,         ///< number = parameter, value
  parts,             ///< value = parts machined, of the channel that runs the program
};

struct Arc {
  Plane plane = Plane::xy;
  bool clockwise = false;  ///< seen from the positive third axis of the plane (ISO 6983)
  std::array<double, 3>
      centre{};      ///< X Y Z mm, in the frame of target; the component off the plane is the start's
  double sweep = 0;  ///< degrees, always > 0; above 360 for several turns
  Vector3 normal{};  ///< unit vector that takes the place of the plane's third axis when the circle is in
                     ///< none of the three planes (tilted plane); zero when it is
};

/// One canonical command. Trivially copyable, no strings: its text is found by its line.
struct Command {
  CommandKind kind = CommandKind::end;
  std::uint32_t program = 0;   ///< text the line is in: 0 the started one, n a text resolved as subprogram n
  std::uint32_t line = 0;      ///< source line, from 1
  std::uint32_t sequence = 0;  ///< counts the commands of a program from 1: names the point of a restart
  AxisValues target{};         ///< end of a move, in the frame modal.transformation says
  Arc arc{};
  double dwell_seconds = 0;
  std::uint32_t number = 0;  ///< M, T or message number; of end: 2, 30, or 0 for the end of the text
  double value = 0;          ///< S in 1/min, or in m/min when modal.spindle_mode says surface; with has_value
                             ///< the angle of M19, deg in [0, 360)
  double lead_change = 0;    ///< of kind thread: mm per revolution in each revolution
  double start_angle = 0;    ///< of kind thread: degrees behind the index mark, in the spindle's direction
  double spindle_speed = 0;  ///< of kind tap: 1/min; 0 = modal.spindle_speed
  double hole_speed = 0;     ///< of kind tap: 1/min of a faster stroke in the same hole; 0 = there is none
  Table table = Table::none;  ///< of kind table
  bool chord = false;      ///< a piece of a smooth curve (G6.2) or of a move with tool vectors (G43.5) that
                           ///< continues behind it: its end is no corner
  bool has_value = false;  ///< of kind auxiliary: the block gives `value`
  bool out = false;        ///< of kind tap: out of a hole that the tap was left in
  ModalState modal{};
};

/// 1/min at which the spindle makes a stroke of kind tap.
inline double stroke_speed(const Command& stroke) {
  return stroke.spindle_speed > 0 ? stroke.spindle_speed : stroke.modal.spindle_speed;
}

/// 1/min of the fastest stroke in the hole that begins with `stroke`, of kind tap.
inline double fastest_stroke(const Command& stroke) {
  const double own = stroke_speed(stroke);
  return stroke.hole_speed > own ? stroke.hole_speed : own;
}

}  // namespace trunnion::canonical
