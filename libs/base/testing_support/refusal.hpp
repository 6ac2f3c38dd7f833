// SPDX-License-Identifier: Apache-2.0
// For fuzzers of files that people write.
#pragma once

#include <cctype>
#include <cstdlib>
#include <stdexcept>
#include <string>

namespace trunnion::testing_support {

/// Runs `read`; a std::runtime_error must begin with `file`:line:column, else the program aborts. Any other
/// exception goes on.
template <class Read>
void taken_or_refused(const std::string& file, Read read) {
  try {
    read();
  } catch (const std::runtime_error& e) {
    const std::string what = e.what();
    const auto number_then_colon = [&](std::size_t at) {
      std::size_t end = at;
      while (end < what.size() && std::isdigit(static_cast<unsigned char>(what[end])) != 0) ++end;
      if (end == at || end == what.size() || what[end] != ':') std::abort();
      return end + 1;
    };
    if (!what.starts_with(file + ":")) std::abort();
    number_then_colon(number_then_colon(file.size() + 1));
  }
}

/// The text of the std::runtime_error that `read` throws, or "taken".
template <class Read>
std::string refusal_of(Read read) {
  try {
    read();
  } catch (const std::runtime_error& e) {
    return e.what();
  }
  return "taken";
}

}  // namespace trunnion::testing_support
