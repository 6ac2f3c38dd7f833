// SPDX-License-Identifier: Apache-2.0
// The tasks on the register image (libs/plc/plc), whatever language they are written in: their variables are
// part of the explicit state.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>

#include "memory.hpp"
#include "plc/machine/machine.hpp"
#include "register_transfer.hpp"

namespace trunnion::plc {

/// `simulation` is what the machine does between its outputs and its inputs; it runs before the other tasks
/// of a scan.
enum class TaskName : std::uint32_t { fast, main, simulation };

/// What the PLC runs.
struct StructuredPrograms {
  std::shared_ptr<const st::ByteCode> code;
  std::uint64_t layout = 0;                           ///< st::Compilation::layout
  std::array<std::optional<std::size_t>, 3> entries;  ///< of code, by TaskName
};

class StructuredText {
 public:
  static constexpr std::int64_t most_statements = st::task_budget;  ///< of one task in one scan

  StructuredText() = default;
  /// Throws std::runtime_error when the variables exceed the memory, std::invalid_argument for wrong byte
  /// code.
  explicit StructuredText(StructuredPrograms programs);

  bool has(TaskName task) const {
    return machine_ && programs_.entries[static_cast<std::size_t>(task)].has_value();
  }
  /// Every variable has its initial value.
  void reset(ProgramVariables& variables);
  /// After a restart of the process: all variables; initial values when they have another layout. A fault of
  /// other code is forgotten.
  void restore(ProgramVariables& variables);
  /// The variables are of code that has not run yet, or of this code: restore() tells one from the other.
  void set_not_run(ProgramVariables& variables) const { variables.identity = 0; }
  void set_run(ProgramVariables& variables) const { variables.identity = identity_; }
  /// After a new start of the cluster: RETAIN variables of `kept` when its layout is the same.
  void power_up(const ProgramVariables& kept, ProgramVariables& variables);
  /// Registers that the programs keep besides the retained areas.
  std::span<const st::RegisterAddress> retained_registers() const;
  /// Whether the programs read or write a register.
  bool uses(st::Area area, std::uint16_t index) const;
  /// Whether the variables are those of these programs.
  bool fits(const ProgramVariables& variables) const;
  /// Puts a value into a cell of the memory, that of a variable, also into `variables`.
  void put(std::uint32_t cell, std::uint64_t value, ProgramVariables& variables);
  /// One run on the registers, `now` in ms; a fault is left in `variables`.
  /// Of the main task at most `part` statements: variables.main says whether and where it continues.
  void run(TaskName task, Registers& registers, ProgramVariables& variables, std::uint64_t now,
           std::int64_t part = most_statements);
  /// That the last run() has executed.
  std::uint64_t statements() const { return static_cast<std::uint64_t>(machine_->statements()); }
  /// PLC time in ms at which the next running timer after `now` runs out.
  std::optional<std::uint64_t> next_timer_end(std::uint64_t now) const;
  /// True when a timer has run out since the program last read it.
  bool timer_due(std::uint64_t now) const;
  /// file:line:column: what happened, in which task; empty without a fault.
  std::string fault_text(const ProgramVariables& variables) const;

 private:
  void take(const ProgramVariables& variables);
  void give(ProgramVariables& variables) const;

  StructuredPrograms programs_;
  std::uint64_t identity_ = 0;
  std::optional<st::Machine> machine_;
  RegisterTransfer transfer_;
};

}  // namespace trunnion::plc
