// SPDX-License-Identifier: Apache-2.0
// System variables: the state of the control as a program sees it.
#pragma once

#include <optional>

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

/// Reads #2001 and above from the executor and the machine's tables. Lengths are in the units of G20 or G21,
/// as program words are.
class ControlVariables final : public SystemVariables {
 public:
  ControlVariables(const Environment& environment, BlockExecutor& executor)
      : environment_(environment), executor_(executor) {}

  void start();
  void set_time(const ControlTime& time) { time_ = time; }
  void set_sequence_number(double number) { sequence_number_ = number; }
  void set_program_number(std::uint32_t number) { program_number_ = number; }
  /// Where G31 stopped, workpiece, mm and degrees.
  void set_skip_position(const AxisValues& position) { skip_position_ = position; }
  void set_modal_macro(bool active) { modal_macro_ = active; }
  /// A cycle was called (#3100) and not answered yet.
  bool needs_answer() const { return needs_answer_; }
  /// What #3100 reads from now on.
  void answer(double value) { answer_ = value, needs_answer_ = false; }
  /// A text begins: an answer that an earlier one needed will not come.
  void forget_call() { needs_answer_ = false; }

  AlarmNumber read(const VariableRange& range, std::uint32_t index, Value& value) const override;
  AlarmNumber write(const VariableRange& range, std::uint32_t index, Value value) override;

  /// Carries out what writing a variable asked for since the last time: a message, a change of a table.
  Fault carry_out(std::uint32_t program, std::uint32_t line, CommandQueue& out);

 private:
  AlarmNumber modal(std::uint32_t number, double& result) const;
  double in_program_units(std::uint32_t axis, double value) const;
  double to_machine_units(std::uint32_t axis, double value) const;
  AlarmNumber ask(const VariableRange& range, std::uint32_t index, double value);

  const Environment& environment_;
  BlockExecutor& executor_;
  ControlTime time_;
  double milliseconds_zero_ = 0;  // of #3001 as it was written
  double hours_zero_ = 0;
  double sequence_number_ = 0;
  std::uint32_t program_number_ = 0;
  bool modal_macro_ = false, needs_answer_ = false;
  double answer_ = 0;  // to the newest call of a cycle
  AxisValues skip_position_{};
  struct Request {
    VariableKind kind = VariableKind::message;
    std::uint32_t index = 0;
    double value = 0;
  };
  std::optional<Request> request_;
};

}  // namespace trunnion::language
