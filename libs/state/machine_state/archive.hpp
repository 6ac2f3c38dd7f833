// SPDX-License-Identifier: Apache-2.0
// tar archives in memory, by libarchive.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace trunnion::machine_state {

struct Member {
  std::string name, bytes;
};

/// POSIX pax, without times and owners: the same members give the same bytes. Throws std::runtime_error.
std::string write_tar(const std::vector<Member>& members);
/// Regular files only. Throws std::runtime_error for anything that is no such archive, and above 1 GiB or
/// 10,000 members.
std::vector<Member> read_tar(const std::string& bytes);

}  // namespace trunnion::machine_state
