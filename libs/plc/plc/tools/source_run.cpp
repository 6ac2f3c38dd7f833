// SPDX-License-Identifier: Apache-2.0
#include "plc/tools/source_run.hpp"

#include <algorithm>
#include <span>
#include <stdexcept>

#include "plc/machine/arithmetic.hpp"
#include "plc/tools/value_text.hpp"

namespace trunnion::st {
namespace {

std::string shown(Assertion::Kind kind, std::uint64_t cell) {
  switch (kind) {
    case Assertion::Kind::integer:
      return std::to_string(as_signed(cell));
    case Assertion::Kind::unsigned_integer:
      return std::to_string(cell);
    case Assertion::Kind::real:
      return value_text(*elementary(Kind::real), std::span(&cell, 1));
    case Assertion::Kind::lreal:
      return value_text(*elementary(Kind::lreal), std::span(&cell, 1));
    case Assertion::Kind::condition:
      break;
  }
  return "";
}

}  // namespace

std::string fault_line(const Compilation& compilation, const Machine& machine, const Fault& fault) {
  const auto at = machine.code().place_of(fault.instruction);
  std::string text = text_of(fault);
  if (fault.kind == FaultKind::assertion) {
    const auto& assertion = machine.code().assertions[static_cast<std::size_t>(fault.value)];
    const auto cell = [&](std::int32_t offset) {
      return machine.memory()[machine.last_frame() + static_cast<std::uint32_t>(offset)];
    };
    if (assertion.kind != Assertion::Kind::condition)
      text = "expected " + shown(assertion.kind, cell(assertion.expected)) + ", found " +
             shown(assertion.kind, cell(assertion.actual));
  }
  const auto file = at.file < compilation.files.size() ? compilation.files[at.file] : std::string("?");
  return file + ":" + std::to_string(at.line) + ":" + std::to_string(at.column) + ": " + text;
}

SourceRun::SourceRun(const Compilation& compilation)
    : compilation_(compilation), variables_(compilation), machine_(compilation.code) {}

void SourceRun::set(const std::string& path, const std::string& text) {
  const auto at = variables_.find(path);
  std::vector<std::uint64_t> value(at.type->cells);
  try {
    set_value(*at.type, text, value);
  } catch (const std::runtime_error& e) {
    throw std::runtime_error(path + ": " + e.what());
  }
  auto cells = machine_.memory().subspan(at.address, at.type->cells);
  if (at.bit >= 0)
    cells[0] = (cells[0] & ~(std::uint64_t{1} << at.bit)) | (value[0] << at.bit);
  else if (at.is_register())
    cells[0] = static_cast<std::uint64_t>(register_number_of(at, value[0]));
  else
    std::copy(value.begin(), value.end(), cells.begin());
}

std::string SourceRun::get(const std::string& path) const {
  const auto at = variables_.find(path);
  const auto cells = machine_.memory().subspan(at.address, at.type->cells);
  if (!at.is_register()) return value_text(*at.type, cells);
  std::vector<std::uint64_t> values(cells.begin(), cells.end());
  if (at.type->cells == 1) values[0] = value_cell(at, values[0]);
  return value_text(*at.type, values);
}

Fault SourceRun::scan(const std::string& entry, std::int64_t period, std::int64_t budget) {
  if (!first_) now_ += period;
  first_ = false;
  const auto& entries = compilation_.code->entries;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    if (entries[i].is_test || (!entry.empty() && entries[i].name != entry)) continue;
    if (const auto fault = machine_.run(i, now_, budget); fault.kind != FaultKind::none) return fault;
  }
  return {};
}

std::vector<std::pair<std::string, std::string>> SourceRun::variables() const {
  std::vector<std::pair<std::string, std::string>> result;
  for (const auto& symbol : compilation_.symbols) result.emplace_back(symbol.path, get(symbol.path));
  return result;
}

std::vector<TestResult> run_tests(const Compilation& compilation) {
  std::vector<TestResult> results;
  Machine machine(compilation.code);
  const auto& code = *compilation.code;
  for (std::size_t i = 0; i < code.entries.size(); ++i) {
    if (!code.entries[i].is_test) continue;
    machine.reset();
    const auto fault = machine.run(i, 0, 100 * default_budget);
    const auto at = code.place_of(code.routines[code.entries[i].routine].entry);
    TestResult result{code.entries[i].name,
                      at.file < compilation.files.size() ? compilation.files[at.file] : "", true, ""};
    if (fault.kind != FaultKind::none) {
      result.passed = false;
      result.message = fault_line(compilation, machine, fault);
    }
    results.push_back(std::move(result));
  }
  return results;
}

}  // namespace trunnion::st
