// SPDX-License-Identifier: Apache-2.0
// Runs byte code.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "plc/machine/byte_code.hpp"
#include "plc/machine/fault.hpp"

namespace trunnion::st {

/// Where a run was interrupted, so that the next one continues there. All zero: it begins.
struct Progress {
  static constexpr std::uint32_t most_callers = 32;
  struct Caller {
    std::uint32_t instruction = 0, base = 0;
    bool operator==(const Caller&) const = default;

    template <class Self, class Visit>
    static void fields(Self& self, Visit&& visit) {
      visit("instruction", self.instruction), visit("base", self.base);
    }
  };
  std::uint32_t interrupted = 0;  ///< 1: the members below are valid
  std::uint32_t instruction = 0, base = 0, depth = 0;
  std::uint64_t statements = 0;  ///< since the run began
  std::array<Caller, most_callers> callers{};
  bool operator==(const Progress&) const = default;

  /// For libs/cluster/snapshot.
  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("interrupted", self.interrupted), visit("instruction", self.instruction), visit("base", self.base);
    visit("depth", self.depth), visit("statements", self.statements), visit("callers", self.callers);
  }
};

class Machine {
 public:
  /// Throws std::invalid_argument when the code does not pass verify().
  explicit Machine(std::shared_ptr<const ByteCode> code);

  /// Every variable has its initial value.
  void reset();
  /// One run of the entry. `now` in ns; `budget` in statements. No allocation. Variables keep what they had
  /// at a fault.
  Fault run(std::size_t entry, std::int64_t now, std::int64_t budget);
  /// The same in parts: at most `part` statements, then `progress` says where to continue. Calls deeper than
  /// Progress::most_callers are not interrupted. `budget` is of the whole run; `now` of its present part.
  Fault run_part(std::size_t entry, std::int64_t now, std::int64_t budget, std::int64_t part,
                 Progress& progress);
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
  using Caller = Progress::Caller;
  Fault execute(std::size_t entry, std::int64_t now, std::int64_t budget, std::int64_t reserve,
                Progress* progress);
  std::shared_ptr<const ByteCode> code_;
  std::vector<std::uint64_t> memory_;
  std::vector<Caller> callers_;
  std::int64_t statements_ = 0;
  std::uint32_t last_frame_ = 0;
};

}  // namespace trunnion::st
