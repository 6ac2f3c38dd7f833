// SPDX-License-Identifier: Apache-2.0
#include "plc/tools/program_run.hpp"

#include <algorithm>
#include <charconv>
#include <span>
#include <stdexcept>

#include "plc/machine/arithmetic.hpp"
#include "plc/syntax/token.hpp"
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

ProgramRun::ProgramRun(const Compilation& compilation)
    : compilation_(compilation), machine_(compilation.code) {}

ProgramRun::Location ProgramRun::find(const std::string& path) const {
  const auto refuse = [&](const std::string& why) -> Location {
    throw std::runtime_error("'" + path + "': " + why);
  };
  if (path.starts_with('%')) {
    const char* problem = "";
    const auto address = parse_register(upper_case(path.substr(1)), &problem);
    if (!address) return refuse(problem);
    const auto& area = info(address->area);
    if (!area.in_image) return refuse("set the variable AT this register");
    const auto kind = address->bit >= 0 ? Kind::boolean
                      : area.bits == 8  ? Kind::usint
                      : area.bits == 16 ? Kind::uint_
                                        : Kind::dint;
    return {elementary(kind), address_of(address->area, address->index), address->bit, 0};
  }
  const auto upper = upper_case(path);
  const Symbol* best = nullptr;
  for (const auto& symbol : compilation_.symbols) {
    const auto name = upper_case(symbol.path);
    const bool begins = upper.starts_with(name) && (upper.size() == name.size() ||
                                                    upper[name.size()] == '.' || upper[name.size()] == '[');
    if (begins && (best == nullptr || symbol.path.size() > best->path.size())) best = &symbol;
  }
  // A name without its program when only one program has it.
  if (best == nullptr)
    for (const auto& symbol : compilation_.symbols) {
      const auto dot = symbol.path.find('.');
      if (dot == std::string::npos) continue;
      const auto name = upper_case(symbol.path.substr(dot + 1));
      if (!upper.starts_with(name) ||
          (upper.size() != name.size() && upper[name.size()] != '.' && upper[name.size()] != '['))
        continue;
      if (best != nullptr) return refuse("several programs have it; write program.variable");
      best = &symbol;
    }
  if (best == nullptr) return refuse("there is no such variable");
  Location at{best->type, best->address, best->bit, 0};
  auto rest = upper;
  const auto full = upper_case(best->path);
  rest = upper.starts_with(full) ? upper.substr(full.size()) : upper.substr(full.size() - full.find('.') - 1);
  while (!rest.empty()) {
    if (rest[0] == '.') {
      const auto end = std::min(rest.find_first_of(".[", 1), rest.size());
      const auto name = rest.substr(1, end - 1);
      if (at.type->kind == Kind::structure) {
        const auto* field = at.type->field(name);
        if (field == nullptr) return refuse("there is no field '" + name + "'");
        at.type = field->type, at.address += field->offset;
      } else if (at.type->kind == Kind::block) {
        const auto& pou = *at.type->block->pou;
        const auto found = pou.names.find(name);
        if (found == pou.names.end()) return refuse("there is no variable '" + name + "'");
        at.type = found->second->type, at.address += static_cast<std::uint32_t>(found->second->place.offset);
      } else {
        return refuse(at.type->name + " has no members");
      }
      rest = rest.substr(end);
    } else {
      const auto end = rest.find(']');
      if (at.type->kind != Kind::array || end == std::string::npos)
        return refuse("no array, or ']' is missing");
      const char* digits = rest.data() + 1;
      std::int64_t stride = at.type->cells;
      for (const auto& dimension : at.type->dimensions) {
        std::int64_t number = 0;
        const auto parsed = std::from_chars(digits, rest.data() + end, number);
        if (parsed.ec != std::errc{} || number < dimension.low || number > dimension.high)
          return refuse("the index is outside " + std::to_string(dimension.low) + " .. " +
                        std::to_string(dimension.high));
        stride /= dimension.high - dimension.low + 1;
        at.address += static_cast<std::uint32_t>((number - dimension.low) * stride);
        digits = std::min(parsed.ptr + 1, static_cast<const char*>(rest.data() + end));
      }
      at.type = at.type->element;
      rest = rest.substr(end + 1);
    }
  }
  return at;
}

void ProgramRun::set(const std::string& path, const std::string& text) {
  const auto at = find(path);
  auto cells = machine_.memory().subspan(at.address, at.type->cells);
  if (at.bit < 0) {
    try {
      set_value(*at.type, text, cells);
    } catch (const std::runtime_error& e) {
      throw std::runtime_error(path + ": " + e.what());
    }
    return;
  }
  std::uint64_t bit = 0;
  set_value(*at.type, text, std::span(&bit, 1));
  cells[0] = (cells[0] & ~(std::uint64_t{1} << at.bit)) | (bit << at.bit);
}

std::string ProgramRun::get(const std::string& path) const {
  const auto at = find(path);
  const auto cells = machine_.memory().subspan(at.address, at.type->cells);
  if (at.bit < 0) return value_text(*at.type, cells);
  return (cells[0] >> at.bit) & 1u ? "TRUE" : "FALSE";
}

Fault ProgramRun::scan(const std::string& entry, std::int64_t period, std::int64_t budget) {
  if (!first_) now_ += period;
  first_ = false;
  const auto& entries = compilation_.code->entries;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    if (entries[i].is_test || (!entry.empty() && entries[i].name != entry)) continue;
    if (const auto fault = machine_.run(i, now_, budget); fault.kind != FaultKind::none) return fault;
  }
  return {};
}

std::vector<std::pair<std::string, std::string>> ProgramRun::variables() const {
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
