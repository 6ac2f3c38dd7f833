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

/// What two T words in one block mean: controls differ in the tool that M6 then changes to, so they are
/// refused when the machine does not say.
enum class TwoToolWords : std::uint8_t {
  refused,
  last,              ///< the second one counts
  change_and_ready,  ///< M6 of the block changes to the first one, and the second one is made ready
};

/// G73 and G83 without a peck are drilled in one stroke: never, where the program says so (Q0), or without Q
/// too.
enum class OneStroke : std::uint8_t { never, by_zero, always };

/// How canned cycles move where no word gives it.
struct CycleSettings {
  double retract = 1;    ///< mm, between two pecks of G73 and of tapping
  double clearance = 1;  ///< mm above the last depth, where G83 goes back to feed
  int shift_axis = 1;    ///< Q of G76 and G87 along the plane's axis 1 or 2, negative against it
  OneStroke one_stroke = OneStroke::by_zero;  ///< parameter 040760
};

/// The skip move G31.1, G31.2 or G31.3: parameters 04c761..04c766.
struct SkipSettings {
  std::uint32_t input = 1;
  double feed = 0;  ///< without F in the block, mm/min, of rotary axes alone deg/min; 0 = that of the program
};

/// Automatic measuring of a tool length (G37): parameters 04c767..04c770.
struct LengthMeasuring {
  double distance = 5;  ///< mm before the expected contact: to there in rapid
  double range = 1;     ///< mm before and behind the expected contact: contact there is good
  double feed = 50;     ///< mm/min
  std::uint32_t input = 1;
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
/// The row of a table of work offsets that is added to all others: what Fanuc calls the external one.
inline constexpr std::uint8_t external_work_offset = work_offset_count;
/// Behind it are the setting errors, of G54.4 P1 .. P7.
inline constexpr std::uint8_t setting_error_count = 7;
inline constexpr std::uint8_t offset_row_count = external_work_offset + 1 + setting_error_count;

/// M codes whose block may give an angle by R or P; -1 = none.
using AngleMCodes = std::array<std::int16_t, 4>;

/// Codes that call a stored program and are what they always are within it (parameters 040690 .. 040720). 0 =
/// none.
struct CodeCalls {
  std::array<std::uint16_t, 10> g{};             ///< the macros O9010 to O9019
  std::array<std::uint16_t, 10> m{};             ///< the macros O9020 to O9029
  std::array<std::uint16_t, 9> m_subprograms{};  ///< the subprograms O9001 to O9009
  bool t = false;                                ///< T: the subprogram O9000, the number in #149
  bool s = false;                                ///< S: the subprogram O9029, the number in #147
  bool operator==(const CodeCalls&) const = default;
};

/// Everything a program's meaning depends on besides its text. The answers must not change between start()
/// and the end of the program, so that interpreting it again up to a command gives that command again.
class Environment {
 public:
  virtual ~Environment() = default;
  /// Machine coordinates of the zero of work offset `index`: 0 = G54 .. 5 = G59, 6 = G54.1 P1 .. 53 = G54.1
  /// P48; mm and degrees.
  virtual AxisValues work_offset(std::uint8_t index) const = 0;
  /// What is added to every work offset, mm and degrees.
  virtual AxisValues external_offset() const { return {}; }
  /// Setting error `number` 1..7 (G54.4 P): where the workpiece stands against its drawing, X Y Z in mm,
  /// turned by A, B and C degrees about X, then Y, then Z.
  virtual AxisValues setting_error(std::uint8_t number) const {
    static_cast<void>(number);
    return {};
  }
  /// Machine coordinates of the workpiece zero: the work offset and the external one.
  AxisValues workpiece_zero(std::uint8_t index) const {
    AxisValues zero = work_offset(index);
    const AxisValues external = external_offset();
    for (std::size_t axis = 0; axis < axis_count; ++axis) zero[axis] += external[axis];
    return zero;
  }
  /// Of lines of manual data input, and of programs whose head and name choose none (parameter 04c959).
  virtual ProgramDialect program_dialect() const { return ProgramDialect::iso; }
  /// That of stored programs of such a name (parameter 04c800); nothing when the name chooses none.
  virtual std::optional<ProgramDialect> dialect_by_name(std::string_view name) const {
    static_cast<void>(name);
    return std::nullopt;
  }
  /// Parameter `number` of the machine as it was when the program began (PRM); nothing when there is none, or
  /// when it is a text.
  virtual std::optional<double> parameter(std::uint32_t number) const {
    static_cast<void>(number);
    return std::nullopt;
  }
  /// DPRNT prints blanks where a number has no sign or fewer digits than places (parameter 040721).
  virtual bool prints_blanks() const { return true; }
  /// #2500 to #2706 are work offsets and not tools (parameter 040722).
  virtual bool offsets_by_axis() const { return false; }
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
  /// Nothing is known of the logic: an M code that m_codes does not have may stand with P, Q, R and H.
  virtual bool m_codes_take_words() const { return false; }
  /// Parameters 010920 .. 010923.
  virtual AngleMCodes angle_m_codes() const { return {19, -1, -1, -1}; }
  /// What a decimal point in the P of a dwell means (parameter 040918).
  virtual DwellPoint dwell_point() const { return DwellPoint::refused; }
  /// What two T words in one block mean (parameter 040680).
  virtual TwoToolWords two_tool_words() const { return TwoToolWords::refused; }
  /// Tool offsets of Haas programs are radii, not diameters (parameter 04c801, Setting 40 of a Haas control).
  virtual bool haas_radius_offsets() const { return false; }
  /// F of a move of linear and rotary axes without tool tip control counts both (parameter 040919).
  virtual bool combined_feed() const { return true; }
  /// P of G68.2 states the kind of its angles, as on Fanuc, and not the solution of the rotary axes
  /// (parameter 040989).
  virtual bool plane_angles_by_p() const { return false; }
  /// The axes may not leave the box of G22; otherwise they may not enter it (parameter 04c730).
  virtual bool zone_forbids_outside() const { return false; }
  virtual CycleSettings cycle_settings() const { return {}; }
  /// Of G31.`number`, 1 to 3.
  virtual SkipSettings skip_settings(std::uint32_t number) const { return {number + 1, 0}; }
  virtual LengthMeasuring length_measuring() const { return {}; }
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
  virtual CodeCalls code_calls() const { return {}; }
  /// The M code that calls canned cycle G1007 + `index`, index 0 to 7, or 0 (parameters 010170 .. 010177).
  virtual std::uint16_t cycle_m_code(std::size_t index) const {
    (void)index;
    return 0;
  }
};

}  // namespace trunnion::language
