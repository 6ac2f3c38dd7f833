// SPDX-License-Identifier: Apache-2.0
// Runs byte code.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>

#include "plc/machine/byte_code.hpp"

namespace trunnion::st {

enum class FaultKind : std::uint32_t {
  none,
  division,   ///< of integers by zero
  index,      ///< of an array
  range,      ///< of a subrange
  budget,     ///< more statements than permitted
  reference,  ///< an address outside the memory
  assertion,
};

/// Why a run has stopped before its end.
struct Fault {
  FaultKind kind = FaultKind::none;
  std::uint32_t instruction = 0;
  std::int64_t value = 0, low = 0, high = 0;  ///< of index and range
};

/// "division by zero", "index 12 is outside 0 .. 9" ...
std::string text_of(const Fault& fault);

class Machine {
 public:
  /// Throws std::invalid_argument when the code does not pass verify().
  explicit Machine(std::shared_ptr<const ByteCode> code);

  /// Every variable has its initial value.
  void reset();
  /// One run of the entry. `now` in ns; `budget` in statements. No allocation. Variables keep what they had
  /// at a fault.
  Fault run(std::size_t entry, std::int64_t now, std::int64_t budget);
  std::span<std::uint64_t> memory() { return memory_; }
  std::span<const std::uint64_t> memory() const { return memory_; }
  const ByteCode& code() const { return *code_; }
  /// Statements of the last run.
  std::int64_t statements() const { return statements_; }
  /// Address of the frame in which the last run ended, for the cells of an assertion.
  std::uint32_t last_frame() const { return last_frame_; }

  /// The earliest end in ns of a timer that runs and ends after `now`.
  std::optional<std::int64_t> next_timer_end(std::int64_t now) const;
  /// True when a timer's time has passed since the program last called it.
  bool timer_due(std::int64_t now) const;

 private:
  struct Caller {
    std::uint32_t instruction, base;
  };
  std::shared_ptr<const ByteCode> code_;
  std::vector<std::uint64_t> memory_;
  std::vector<Caller> callers_;
  std::int64_t statements_ = 0;
  std::uint32_t last_frame_ = 0;
};

}  // namespace trunnion::st
