// SPDX-License-Identifier: Apache-2.0
// Who looks at the blocks of a program, beside those who take its commands.
#pragma once

#include <cstdint>
#include <string_view>

#include "language/block.hpp"
#include "language/canonical.hpp"
#include "language/text_source.hpp"

namespace trunnion::language {

/// A line that was read and not executed yet. The references hold for the call only.
struct SeenBlock {
  const Block& block;          ///< its words, every expression resolved
  std::string_view line;       ///< its text
  std::uint32_t program;       ///< as Command::program
  std::uint32_t number;        ///< of the line, from 1
  const ModalState& modal;     ///< behind the block before it
  const AxisValues& position;  ///< likewise, in program coordinates: mm and degrees
  ProgramDialect dialect;      ///< of the text
};

class BlockWatch {
 public:
  virtual ~BlockWatch() = default;
  /// Sees each line of the programs that is not skipped, those of loops each time.
  virtual void begin(const SeenBlock& seen) = 0;
};

}  // namespace trunnion::language
