// SPDX-License-Identifier: Apache-2.0
// Requests to the PLC's programs while they run.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "cluster/client.hpp"
#include "commands.hpp"
#include "plc/semantics/type.hpp"

namespace trunnion::cli {

using idl::plc::OnlineAction;
using idl::plc::OnlineReply;
using idl::plc::OnlineRequest;

/// The values of a watch list or of a row of a trace, as text.
class ShownVariables {
 public:
  explicit ShownVariables(const std::vector<idl::plc::VariableInfo>& variables);
  std::size_t size() const { return variables_.size(); }
  std::size_t cells() const { return cells_; }
  const idl::plc::VariableInfo& info(std::size_t i) const { return variables_[i]; }
  /// A literal of the language, of each variable; `cells` has at least cells().
  std::vector<std::string> texts(std::span<const std::uint64_t> cells) const;

 private:
  std::vector<idl::plc::VariableInfo> variables_;
  std::vector<st::Type> types_;
  std::size_t cells_ = 0;
};

class PlcSession {
 public:
  /// Throws std::runtime_error when no cluster runs.
  explicit PlcSession(const Common& common);

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
  cluster::Client client_;
  service::RequestClient<OnlineRequest, OnlineReply> requests_;
};

}  // namespace trunnion::cli
