// SPDX-License-Identifier: Apache-2.0
#include "structured_text.hpp"

#include <algorithm>

#include "plc/translation.hpp"

namespace trunnion::plc {
namespace {

constexpr std::int64_t millisecond = 1000000;  // ns

}  // namespace

StructuredText::StructuredText(StructuredPrograms programs) : programs_(std::move(programs)) {
  st::require_cells(*programs_.code);
  machine_.emplace(programs_.code);
  transfer_ = RegisterTransfer(programs_.code->registers);
  identity_ = programs_.code->identity();
}

void StructuredText::take(const ProgramVariables& variables) {
  auto memory = machine_->memory();
  std::copy_n(variables.values.begin(), memory.size() - st::image_cells, memory.begin() + st::image_cells);
}

void StructuredText::give(ProgramVariables& variables) const {
  const auto memory = machine_->memory().subspan(st::image_cells);
  std::copy(memory.begin(), memory.end(), variables.values.begin());
}

bool StructuredText::fits(const ProgramVariables& variables) const {
  return machine_ ? variables.layout == programs_.layout &&
                        variables.cells == machine_->memory().size() - st::image_cells
                  : variables.cells == 0;
}

void StructuredText::reset(ProgramVariables& variables) {
  variables = {};
  if (!machine_) return;
  machine_->reset();
  variables.layout = programs_.layout;
  variables.identity = identity_;
  variables.cells = static_cast<std::uint32_t>(machine_->memory().size() - st::image_cells);
  give(variables);
}

void StructuredText::restore(ProgramVariables& variables) {
  if (!fits(variables)) return reset(variables);
  if (!machine_) return;
  if (variables.identity != identity_) {
    variables.fault = {};
    variables.main = {};
    variables.identity = identity_;
  }
  take(variables);
}

void StructuredText::power_up(const ProgramVariables& kept, ProgramVariables& variables) {
  reset(variables);
  if (!machine_ || !fits(kept)) return;
  for (const auto& cells : programs_.code->retained) {
    const auto first = cells.first - st::image_cells;
    std::copy_n(kept.values.begin() + first, cells.count, variables.values.begin() + first);
  }
  take(variables);
}

std::span<const st::RegisterAddress> StructuredText::retained_registers() const {
  if (!machine_) return {};
  return programs_.code->retained_registers;
}

bool StructuredText::uses(st::Area area, std::uint16_t index) const {
  if (!machine_) return false;
  const auto& used = programs_.code->registers;
  return std::any_of(used.begin(), used.end(),
                     [&](const auto& one) { return one.area == area && one.index == index; });
}

void StructuredText::put(std::uint32_t cell, std::uint64_t value, ProgramVariables& variables) {
  if (!machine_ || cell < st::image_cells || cell >= machine_->memory().size()) return;
  machine_->memory()[cell] = value;
  variables.values[cell - st::image_cells] = value;
}

void StructuredText::run(TaskName task, Registers& registers, ProgramVariables& variables, std::uint64_t now,
                         std::int64_t part) {
  transfer_.load(registers, machine_->memory());
  const auto entry = *programs_.entries[static_cast<std::size_t>(task)];
  const auto time = static_cast<std::int64_t>(now) * millisecond;
  const auto fault = task == TaskName::main
                         ? machine_->run_part(entry, time, most_statements, part, variables.main)
                         : machine_->run(entry, time, most_statements);
  transfer_.store(machine_->memory(), registers);
  give(variables);
  if (fault.kind == st::FaultKind::none) return;
  variables.fault = {static_cast<std::uint32_t>(fault.kind),
                     static_cast<std::uint32_t>(task),
                     fault.instruction,
                     0,
                     fault.value,
                     fault.low,
                     fault.high};
}

std::optional<std::uint64_t> StructuredText::next_timer_end(std::uint64_t now) const {
  if (!machine_) return std::nullopt;
  const auto end = machine_->next_timer_end(static_cast<std::int64_t>(now) * millisecond);
  if (!end) return std::nullopt;
  return static_cast<std::uint64_t>((*end + millisecond - 1) / millisecond);
}

bool StructuredText::timer_due(std::uint64_t now) const {
  return machine_ && machine_->timer_due(static_cast<std::int64_t>(now) * millisecond);
}

std::string StructuredText::fault_text(const ProgramVariables& variables) const {
  const auto& kept = variables.fault;
  if (kept.kind == 0 || !machine_) return "";
  const st::Fault fault{static_cast<st::FaultKind>(kept.kind), kept.instruction, kept.value, kept.low,
                        kept.high};
  const auto at = programs_.code->place_of(kept.instruction);
  const auto& files = programs_.code->files;
  return (at.file < files.size() ? files[at.file] : std::string("?")) + ":" + std::to_string(at.line) + ":" +
         std::to_string(at.column) + ": error: " + st::text_of(fault) + " in the " +
         std::array{"fast", "main", "simulation"}.at(std::min<std::size_t>(kept.task, 2)) +
         " task; the outputs are in the safe state. Correct the program or its "
         "inputs, then reset the alarms";
}

}  // namespace trunnion::plc
