// SPDX-License-Identifier: Apache-2.0
// Macro variables: the values behind #n, in the levels of calls.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include "language/alarms.hpp"
#include "language/named_parameters.hpp"

namespace trunnion::language {

/// A number, or nothing: a variable that was never written is vacant.
struct Value {
  double number = 0;  ///< 0 when not given
  bool given = false;
  static constexpr Value of(double number) { return {number, true}; }
  bool operator==(const Value&) const = default;
};

/// Which variables there are. Where Fanuc and HNC-8 use a number differently, the choice is made here.
enum class VariableKind : std::uint8_t {
  local,
  common,
  length_wear,
  length,
  radius_wear,
  radius,
  alarm,
  time_milliseconds,
  time_hours,
  message,
  cycle,
  date,
  time_of_day,
  modal,
  cutter_radius,
  block_end,
  machine_position,
  work_position,
  skip_position,
  active_length,
  external_work_offset,
  work_offset,
  extended_work_offset,
  kept,
  user,
  homed,
  spindle,
  spindle_integral,
  spindle_angle,
  suppression,
  mirror,
  parts,
  macro_signal,
  tool_time,  ///< in Haas programs only
  setting,    ///< refused, as the next two
  required_parts,
  servo_deviation,
  external,  ///< an external parameter of the NUM dialect: in no range
};

struct VariableRange {
  std::uint32_t first;
  std::uint32_t last;
  VariableKind kind;
  bool writable;
  const char* meaning;
};

inline constexpr std::array variable_ranges = {
    VariableRange{0, 49, VariableKind::local, true,
                  "local to a macro or cycle; M98 keeps those of its caller"},
    VariableRange{50, 199, VariableKind::common, true, "common to all programs, forgotten at power-off"},
    VariableRange{500, 999, VariableKind::kept, true, "common to all programs, kept"},
    VariableRange{1000, 1015, VariableKind::macro_signal, false,
                  "signals 0 to 15 of the PLC to programs, 0 or 1; read at rest"},
    VariableRange{1032, 1032, VariableKind::macro_signal, false, "#1000 .. #1015 as one word, 0 .. 65535"},
    VariableRange{1100, 1115, VariableKind::macro_signal, true,
                  "signals 0 to 15 of programs to the PLC, 0 or 1; read at rest; writing them too"},
    VariableRange{1132, 1132, VariableKind::macro_signal, true, "#1100 .. #1115 as one word, 0 .. 65535"},
    VariableRange{
        1321, 1329, VariableKind::homed, false,
        "1 = the axis had its reference when the program began, or the program has homed it: X Y Z A B C "
        "U V W"},
    VariableRange{2001, 2200, VariableKind::length_wear, true, "tool length wear of tool 1 to 200, mm"},
    VariableRange{2201, 2400, VariableKind::length, true, "tool length of tool 1 to 200, mm"},
    VariableRange{2401, 2600, VariableKind::radius_wear, true, "tool radius wear of tool 1 to 200, mm"},
    VariableRange{2601, 2800, VariableKind::radius, true, "tool radius of tool 1 to 200, mm"},
    VariableRange{3000, 3000, VariableKind::alarm, true,
                  "writing stops the program with the alarm and its comment"},
    VariableRange{3001, 3001, VariableKind::time_milliseconds, true, "timer, ms"},
    VariableRange{3002, 3002, VariableKind::time_hours, true, "timer, h"},
    VariableRange{3003, 3003, VariableKind::suppression, true,
                  "1 = no stop of single block; M, S and T always wait for their completion"},
    VariableRange{3004, 3004, VariableKind::suppression, true,
                  "sum of 1 = a feed hold of the operator waits, 2 = feed override 100 %, 4 = no exact stop"},
    VariableRange{3005, 3005, VariableKind::setting, false,
                  "does not exist, alarm 1516: units by G20 and G21"},
    VariableRange{3006, 3006, VariableKind::message, true, "writing stops as M0 does and shows the comment"},
    VariableRange{
        3007, 3007, VariableKind::mirror, false,
        "axes that are mirrored (G51.1, G24), as a sum: 1 X, 2 Y, 4 Z, 8 A, 16 B, 32 C, 64 U, 128 V, "
        "256 W"},
    VariableRange{3011, 3011, VariableKind::date, false, "date as year month day: 20250131"},
    VariableRange{3012, 3012, VariableKind::time_of_day, false, "time as hours minutes seconds: 235959"},
    VariableRange{
        3100, 3100, VariableKind::cycle, true,
        "writing calls a cycle of another service: 9960 begins it, 0 when its part is done; reads 1 = call "
        "the part O99601, 0 = finished"},
    VariableRange{3901, 3901, VariableKind::parts, true,
                  "parts machined, as they were when the program began or as it has written them"},
    VariableRange{3902, 3902, VariableKind::required_parts, false,
                  "does not exist, alarm 1517: keep the number of required parts in #500 .. #999"},
    VariableRange{4001, 4130, VariableKind::modal, false, "modal codes and words of the blocks before"},
    VariableRange{4199, 4199, VariableKind::cutter_radius, false,
                  "radius of the active D with its wear; vacant when the tool has none"},
    VariableRange{4201, 4330, VariableKind::modal, false,
                  "the same: a program finds its variables as its own blocks have left them"},
    VariableRange{4801, 4808, VariableKind::spindle, false,
                  "1 = spindle 1 to 8 has passed its index mark; read at rest"},
    VariableRange{4811, 4818, VariableKind::spindle, false,
                  "1 = it is synchronized with its master; at rest"},
    VariableRange{4821, 4828, VariableKind::spindle, true,
                  "number of its master, 0 = none; read at rest; writing orders it from the PLC"},
    VariableRange{4831, 4838, VariableKind::spindle, false, "synchronization error, deg; at rest"},
    VariableRange{4841, 4848, VariableKind::spindle, false, "speed reference, 1/min, signed; at rest"},
    VariableRange{4851, 4858, VariableKind::spindle, false, "angle of the encoder, deg; at rest"},
    VariableRange{4861, 4868, VariableKind::spindle, false,
                  "1 = its angle is controlled (M19, a path); at rest"},
    VariableRange{4871, 4878, VariableKind::spindle_integral, true,
                  "writing orders the integral action of its synchronization: 0 none, 1 active, 2 frozen"},
    VariableRange{4880, 4880, VariableKind::spindle_angle, true,
                  "writing orders the angle that is added to that of the master, deg"},
    VariableRange{5001, 5009, VariableKind::block_end, false,
                  "end of the block before, program coordinates, X Y Z A B C U V W"},
    VariableRange{5021, 5029, VariableKind::machine_position, false,
                  "position, machine coordinates; vacant of an axis that the channel does not have"},
    VariableRange{5041, 5049, VariableKind::work_position, false, "position, workpiece coordinates"},
    VariableRange{5061, 5069, VariableKind::skip_position, false,
                  "where the newest G31 stopped, workpiece coordinates; kept"},
    VariableRange{5081, 5089, VariableKind::active_length, false, "active tool length by axis: 5083 for Z"},
    VariableRange{5101, 5109, VariableKind::servo_deviation, false,
                  "does not exist, alarm 1518: the axes follow later than the program is read"},
    VariableRange{5201, 5209, VariableKind::external_work_offset, true,
                  "external work offset, which is added to every other, X Y Z A B C U V W"},
    VariableRange{5221, 5329, VariableKind::work_offset, true,
                  "work offsets: 5221 X of G54, 5241 of G55 .. 5321 of G59"},
    VariableRange{5401, 5500, VariableKind::tool_time, false,
                  "Haas programs: seconds of tool 1 to 100 at feed, 0, since they are not counted here"},
    VariableRange{7001, 7949, VariableKind::extended_work_offset, true,
                  "work offsets: 7001 X of G54.1 P1, 7021 of P2 .. 7941 of P48"},
    VariableRange{10001, 10999, VariableKind::length_wear, true, "tool length wear of tool 1 to 999, mm"},
    VariableRange{11001, 11999, VariableKind::length, true, "tool length of tool 1 to 999, mm"},
    VariableRange{12001, 12999, VariableKind::radius_wear, true, "tool radius wear of tool 1 to 999, mm"},
    VariableRange{13001, 13999, VariableKind::radius, true, "tool radius of tool 1 to 999, mm"},
    VariableRange{14001, 14949, VariableKind::extended_work_offset, true,
                  "work offsets as #7001: 14001 X of G54.1 P1 .. 14941 of P48"},
    VariableRange{50000, 54999, VariableKind::user, true, "common to all programs, kept"},
    VariableRange{900000, 907399, VariableKind::user, true,
                  "common to all programs, kept; the extended common variables of Fanuc 30i and 31i"},
};

/// Whether a variable is the control's and not a place to store something.
constexpr bool is_system_variable(double number) { return number >= 1000 && number < 50000; }

/// What outlives a program. Its user takes it out when a program ends and hands it to the next; a program
/// that is interpreted again needs it as it was at that program's start.
struct VariableStore {
  std::array<Value, 150> common{};     ///< #50..#199
  std::array<Value, 500> kept{};       ///< #500..#999
  std::array<Value, 9> skip{};         ///< #5061..#5069, mm and degrees whatever the units of the program
  std::array<Value, 5000> user{};      ///< #50000..#54999
  std::array<Value, 7400> extended{};  ///< #900000..#907399
  bool operator==(const VariableStore&) const = default;

  /// visit(number of the first, values) for every range.
  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit(50u, self.common), visit(500u, self.kept), visit(5061u, self.skip), visit(50000u, self.user),
        visit(900000u, self.extended);
  }
};

inline constexpr std::uint32_t local_variables = 50;
inline constexpr std::size_t variable_levels = 9;

/// What a program could read at one moment, but for system variables.
struct VariableImage {
  VariableStore store;
  std::array<std::array<Value, local_variables>, variable_levels> locals{};
  std::size_t level = 0;
  std::uint64_t names = 0;         ///< NamedParameters::digest()
  std::uint64_t system_reads = 0;  ///< how often the program had read one since its start
  std::uint64_t own_reads = 0;     ///< likewise, of those that are its own position and modal state
};

/// The letters of a macro call as the variables they become.
struct Arguments {
  std::array<Value, local_variables> values{};
  bool absolute = true;  ///< G90 at the call

  void clear() {
    values.fill({});
    absolute = true;
  }
};

/// What a parameter of the LinuxCNC dialect shows: linuxcnc_parameters.hpp.
enum class LinuxcncValue : std::uint8_t;

/// System variables: the state of the control.
class SystemVariables {
 public:
  virtual ~SystemVariables() = default;
  /// `index` counts from the first of `range`.
  virtual AlarmNumber read(const VariableRange& range, std::uint32_t index, Value& value) const = 0;
  virtual AlarmNumber write(const VariableRange& range, std::uint32_t index, Value value) = 0;
  /// Parameter `number` of the machine (PRM).
  virtual AlarmNumber read_parameter(std::uint32_t number, double& value) const {
    static_cast<void>(number);
    value = 0;
    return AlarmNumber::parameter_unavailable;
  }
  /// DPRNT prints blanks where a number has no sign or fewer digits than places.
  virtual bool prints_blanks() const { return true; }
  /// An external parameter of the NUM dialect, by its number.
  virtual AlarmNumber read_external(std::uint32_t number, double& value) const {
    static_cast<void>(number);
    value = 0;
    return AlarmNumber::num_parameter_unavailable;
  }
  /// Orders it to be written; 0 is the angle of a synchronization (EC).
  virtual Fault write_external(std::uint32_t number, double value) {
    static_cast<void>(number);
    static_cast<void>(value);
    return {AlarmNumber::num_parameter_unavailable, 0};
  }
  /// A parameter of the LinuxCNC dialect; `index` counts axes or coordinate systems from 0.
  virtual AlarmNumber read_linuxcnc(LinuxcncValue which, std::uint32_t index, double& value) const {
    static_cast<void>(which);
    static_cast<void>(index);
    value = 0;
    return AlarmNumber::linuxcnc_parameter_unavailable;
  }
};

/// A value has to be asked for first: no alarm, but the line is read again when it is known.
inline constexpr auto value_pending = static_cast<AlarmNumber>(1);

/// The number here of a variable of a dialect, which is whole, from 0; below 0: there is none.
using VariableNumber = double (*)(double number);

/// Everything an expression can name. No allocation.
class Variables {
 public:
  static constexpr std::size_t max_levels = variable_levels;

  explicit Variables(SystemVariables& system) : system_(system) {}

  /// The first level, without arguments.
  void start(const VariableStore& store);
  /// A level of its own for a macro or cycle; there must be less than max_levels.
  void enter(const Arguments& arguments);
  /// The level begins again with its arguments: the next repetition.
  void repeat() { levels_[level_].values = levels_[level_].arguments.values; }
  /// Back to the caller's.
  void leave() { --level_; }

  /// How the text that is read numbers its variables but the local ones; null: as variable_ranges.
  void set_numbers(VariableNumber number) { number_here_ = number; }

  /// The number is whole, from 0.
  AlarmNumber read(double number, Value& value) const {
    if (number < local_variables) {
      value = levels_[level_].values[static_cast<std::size_t>(number)];
      return AlarmNumber::none;
    }
    return read_common(number, value);
  }
  AlarmNumber write(double number, Value value);
  /// As SystemVariables; they do not change while a program runs.
  AlarmNumber read_parameter(std::uint32_t number, double& value) const {
    return system_.read_parameter(number, value);
  }
  bool prints_blanks() const { return system_.prints_blanks(); }
  /// As SystemVariables; counts as a system variable that was read.
  AlarmNumber read_external(std::uint32_t number, double& value) const {
    ++system_reads_;
    return system_.read_external(number, value);
  }
  Fault write_external(std::uint32_t number, double value) { return system_.write_external(number, value); }
  /// Likewise.
  AlarmNumber read_linuxcnc(LinuxcncValue which, std::uint32_t index, double& value) const {
    ++system_reads_;
    return system_.read_linuxcnc(which, index, value);
  }
  NamedParameters& names() { return names_; }
  const NamedParameters& names() const { return names_; }

  /// What is stored from now on can be taken back.
  void begin_line() { written_count_ = 0; }
  /// Takes it back; false when it was more than most_taken_back.
  bool take_back();
  static constexpr std::size_t most_taken_back = 32;

  /// AR[#n]: 0 when the call did not give local variable n, else 90 or 91 as G90 or G91 was active then.
  AlarmNumber argument(double number, Value& value) const;

  /// Of each axis, 0 when no skip move has ended yet.
  std::array<double, 9> skip_position() const;
  void set_skip_position(const std::array<double, 9>& position);

  const VariableStore& store() const { return store_; }
  void copy_to(VariableImage& image) const;
  /// False also when a system variable was read since, but for those of the program's own state.
  bool same_as(const VariableImage& image) const;
  /// One of the program's own position or modal state was read since.
  bool own_state_read_since(const VariableImage& image) const { return own_reads_ != image.own_reads; }
  /// Of the innermost level.
  const std::array<Value, local_variables>& locals() const { return levels_[level_].values; }

 private:
  struct Level {
    std::array<Value, local_variables> values{};
    Arguments arguments;
  };
  struct Written {
    Value* place = nullptr;
    Value before;
  };
  AlarmNumber read_common(double number, Value& value) const;
  void store(Value& place, Value value);
  /// Where a variable of the store is, or nullptr.
  const Value* stored(double number) const;

  SystemVariables& system_;
  VariableNumber number_here_ = nullptr;
  VariableStore store_;
  std::array<Level, max_levels> levels_{};
  std::size_t level_ = 0;
  NamedParameters names_;
  mutable std::uint64_t system_reads_ = 0, own_reads_ = 0;
  std::array<Written, most_taken_back> written_{};  // in this line
  std::size_t written_count_ = 0;
};

}  // namespace trunnion::language
