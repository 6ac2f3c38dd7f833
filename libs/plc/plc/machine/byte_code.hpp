// SPDX-License-Identifier: Apache-2.0
// A compiled program: code, tables, the initial memory.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "plc/machine/instruction.hpp"
#include "plc/machine/register_area.hpp"
#include "plc/syntax/diagnostics.hpp"

namespace trunnion::st {

/// A routine is a program, function or function block. It calls only routines before it, so there is no
/// recursion.
struct Routine {
  std::uint32_t entry = 0, end = 0;  ///< its instructions
  std::uint32_t frame = 0;           ///< cells
  bool operator==(const Routine&) const = default;
};

struct Range {
  std::int64_t low = 0, high = 0, stride = 1;
  bool operator==(const Range&) const = default;
};

/// A program of a task, or a test: a routine with its frame in memory.
struct Entry {
  std::string name;  ///< in capitals
  std::uint32_t routine = 0, base = 0;
  bool is_test = false;
  bool operator==(const Entry&) const = default;
};

/// Consecutive cells.
struct Cells {
  std::uint32_t first = 0, count = 0;
  bool operator==(const Cells&) const = default;
};

struct LineEntry {
  std::uint32_t instruction = 0;  ///< the first one of this place
  Position at;
};

/// What an assertion compares, for the message; in cells of the frame.
struct Assertion {
  enum class Kind : std::uint32_t {
    condition,
    integer,
    unsigned_integer,
    real,
    lreal
  } kind = Kind::condition;
  std::int32_t actual = 0, expected = 0;
  bool operator==(const Assertion&) const = default;
};

/// A variable that pointers reach: as many equal elements, of which each is so many cells, and so many bytes
/// for pointers. Those with the same `element` have elements of one type.
struct Pointed {
  /// Which bytes of an element pointers to other types reach: none, those of its number, those of its string.
  enum class View : std::uint32_t { none, number, string } view = View::none;
  std::uint32_t element = 0, count = 1, cells = 1, bytes = 1;
  std::uint32_t form = 0;  ///< of a number, as in Op::narrow
  bool operator==(const Pointed&) const = default;
};

struct ByteCode {
  std::vector<Instruction> code;
  std::vector<Routine> routines;
  std::vector<Range> ranges;
  std::vector<Assertion> assertions;
  std::vector<Pointed> pointed;
  std::vector<Entry> entries;
  std::vector<std::uint64_t> initial;   ///< memory at the start; its size is the size of the memory
  std::vector<std::uint32_t> timers;    ///< addresses of pairs (end in ns, running) of timers
  std::vector<Cells> retained;          ///< of VAR RETAIN
  std::vector<UsedRegister> registers;  ///< to be copied in and out by whoever runs it
  // Not needed to run:
  std::vector<LineEntry> lines;  ///< ascending
  std::vector<std::string> files;
  std::vector<RegisterAddress> retained_registers;  ///< of VAR RETAIN with AT

  Position place_of(std::uint32_t instruction) const;
  /// Identifies the code with its tables.
  std::uint64_t identity() const;
};

/// Without `lines` and `files`.
std::vector<std::uint8_t> encode(const ByteCode& code);
/// Nothing when the bytes are no byte code or exceed the limits of memory and tables. The result is to be
/// verified.
std::optional<ByteCode> decode(std::span<const std::uint8_t> bytes);

/// Statements of one run of a task: more are a fault.
inline constexpr std::int64_t task_budget = 100000;
inline constexpr std::uint32_t most_cells = 1u << 20;
inline constexpr std::uint32_t most_instructions = 1u << 22;
inline constexpr std::uint32_t most_pointed = 1u << 15;

}  // namespace trunnion::st
