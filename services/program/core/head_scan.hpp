// SPDX-License-Identifier: Apache-2.0
// Finds the program number in the head of a text, as the interpreter reads heads.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "machine/program_number.hpp"

namespace trunnion::program {

/// Runs over the beginning of a text a piece at a time. The head is %1234, O1234 or :1234 in the first line
/// that is neither empty nor a comment, a lone % with its title, or text in front of the % with which a tape
/// begins.
class HeadScan {
 public:
  void add(std::span<const std::uint8_t> bytes);
  std::optional<machine::ProgramNumber> number() const;

 private:
  void end_line();

  std::string line_;          ///< beginning of the line that is not ended
  std::size_t bytes_ = 0;     ///< read so far
  bool behind_text_ = false;  ///< text came that is no block, and no % behind it
  bool done_ = false;
  std::optional<machine::ProgramNumber> number_;
};

}  // namespace trunnion::program
