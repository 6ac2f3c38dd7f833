// SPDX-License-Identifier: Apache-2.0
// The gateway on standby, which `trunnion swap gateway` compares with the one that runs.
#pragma once

#include "cluster_side/cluster_view.hpp"
#include "core/lasting_difference.hpp"
#include "http_client/client.hpp"
#include "service/node.hpp"

namespace trunnion::gateway {

/// The gateway as long as another one has the port: it reads the same cluster and compares what it would
/// show with what the other one shows its clients. It writes nothing.
class StandbyService : public service::Service {
 public:
  /// `gateway` that runs on this computer. `change`: as of ClusterView.
  StandbyService(service::Node& node, const http_client::Server& gateway, FeedbackChange change = {});
  void pump() override;
  service::Health health() const override;

 private:
  void compare(double now);

  ClusterView view_;
  http_client::Server gateway_;
  LastingDifference comparison_;
  double compared_ = 0;
  bool no_answer_ = false;
};

}  // namespace trunnion::gateway
