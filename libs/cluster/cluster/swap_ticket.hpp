// SPDX-License-Identifier: Apache-2.0
// Who may swap a service: who can write into the launcher's run directory, which only its user can.
#pragma once

#include <string>
#include <vector>

#include "contracts/types.hpp"

namespace trunnion::cluster {

using SwapRequest = idl::service::SwapRequest;

/// Writes the request into the run directory and gives it the token that names the file. Who listens in the
/// domain learns a token that is used up, and of a request that it does not fit. Throws std::runtime_error.
void put_ticket(const std::string& run_directory, SwapRequest& request);

/// Removes the file that the token names. Empty when it contains this request; otherwise the reason why the
/// request is refused.
std::string take_ticket(const std::string& run_directory, const SwapRequest& request);

/// Why this executable may not be started for a swap; empty when it may. It must be below one of
/// `directories`; it and every directory from there down must belong to this process's user or to root, and
/// be writable for nobody else.
std::string refused_executable(const std::string& executable, const std::vector<std::string>& directories);

}  // namespace trunnion::cluster
