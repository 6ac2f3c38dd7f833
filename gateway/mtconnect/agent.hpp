// SPDX-License-Identifier: Apache-2.0
// An MTConnect agent without sockets and clock: takes states of the machine, answers requests.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>

#include "core/cluster_state.hpp"
#include "mtconnect/documents.hpp"
#include "mtconnect/request.hpp"

namespace trunnion::gateway::mtconnect {

struct AgentSettings {
  std::string machine, title;        ///< of machine.yaml
  std::string computer;              ///< name of this computer
  std::uint64_t instance = 1;        ///< s since 1970-01-01 UTC
  std::size_t buffer_size = 131072;  ///< observations
  std::size_t channels = 1;          ///< of machine.yaml: all must have reported before the device is known
  std::map<std::uint32_t, std::uint32_t> channel_of;  ///< instance of a channel service -> its channel
};

class Agent {
 public:
  explicit Agent(AgentSettings settings) : settings_(std::move(settings)) {}

  /// What has changed since the state before becomes observations of this time (ISO 8601, UTC, ms).
  void observe(const ClusterState& cluster, const std::string& time);

  /// The document that answers `request`. Throws RequestError.
  std::string answer(const Request& request, const std::string& now) const;
  Request parse(std::string_view method, std::string_view target) const;
  std::string error(const RequestError& error, const std::string& now) const;

  /// A part of a stream: the observations from `from` on.
  struct Part {
    std::string document;
    std::uint64_t next = 0;  ///< where the following part begins
    bool any = false;        ///< it has observations
  };
  /// Throws RequestError OUT_OF_RANGE when `from` is not in the buffer any more.
  Part part(const Request& request, std::uint64_t from, const std::string& now) const;

  /// Null before the machine has published its parameters.
  const Device* device() const { return device_ ? &*device_ : nullptr; }
  const Buffer& buffer() const { return *buffer_; }

 private:
  void rebuild(const ClusterState& cluster, const std::string& time);
  void observe_tools(const ClusterState& cluster, const std::string& time);
  void observe_conditions(const ClusterState& cluster, const std::string& time);
  void set(std::uint32_t item, const std::string& value, const std::string& time);
  std::string assets(const Request& request, const std::string& now) const;
  AgentHeader header(const std::string& now) const;
  const Device& known_device() const;

  AgentSettings settings_;
  std::optional<Device> device_;
  std::vector<const DataItem*> items_;
  std::optional<Buffer> buffer_;
  std::string model_changed_;
  std::vector<std::string> values_;  ///< newest of each sample and event
  struct Active {
    Level level;
    std::string text, severity;
    bool operator==(const Active&) const = default;
  };
  std::map<std::pair<std::uint32_t, std::string>, Active> active_;  ///< conditions by item and code
  std::map<std::uint32_t, ToolAsset> tools_;
  std::shared_ptr<const idl::parameters::ToolTable> table_;
  std::uint64_t rebuilt_ = 0;  ///< devices before this one
  std::uint64_t revision_ = 0;
};

}  // namespace trunnion::gateway::mtconnect
