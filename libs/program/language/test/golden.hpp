// SPDX-License-Identifier: Apache-2.0
// Programs and their canonical streams, feature by feature, from the folder golden/.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace trunnion::language::test {

/// A small program of golden/<feature>.nc, what it shows, and the stream golden/<feature>.stream has for it.
struct Golden {
  std::string shows;
  std::string program;  ///< its first line, a comment, says what it shows
  std::vector<std::string> commands;
};

/// The names of the files of programs, in alphabetical order.
std::vector<std::string> golden_features();

/// Throws std::runtime_error when the two files of a feature do not belong together.
std::vector<Golden> golden_programs(std::string_view feature);

}  // namespace trunnion::language::test
