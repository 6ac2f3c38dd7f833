// SPDX-License-Identifier: Apache-2.0
// The MTConnect agent on a port and a thread of its own, so that none of its clients delays an order.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "cluster_side/mailbox.hpp"
#include "mtconnect/agent.hpp"

namespace trunnion::gateway::mtconnect {

class Server {
 public:
  /// Listens at once. Throws std::runtime_error saying address, port and reason.
  Server(const std::string& address, std::uint16_t port, Mailbox& mailbox, AgentSettings settings);
  ~Server();

 private:
  struct Inside;
  std::unique_ptr<Inside> inside_;
};

}  // namespace trunnion::gateway::mtconnect
