// SPDX-License-Identifier: Apache-2.0
// New programs beside the running ones: they get the same inputs, have no outputs, and what differs is noted.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "plc_core.hpp"

namespace trunnion::plc {

inline constexpr std::size_t most_told_differences = 100;

class OnlineComparison {
 public:
  /// Begins with the state of the running core and what `change` keeps. Allocates. The first comparison is of
  /// what one more run of the main task would change.
  OnlineComparison(const PlcCore& running, Programs next, st::Changeover change);

  /// Every call that changes the running core is made on this one too.
  PlcCore& core() { return core_; }
  /// Of the new programs.
  const st::Variables& variables() const { return variables_; }
  /// After each round, with the functions finished in it. Allocates only when something differs.
  void compare(const PlcCore& running, const std::vector<idl::plc::AuxiliaryDone>& done);

  /// Of 1 ms since it began.
  std::uint64_t scans() const { return core_.memory().scans - first_scan_; }
  /// Registers and variables that have differed.
  std::uint32_t differences() const { return differences_; }
  /// The first most_told_differences of them: tick, what, both values, the running one's first.
  const std::vector<std::string>& lines() const { return lines_; }

 private:
  void compare_registers(const Registers& running, const Registers& own);
  void compare_variables(const Memory& running);
  void differ(const std::string& what);

  st::Changeover change_;
  st::Variables variables_;
  PlcCore core_;
  std::uint64_t first_scan_ = 0;
  std::uint32_t differences_ = 0;
  std::vector<std::string> lines_;
  std::set<std::string> told_;
};

}  // namespace trunnion::plc
