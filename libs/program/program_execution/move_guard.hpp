// SPDX-License-Identifier: Apache-2.0
// What checks the moves of a program before motion gets them.
#pragma once

#include <cstdint>
#include <string>

#include "language/canonical.hpp"

namespace trunnion::program_execution {

using language::AxisValues;

class MoveGuard {
 public:
  enum class Verdict : std::uint8_t {
    free,        ///< motion may have the move
    contact,     ///< it may not: contact_text()
    unfinished,  ///< to be asked again about the same move
  };

  virtual ~MoveGuard() = default;
  /// A run of a flow begins: what was checked before does not count.
  virtual void begin_run() = 0;
  /// A call of ProgramFlow::fill() begins, which allows a fixed amount of work.
  virtual void begin_call() = 0;
  /// `from` and `move` in the frame of the move.
  virtual Verdict check(const AxisValues& from, const language::Command& move) = 0;
  /// One line for the operator that begins with the line of the move.
  virtual const std::string& contact_text() const = 0;
};

}  // namespace trunnion::program_execution
