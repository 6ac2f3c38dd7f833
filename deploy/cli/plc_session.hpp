// SPDX-License-Identifier: Apache-2.0
// Requests to the PLC's programs while they run.
#pragma once

#include "cluster/client.hpp"
#include "commands.hpp"
#include "plc/online/shown_variables.hpp"

namespace trunnion::cli {

using idl::plc::OnlineAction;
using idl::plc::OnlineReply;
using idl::plc::OnlineRequest;
using plc_online::ShownVariables;

class PlcSession {
 public:
  /// Throws std::runtime_error when no cluster runs.
  explicit PlcSession(const Common& common);

  std::uint32_t domain() const { return domain_; }
  bus::Bus& bus() { return client_.bus(); }
  /// Throws std::runtime_error with the reason when it is refused or the PLC does not answer.
  OnlineReply call(OnlineRequest request);
  OnlineReply call(OnlineAction action);
  /// The newest state of a topic of the PLC.
  template <class T>
  T newest(const bus::Topic<T>& topic) {
    return client_.newest(topic, 5);
  }

 private:
  std::uint32_t domain_;
  cluster::Client client_;
  service::RequestClient<OnlineRequest, OnlineReply> requests_;
};

}  // namespace trunnion::cli
