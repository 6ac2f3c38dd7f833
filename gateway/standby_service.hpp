// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cluster_view.hpp"
#include "service/node.hpp"
#include "src/lasting_difference.hpp"

namespace trunnion::gateway {

/// The gateway as long as another one has the port: it reads the same cluster and compares what it would
/// show with what the other one shows its clients. It writes nothing.
class StandbyService : public service::Service {
 public:
  /// `port` of the running gateway on this computer.
  StandbyService(service::Node& node, std::uint16_t port);
  void pump() override;
  service::Health health() const override;

 private:
  void compare(double now);

  ClusterView view_;
  std::uint16_t port_;
  LastingDifference comparison_;
  double compared_ = 0;
  bool no_answer_ = false;
};

}  // namespace trunnion::gateway
