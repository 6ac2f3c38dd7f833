// SPDX-License-Identifier: Apache-2.0
// What was swapped for what, one JSON object per line, in the state directory.
#pragma once

#include <string>

#include "contracts/types.hpp"

namespace trunnion::launcher {

/// One of the two processes of a swap.
struct SwapSide {
  std::string executable;
  std::string vendor;
  std::string version, contract;  ///< as it announced itself
};

/// A line for the journal. The build is identified by the CRC-32 of the executable's bytes besides its
/// version.
std::string swap_line(const idl::service::SwapRequest& request, const idl::service::SwapReply& reply,
                      const SwapSide& before, const SwapSide& after);
/// A line for requests that were refused before anything was started: the newest one and how many since the
/// last line.
std::string refusal_line(const idl::service::SwapRequest& request, const std::string& why,
                         const std::string& time, std::uint64_t count);
/// Appends the line and returns when it is on the disk. Throws storage::StorageError.
void append_swap(const std::string& state_directory, const std::string& line);

}  // namespace trunnion::launcher
