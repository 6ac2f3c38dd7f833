// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <cstdio>
#include <exception>
#include <optional>
#include <string>

#include "cluster/cluster.hpp"

namespace trunnion::cli {

/// The cluster that a command works with: the one that runs, or one of its own in virtual time, which ends
/// with this.
class SessionCluster {
 public:
  /// `machine`: folder or name, empty for the cluster that runs in `domain`. Throws std::runtime_error when
  /// there is none or it does not start.
  SessionCluster(const std::string& machine, std::optional<std::uint32_t> domain) : own_(!machine.empty()) {
    if (!own_) {
      cluster_ = cluster::find_cluster(domain);
      return;
    }
    cluster::UpOptions up;
    up.machine = machine, up.state_directory = "temporary", up.domain = domain, up.own_domain = !domain;
    up.virtual_time = true, up.with_gateway = false, up.one_host = true;
    up.of_this_process = true;
    cluster_ = cluster::start_cluster(up);
  }
  ~SessionCluster() {
    try {
      if (own_) cluster::stop_cluster(cluster_.run);
    } catch (const std::exception& e) {
      std::fprintf(stderr, "trunnion: %s\n", e.what());
    }
  }
  SessionCluster(const SessionCluster&) = delete;
  SessionCluster& operator=(const SessionCluster&) = delete;

  const cluster::RunningCluster& running() const { return cluster_; }
  bool own() const { return own_; }

 private:
  cluster::RunningCluster cluster_;
  bool own_;
};

}  // namespace trunnion::cli
