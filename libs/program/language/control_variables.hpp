// SPDX-License-Identifier: Apache-2.0
// System variables: the state of the control as a program sees it.
#pragma once

#include <array>
#include <optional>

#include "canonical/spindle_value.hpp"
#include "language/block_executor.hpp"
#include "language/environment.hpp"
#include "language/variables.hpp"

namespace trunnion::language {

/// Time as the variables show it; handed in, so that interpreting again gives the same.
struct ControlTime {
  double milliseconds = 0;        ///< #3001, running
  double hours = 0;               ///< #3002, running
  std::uint32_t date = 0;         ///< #3011, 20250131
  std::uint32_t time_of_day = 0;  ///< #3012, 235959
};

/// Reads #1321 and above from the executor and the machine's tables. Lengths are in the units of G20 or G21,
/// as program words are.
class ControlVariables final : public SystemVariables {
 public:
  ControlVariables(const Environment& environment, BlockExecutor& executor)
      : environment_(environment), executor_(executor) {}

  void start();
  void set_time(const ControlTime& time) { time_ = time; }
  void set_sequence_number(double number) { sequence_number_ = number; }
  void set_program_number(std::uint32_t number) { program_number_ = number; }
  /// The line that is read, in the text that so many calls have led to.
  void set_place(std::uint32_t line, std::size_t calls) { line_ = line, calls_ = calls; }
  /// Where G31 stopped, workpiece, mm and degrees.
  void set_skip_position(const AxisValues& position) { skip_position_ = position; }
  /// What #3901 shows until the program writes it.
  void set_parts(double parts) { parts_ = parts; }
  /// It stopped at a contact (#5070 of LinuxCNC).
  void set_skip_touched(bool touched) { skip_touched_ = touched; }
  /// As Interpreter::set_homed().
  void set_homed(std::optional<std::uint16_t> axes) { homed_ = axes; }
  /// Radii of tools are read and written as diameters.
  void set_tool_diameters(bool diameters) { diameters_ = diameters; }
  /// #5401 and the following are there.
  void set_tool_times(bool there) { tool_times_ = there; }
  void set_modal_macro(bool active) { modal_macro_ = active; }
  /// A cycle was called (#3100) and not answered yet.
  bool needs_answer() const { return needs_answer_; }
  /// What #3100 reads from now on.
  void answer(double value) { answer_ = value, needs_answer_ = false; }
  /// A text begins: an answer that an earlier one needed will not come.
  void forget_call() {
    needs_answer_ = needs_value_ = false;
    values_ = 0;
  }

  /// A line is read, for the first time or with the values that it has asked for.
  void begin_line() { values_read_ = request_count_ = 0; }
  /// It was carried out, or has an alarm.
  void end_line() { values_ = 0; }
  /// Reading it has ended with value_pending: Command::number of the value it needs.
  std::uint32_t wanted() const { return wanted_; }
  void await_value() { needs_value_ = true; }
  bool needs_value() const { return needs_value_; }
  /// Of the newest alarm spindle_without_mark: which spindle.
  const char* unmarked() const { return unmarked_; }
  void give_value(double value);

  AlarmNumber read(const VariableRange& range, std::uint32_t index, Value& value) const override;
  AlarmNumber write(const VariableRange& range, std::uint32_t index, Value value) override;
  AlarmNumber read_parameter(std::uint32_t number, double& value) const override;
  bool prints_blanks() const override { return environment_.prints_blanks(); }
  AlarmNumber read_external(std::uint32_t number, double& value) const override;
  Fault write_external(std::uint32_t number, double value) override;
  AlarmNumber read_linuxcnc(LinuxcncValue which, std::uint32_t index, double& value) const override;

  /// Carries out what writing variables asked for since the last time: a message, a change of a table, an
  /// order for a spindle, a signal to the PLC.
  Fault carry_out(std::uint32_t program, std::uint32_t line, CommandQueue& out);

 private:
  AlarmNumber modal(std::uint32_t number, double& result) const;
  // Parameters of the LinuxCNC dialect (linuxcnc_variables.cpp).
  AlarmNumber linuxcnc_place(LinuxcncValue which, std::uint32_t axis, double& value) const;
  AlarmNumber linuxcnc_offset(std::uint32_t index, double& value) const;
  AlarmNumber linuxcnc_tool(LinuxcncValue which, std::uint32_t axis, double& value) const;
  AlarmNumber linuxcnc_mode(LinuxcncValue which, double& value) const;
  AlarmNumber homed(std::uint32_t axis, double& result) const;
  /// 1 when the axis of this address of a NUM control has no reference, else 0.
  AlarmNumber not_homed(std::uint32_t address, double& value) const;
  /// What a program reads of a tool for 1 mm of the table.
  double tool_scale(VariableKind kind) const {
    const bool radius = kind == VariableKind::radius || kind == VariableKind::radius_wear;
    return diameters_ && radius ? 2 : 1;
  }
  double in_program_units(std::uint32_t axis, double value) const;
  double to_machine_units(std::uint32_t axis, double value) const;
  AlarmNumber ask(const VariableRange& range, std::uint32_t index, double value);
  AlarmNumber order(const VariableRange& range, std::uint32_t index, double value);
  AlarmNumber suppress(std::uint32_t number, double value);
  AlarmNumber set_signal(std::uint32_t number, double value);
  /// A work offset among #5201 .. or #5221 ..
  struct OffsetPlace {
    const VariableRange* range;
    std::uint32_t index;
  };
  /// Of #2500 .. #2706 where they are work offsets and not tools: the same one.
  std::optional<OffsetPlace> offset_of_axis(const VariableRange& range, std::uint32_t index) const;
  static constexpr double largest_added_angle = 360;  // deg, of EC
  /// What the machine says at rest; `number` as Command::number of kind read.
  AlarmNumber live_value(std::uint32_t number, double& result) const;
  AlarmNumber spindle_value(canonical::SpindleValue value, std::uint32_t spindle, double& result) const {
    return live_value(canonical::read_number(value, spindle), result);
  }
  AlarmNumber live_parameter(std::uint32_t number, double& value) const;
  Fault check_master(std::uint32_t slave, double address) const;

  const Environment& environment_;
  BlockExecutor& executor_;
  ControlTime time_;
  double milliseconds_zero_ = 0;  // of #3001 as it was written
  double hours_zero_ = 0;
  double sequence_number_ = 0;
  std::uint32_t program_number_ = 0;
  std::uint32_t line_ = 0;
  std::size_t calls_ = 0;
  bool modal_macro_ = false, needs_answer_ = false, diameters_ = false, tool_times_ = false;
  double answer_ = 0;  // to the newest call of a cycle
  double parts_ = 0;
  AxisValues skip_position_{};
  bool skip_touched_ = false;
  std::optional<std::uint16_t> homed_ = 0x1ff;  // at the start, bit a for Axis a
  struct Request {
    VariableKind kind = VariableKind::message;
    std::uint32_t index = 0;
    double value = 0;
  };
  Fault carry_out_external(const Request& request, std::uint32_t program, std::uint32_t line,
                           CommandQueue& out);
  static constexpr std::size_t most_requests = 8;  // in a line
  std::array<Request, most_requests> requests_;
  std::size_t request_count_ = 0;
  static constexpr std::size_t most_values = 16;  // that a line asks for
  std::array<double, most_values> value_{};
  std::size_t values_ = 0;               // known
  mutable std::size_t values_read_ = 0;  // in this reading of the line
  mutable std::uint32_t wanted_ = 0;
  mutable const char* unmarked_ = "";
  bool needs_value_ = false;
  // External parameters as the program has written them: as many as there are.
  struct Programmed {
    std::uint32_t number = 0;
    double value = 0;
  };
  std::array<Programmed, 32> programmed_{};
  std::size_t programmed_count_ = 0;
};

}  // namespace trunnion::language
