// SPDX-License-Identifier: Apache-2.0
// The services of another build in the place of the running ones, one after the other.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "cluster/cluster.hpp"
#include "contracts/types.hpp"
#include "machine/machine.hpp"

namespace trunnion::cluster {

/// One service: what runs now and what is to take its place.
struct Replacement {
  std::string shown;  ///< as in `status`
  idl::service::SwapRequest request;
  std::string running;  ///< path of the executable, to put it back
  std::string version;  ///< of what is to take its place
  idl::service::SwapReply reply;
};

/// Stages first: they are compared cycle by cycle where the machine moves. The drive, which holds the axes,
/// is last.
int place_in_order(const std::string& service);

/// The services of this host in the order of their replacement by the executables in `directory`. Throws
/// std::runtime_error when one cannot be started or is of another contract: then none is to be replaced.
std::vector<Replacement> plan_upgrade(const RunningCluster& cluster, const machine::MachineConfig& config,
                                      const idl::service::Cluster& list, const std::string& directory);

/// Asks the launcher for one replacement.
using Swap = std::function<idl::service::SwapReply(const idl::service::SwapRequest&)>;

/// Replaces one after the other; `replaced` is told of each with the number of those that are replaced. When
/// one is refused, puts those before it back, the newest first, and throws std::runtime_error.
void replace_all(std::vector<Replacement>& all, const Swap& swap,
                 const std::function<void(const Replacement& one, std::size_t count)>& replaced);

}  // namespace trunnion::cluster
