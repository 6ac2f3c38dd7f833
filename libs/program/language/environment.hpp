// SPDX-License-Identifier: Apache-2.0
// What the interpreter has to know of the machine and its tables.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

#include "canonical/rotary_way.hpp"
#include "language/canonical.hpp"
#include "language/m_functions.hpp"
#include "language/text_source.hpp"

namespace trunnion::language {

/// An entry of the tool table.
struct ToolOffset {
  double length = 0;             ///< mm
  double length_wear = 0;        ///< mm, added to the length
  std::optional<double> radius;  ///< mm; nothing when the table has no radii
  double radius_wear = 0;        ///< mm, added to the radius, or subtracted (CutterSettings::wear_sign)
};

/// A decimal point in P, the time of a dwell: controls differ by a factor of 1000, so it is refused when the
/// machine does not say.
enum class DwellPoint : std::uint8_t { refused, seconds, milliseconds };

/// How canned cycles move where no word gives it.
struct CycleSettings {
  double retract = 1;    ///< mm, between two pecks of G73 and of tapping
  double clearance = 1;  ///< mm above the last depth, where G83 goes back to feed
  int shift_axis = 1;    ///< Q of G76 and G87 along the plane's axis 1 or 2, negative against it
};

/// How cutter radius compensation works: parameters 010044..010047.
struct CutterSettings {
  bool feed_at_contour = true;     ///< F of arcs holds at the contour and not at the tool centre (010044)
  int wear_sign = 1;               ///< radius = radius +- wear (010045)
  bool interference_check = true;  ///< alarm where the tool would cut into a contour nearby (010046)
  unsigned check_blocks = 2;       ///< how many moves ahead and behind are checked, at most 6 (010047)
};

/// Which of several solutions the rotary axes take: P of G68.1..G68.3, or those that follow a path of
/// directions best (G43.5).
enum class RotaryChoice : std::uint8_t { shortest, positive, negative, continuous };

/// How the rotary axes go from one tool direction to another over the great circle between them (G43.5).
struct VectorPath {
  enum class Fault : std::uint8_t {
    none,
    opposite,  ///< the directions are opposite: there is no shortest path
    end,       ///< no rotary angles give the direction at the end
    between,   ///< nor one between the two
    travel,    ///< a rotary axis would leave its travel
    pole       ///< the path comes too near to a pole
  };
  Fault fault = Fault::none;
  Vector3 nearest{};  ///< of end and on_the_way: unit vector of the nearest direction in reach, or zero
  bool turns_first = false;  ///< at a pole: an axis must turn before the direction can change
  std::uint32_t pieces = 1;  ///< in so many pieces the axes may go in proportion
};

/// An axis that a move would take out of its travel, and the position farthest out, mm or degrees.
struct TravelBreach {
  Axis axis = X;
  double position = 0;
};

/// How programs are written (parameter 04c959).
enum class ProgramDialect : std::uint8_t { iso, num, linuxcnc };

/// Parameters of the machine and what they become.
struct ParameterChanges {
  struct Change {
    std::uint32_t number = 0;
    double value = 0;
  };
  std::array<Change, 2> list{};
  std::size_t count = 0;
};

inline constexpr std::uint8_t work_offset_count = 54;

/// M codes whose block may give an angle by R or P; -1 = none.
using AngleMCodes = std::array<std::int16_t, 4>;

/// Everything a program's meaning depends on besides its text. The answers must not change between start()
/// and the end of the program, so that interpreting it again up to a command gives that command again.
class Environment {
 public:
  virtual ~Environment() = default;
  /// Machine coordinates of the zero of work offset `index`: 0 = G54 .. 5 = G59, 6 = G54.1 P1 .. 53 = G54.1
  /// P48; mm and degrees.
  virtual AxisValues work_offset(std::uint8_t index) const = 0;
  /// Of every program and every line of manual data input of the channel.
  virtual ProgramDialect program_dialect() const { return ProgramDialect::iso; }
  /// External parameter `number` of the NUM dialect, in the unit of its row in num_parameters.hpp; nothing
  /// when the machine does not have it.
  virtual std::optional<double> external_parameter(std::uint32_t number) const {
    static_cast<void>(number);
    return std::nullopt;
  }
  /// What writing it changes; nothing when the machine does not have it.
  virtual ParameterChanges external_changes(std::uint32_t number, double value) const {
    static_cast<void>(number);
    static_cast<void>(value);
    return {};
  }
  /// Tool length of table entry `h` (from 1) in mm, or nothing when there is no such entry.
  virtual std::optional<double> tool_length(std::uint16_t h) const = 0;
  /// The whole entry `number` of the tool table, from 1, or nothing when there is none.
  virtual std::optional<ToolOffset> tool_offset(std::uint16_t number) const {
    const auto length = tool_length(number);
    return length ? std::optional(ToolOffset{*length, 0, std::nullopt, 0}) : std::nullopt;
  }
  /// A T word may name tool `number`, from 1: it is in the table, or there is no table.
  virtual bool has_tool(std::uint32_t number) const {
    static_cast<void>(number);
    return true;
  }
  /// Machine coordinates of the reference position of each axis (G28); mm and degrees.
  virtual AxisValues reference_position() const = 0;
  /// The same of reference position `number` 2..4 (G30 P), or nothing when it is not defined.
  virtual std::optional<AxisValues> numbered_reference(std::uint8_t number) const {
    static_cast<void>(number);
    return std::nullopt;
  }
  /// The signed distance of each axis's last move in single-direction positioning (G60), mm or degrees; 0 =
  /// straight there.
  virtual AxisValues approach() const { return {}; }
  /// X words are diameters (parameter 040032).
  virtual bool diameter_programming() const { return false; }
  /// What a factor 1 of G51 means (parameter 040916).
  virtual double scaling_unit() const { return 1; }
  /// Feed of a swing to a tilted plane before any F (parameter 040030), mm/min or degrees/min.
  virtual double default_feed() const { return 1000; }
  /// Every motion at feed takes default_feed() before any F; otherwise it is an alarm.
  virtual bool feeds_without_word() const { return false; }
  /// How `axis` goes to an absolute position (parameter 10a949).
  virtual canonical::RotaryWay rotary_way(std::size_t axis) const {
    static_cast<void>(axis);
    return canonical::RotaryWay::linear;
  }
  /// The codes that are active when the control is switched on, after a reset and at the start of a program.
  virtual ModalState power_on() const { return {}; }
  /// Largest distance of a chord from its curve in mm (parameter 000010).
  virtual double curve_tolerance() const { return 0.005; }
  /// What the machine's logic carries out; null when no machine is known and every M code may stand.
  virtual const MFunctions* m_functions() const { return nullptr; }
  /// Parameters 010920 .. 010923.
  virtual AngleMCodes angle_m_codes() const { return {19, -1, -1, -1}; }
  /// What a decimal point in the P of a dwell means (parameter 040918).
  virtual DwellPoint dwell_point() const { return DwellPoint::refused; }
  /// F of a move of linear and rotary axes without tool tip control counts both (parameter 040919).
  virtual bool combined_feed() const { return true; }
  /// P of G68.2 states the kind of its angles, as on Fanuc, and not the solution of the rotary axes
  /// (parameter 040989).
  virtual bool plane_angles_by_p() const { return false; }
  virtual CycleSettings cycle_settings() const { return {}; }
  virtual CutterSettings cutter_settings() const { return {}; }
  /// Origin, a point on +X and a point with positive Y of stored tilted plane `index` 1..20 (G68.1 Q), mm in
  /// the workpiece frame; nothing when it is not defined.
  virtual std::optional<std::array<Vector3, 3>> plane_points(std::uint8_t index) const {
    static_cast<void>(index);
    return std::nullopt;
  }
  /// Machine coordinates with the rotary axes of `current` turned so that the tool points along `direction`
  /// (unit vector from the tip to the spindle in the workpiece frame); nothing when the machine cannot.
  virtual std::optional<AxisValues> orient(const Vector3& direction, const AxisValues& current,
                                           RotaryChoice choice) const {
    static_cast<void>(direction);
    static_cast<void>(current);
    static_cast<void>(choice);
    return std::nullopt;
  }
  /// Of a direction that orient() refuses: the nearest one the machine reaches; nothing when it is in reach
  /// and only the travel of the rotary axes, or the required sense, prevents it.
  virtual std::optional<Vector3> nearest_direction(const Vector3& direction,
                                                   const AxisValues& current) const {
    return orient(direction, current, RotaryChoice::shortest) ? std::nullopt : std::optional(Vector3{});
  }
  /// The path of the tool from its direction at the rotary axes of `current` to `direction` (as orient()).
  virtual VectorPath vector_path(const AxisValues& current, const Vector3& direction) const {
    VectorPath path;
    if (!orient(direction, current, RotaryChoice::continuous)) path.fault = VectorPath::Fault::end;
    return path;
  }
  /// The rotary axes at share `s` (0..1) of a path without fault; the linear ones of `current`.
  virtual AxisValues on_vector_path(const AxisValues& current, const Vector3& direction, double s) const {
    static_cast<void>(s);
    return orient(direction, current, RotaryChoice::continuous).value_or(current);
  }
  /// The axis that leaves its travel when the tip makes `move` (rapid, line or arc, its target's linear axes)
  /// from `start` while the tool follows a path without fault.
  virtual std::optional<TravelBreach> vector_breach(const AxisValues& start, const Command& move,
                                                    const Vector3& direction) const {
    static_cast<void>(start);
    static_cast<void>(move);
    static_cast<void>(direction);
    return std::nullopt;
  }
  /// Machine coordinates of the control point to the frame of Transformation::rtcp: the linear axes change,
  /// the rotary ones stay. `tool_length` in mm along the tool axis.
  virtual AxisValues tip_from_machine(const AxisValues& machine, double tool_length) const = 0;
  /// The inverse of tip_from_machine for the same rotary axes and tool length.
  virtual AxisValues machine_from_tip(const AxisValues& tip, double tool_length) const = 0;
  /// The axes the channel has: bit a for Axis a.
  virtual std::uint16_t axes() const = 0;
  /// The axes A B C U V W (bit a for Axis a) that are a spindle in position mode (axis number -2 in
  /// parameters 04c004..04c009): those that G74 J and G84 J may name.
  virtual std::uint16_t spindle_axes() const { return 0; }
  /// Highest speed of the spindle that S commands in 1/min (parameter 10a948, or that of its highest gear);
  /// 0 = no limit.
  virtual double highest_spindle_speed() const { return 0; }
  /// The parameter that limits it.
  virtual const char* highest_speed_parameter() const { return "10a948"; }
  /// Highest speed of a linear axis at feed in mm/min; 0 = no limit.
  virtual double highest_feed(std::size_t axis) const {
    static_cast<void>(axis);
    return 0;
  }
  /// Largest difference of an arc's radii at its start and its end in mm (parameter 000011, default 0.1).
  virtual double radius_deviation() const = 0;
  /// The text of a subprogram that is not in the calling text, or nullptr. `name` is O and at least four
  /// digits ("O0012"), or "USERDEF.CYC" for the file of canned cycles. The text must live until the program's
  /// end; it may be pending at first or fail later.
  virtual TextSource* subprogram(std::string_view name) = 0;
  /// The M code that calls canned cycle G1007 + `index`, index 0 to 7, or 0 (parameters 010170 .. 010177).
  virtual std::uint16_t cycle_m_code(std::size_t index) const {
    (void)index;
    return 0;
  }
};

}  // namespace trunnion::language
