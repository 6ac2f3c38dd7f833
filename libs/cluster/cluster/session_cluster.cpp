// SPDX-License-Identifier: Apache-2.0
#include "cluster/session_cluster.hpp"

#include <cstdio>
#include <exception>

namespace trunnion::cluster {

SessionCluster::SessionCluster(const std::string& machine, std::optional<std::uint32_t> domain)
    : own_(!machine.empty()) {
  if (!own_) {
    cluster_ = find_cluster(domain);
    return;
  }
  UpOptions up;
  up.machine = machine, up.state_directory = "temporary", up.domain = domain, up.own_domain = !domain;
  up.virtual_time = true, up.with_gateway = false, up.one_host = true;
  up.of_this_process = true;
  cluster_ = start_cluster(up);
}

SessionCluster::~SessionCluster() {
  try {
    if (own_) stop_cluster(cluster_.run);
  } catch (const std::exception& e) {
    std::fprintf(stderr, "trunnion: %s\n", e.what());
  }
}

}  // namespace trunnion::cluster
