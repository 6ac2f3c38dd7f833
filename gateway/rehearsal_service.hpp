#pragma once

#include "cluster_view.hpp"
#include "service/node.hpp"
#include "src/lasting_difference.hpp"

namespace trunnion::gateway {

/// The gateway as long as another one has the port: it looks at the same cluster and compares what it would
/// show with what the other one shows its clients. It writes nothing.
class RehearsalService : public service::Service {
 public:
  /// `port` of the running gateway on this computer.
  RehearsalService(service::Node& node, std::uint16_t port);
  void pump() override;
  service::Health health() const override;

 private:
  void look(double now);

  ClusterView view_;
  std::uint16_t port_;
  LastingDifference comparison_;
  double looked_ = 0;
  bool nobody_answers_ = false;
};

}  // namespace trunnion::gateway
