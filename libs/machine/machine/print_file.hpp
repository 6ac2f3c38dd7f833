// SPDX-License-Identifier: Apache-2.0
// The files among the stored programs to which DPRNT adds lines.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace trunnion::machine {

inline constexpr std::string_view print_file_prefix = "DPRNT-";
inline constexpr std::uint64_t most_print_bytes = 4'000'000;  ///< of one file

/// It is one of them: it has no program number and calls find it under none.
constexpr bool is_print_file(std::string_view name) { return name.starts_with(print_file_prefix); }

/// "DPRNT-part.nc.txt" of program "part.nc"; of a channel above 0 "DPRNT-part.nc-1.txt". The end of a long
/// name is left out: at most 64 bytes.
inline std::string print_file(std::string_view program, std::uint16_t channel) {
  constexpr std::size_t longest = 51;  // 64 without the rest and a channel of two digits
  std::string name(print_file_prefix);
  name += program.substr(0, longest);
  if (channel != 0) name.append("-").append(std::to_string(channel));
  name += ".txt";
  return name;
}

}  // namespace trunnion::machine
