// SPDX-License-Identifier: Apache-2.0
// Blocks as Haas mills write them.
#pragma once

#include "language/iso_dialect.hpp"

namespace trunnion::language {

/// Lines, words, variables and statements are those of the ISO dialect. The functions are those of
/// haas_codes.hpp, of which each becomes the code that does the same here, and the system variables those of
/// haas_variables.hpp. What the words of cycles, dwells and tool offsets mean is said by Block::haas.
class HaasDialect final : public Dialect {
 public:
  DialectRules rules() const override;
  Fault read_block(std::string_view line, SkipLevels skip, Variables& variables, Block& block) const override;
  Fault read_condition(std::string_view line, std::uint16_t rest, const Variables& variables,
                       bool& condition) const override {
    return words_.read_condition(line, rest, variables, condition);
  }
  Outline outline(std::string_view line, SkipLevels skip) const override {
    return words_.outline(line, skip);
  }
  Leader leader(std::string_view line) const override { return words_.leader(line); }

 private:
  IsoDialect words_;
};

}  // namespace trunnion::language
