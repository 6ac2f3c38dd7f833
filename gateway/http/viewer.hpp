// SPDX-License-Identifier: Apache-2.0
// A WebSocket client: who it is, and what the hub tells it.
#pragma once

#include <memory>
#include <string>

#include "contracts/types.hpp"
#include "core/cluster_state.hpp"

namespace trunnion::gateway {

/// Who opened a stream.
struct Visitor {
  idl::gateway::Sender sender;
  std::string peer;                    ///< address
  std::string cookies, authorization;  ///< headers
};

class Viewer {
 public:
  explicit Viewer(Visitor visitor) : visitor_(std::move(visitor)) {}
  virtual ~Viewer() = default;
  const std::string& peer() const { return visitor_.peer; }
  /// There is something new.
  virtual void offer(const std::shared_ptr<const ClusterState>& newest) = 0;
  /// Once a second.
  virtual void each_second() = 0;
  /// Another stream takes its place.
  virtual void close() = 0;

 protected:
  const Visitor visitor_;
};

}  // namespace trunnion::gateway
