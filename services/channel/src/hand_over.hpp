// SPDX-License-Identifier: Apache-2.0
// What a channel at rest leaves to the process that takes its place: text, so that another build can read it.
#pragma once

#include <string>

#include "contracts/types.hpp"
#include "language/canonical.hpp"

namespace trunnion::channel {

struct HandOver {
  idl::channel::Mode mode = idl::channel::Mode::JOG;
  std::string program;  ///< selected, empty = none
  std::uint64_t program_revision = 0;
  language::ModalState modal;  ///< of MDI
  std::uint32_t tool = 0;      ///< in the spindle
  double feed_override = 1, rapid_override = 1, spindle_override = 1;
  double spindle_programmed = 0;  ///< 1/min
  bool single_block = false, optional_stop = false;
  std::uint32_t reset_count = 0;
};

/// A line `boot ...` that names this start of the cluster (any text without a line end), then one line
/// `name value` for each field, numbers exact to the bit.
std::string write_hand_over(const HandOver& hand_over, const std::string& boot);

/// Reads such a text; fields it does not have keep their value. Throws std::runtime_error with file:line
/// for what is no such line. False, and nothing is changed, when it was written in another `boot`.
bool read_hand_over(const std::string& text, const std::string& file, const std::string& boot,
                    HandOver& hand_over);

}  // namespace trunnion::channel
