// SPDX-License-Identifier: Apache-2.0
// A place of a recording that cannot be read.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace trunnion::recording {

struct Damage {
  std::uint64_t begin = 0, end = 0;             ///< bytes of the file
  std::uint64_t first_time = 0, last_time = 0;  ///< ns since the epoch, of the missing messages; 0 = unknown
  std::string what;
};

/// "bytes 2000 to 2799, messages of 2026-03-01T10:00:00.000Z to 10:00:01.250Z: the chunk fails its checksum".
std::string text_of(const Damage& damage);
/// The first three in one line, and how many more there are.
std::string text_of(const std::vector<Damage>& damages);

}  // namespace trunnion::recording
