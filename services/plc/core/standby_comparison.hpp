// SPDX-License-Identifier: Apache-2.0
// A PLC that repeats the rounds of the running one without outputs, and reports where it differs.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "plc_core.hpp"
#include "round.hpp"

namespace trunnion::plc {

class StandbyComparison {
 public:
  /// The parameters of a revision, nullptr when they have not arrived.
  using FindParameters = std::function<std::shared_ptr<const machine::Parameters>(std::uint64_t revision)>;

  /// `core` has its programs loaded.
  StandbyComparison(PlcCore core, bool virtual_time, FindParameters find)
      : core_(std::move(core)), virtual_time_(virtual_time), find_(std::move(find)) {}
  StandbyComparison(Programs programs, bool virtual_time, FindParameters find)
      : variables_(programs.variables), virtual_time_(virtual_time), find_(std::move(find)) {
    core_.load(std::move(programs));
  }

  enum class Outcome : std::uint8_t {
    equal,    ///< or nothing to compare: rounds of an older generation
    waiting,  ///< for parameters: repeat the same round
    gap,      ///< a round is missing: request a new start
    differs,  ///< difference() names it; nothing more is repeated
  };
  /// Repeats the round of the running PLC and compares the results. `generation` is the one requested last.
  Outcome play(const Round& round, std::uint32_t generation);

  /// Has loaded the running one's memory, and agrees with it since.
  bool in_step() const { return started_ && difference_.empty(); }
  /// Ticks of the drive over all equal rounds.
  std::uint64_t equal_ticks() const { return equal_ticks_; }
  /// "tick 1200, register R12: 1 and 0": the running one's value comes first. Empty without a difference.
  const std::string& difference() const { return difference_; }

 private:
  Outcome begin(const Round& round);
  bool parameters(std::uint64_t revision);
  bool repeat(const Step& step);
  Outcome compare(const Round& round, const Registers& before);
  Outcome differ(std::uint64_t tick, const std::string& what);
  Outcome differ(std::uint64_t tick, const Registers& before, const Changes& running, const Changes& own);

  st::Variables variables_;
  PlcCore core_;
  bool virtual_time_;
  FindParameters find_;
  bool started_ = false;
  std::uint32_t generation_ = 0;
  std::uint64_t number_ = 0, tick_ = 0, equal_ticks_ = 0;
  std::string difference_;
};

}  // namespace trunnion::plc
