// SPDX-License-Identifier: Apache-2.0
// Dialects of stored programs by the endings of their names (parameter 04c800).
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "canonical/program_dialect.hpp"

namespace trunnion::language {

class NameDialects {
 public:
  /// `.ngc linuxcnc; .haas haas`: an ending and its dialect, divided by semicolons; letters of either case.
  /// Throws std::runtime_error that names what is no dialect, lacks one, or is there twice.
  void add(std::string_view text);

  /// Of the longest ending that `name` has; nothing when it has none, and for an empty name.
  std::optional<canonical::ProgramDialect> of(std::string_view name) const;

 private:
  struct Rule {
    std::string ending;
    canonical::ProgramDialect dialect = canonical::ProgramDialect::iso;
  };
  std::vector<Rule> rules_;
};

}  // namespace trunnion::language
