// SPDX-License-Identifier: Apache-2.0
// What a channel at rest leaves to the process that takes its place: text, so that another build can read it.
#pragma once

#include <string>

#include "contracts/types.hpp"
#include "language/canonical.hpp"
#include "switches.hpp"

namespace trunnion::channel {

struct HandOver {
  idl::channel::Mode mode = idl::channel::Mode::JOG;
  std::string program;  ///< selected, empty = none
  std::uint64_t program_revision = 0;
  std::string before_temporary;  ///< selected before a temporary program
  language::ModalState modal;    ///< of MDI
  std::uint32_t tool = 0;        ///< in the spindle
  Switches switches;
  double spindle_programmed = 0;  ///< 1/min
  std::uint32_t reset_count = 0;

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("mode", self.mode), visit("program", self.program);
    visit("program_revision", self.program_revision), visit("before_temporary", self.before_temporary);
    visit("tool", self.tool), visit("spindle_programmed", self.spindle_programmed);
    visit("reset_count", self.reset_count), visit("modal", self.modal);
    Switches::fields(self.switches, visit);
  }
};

/// A line `boot ...` that names this start of the cluster (any text without a line end), then write_lines().
std::string write_hand_over(const HandOver& hand_over, const std::string& boot);

/// Reads such a text; fields it does not have keep their value. Throws std::runtime_error with file:line
/// for what is no such line. False, and nothing is changed, when it was written in another `boot`.
bool read_hand_over(const std::string& text, const std::string& file, const std::string& boot,
                    HandOver& hand_over);

}  // namespace trunnion::channel
