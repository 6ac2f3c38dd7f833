// SPDX-License-Identifier: Apache-2.0
// The cluster of a command that moves axes: found, or started for it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "cluster/cluster.hpp"

namespace trunnion::cluster {

/// The cluster that a command works with: the one that runs, or one of its own in virtual time, which ends
/// with this.
class SessionCluster {
 public:
  /// `machine`: folder or name, empty for the cluster that runs in `domain`. Throws std::runtime_error when
  /// there is none or it does not start.
  SessionCluster(const std::string& machine, std::optional<std::uint32_t> domain);
  ~SessionCluster();
  SessionCluster(const SessionCluster&) = delete;
  SessionCluster& operator=(const SessionCluster&) = delete;

  const RunningCluster& running() const { return cluster_; }
  bool own() const { return own_; }

 private:
  RunningCluster cluster_;
  bool own_;
};

}  // namespace trunnion::cluster
