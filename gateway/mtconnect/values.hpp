// SPDX-License-Identifier: Apache-2.0
// States of the machine -> values of MTConnect's data items.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/cluster_state.hpp"
#include "mtconnect/device_model.hpp"

namespace trunnion::gateway::mtconnect {

inline constexpr const char* unavailable = "UNAVAILABLE";

class ValuesOf {
 public:
  /// `channel_of`: instance of a channel service -> its channel.
  ValuesOf(const ClusterState& cluster, const std::map<std::uint32_t, std::uint32_t>& channel_of);
  /// Value of a sample or an event; UNAVAILABLE when the service that knows it is silent. Nothing for a
  /// condition and for what only a change reports.
  std::optional<std::string> of(const DataItem& item) const;

 private:
  std::optional<std::string> of_axis(const DataItem& item) const;
  std::optional<std::string> of_spindle(const DataItem& item) const;
  std::optional<std::string> of_channel(const DataItem& item) const;

  const ClusterState& cluster_;
  // A service that has never been heard of is not silent: what it has written counts.
  bool drive_ = true, plc_ = true;
  std::map<std::uint32_t, bool> silent_channels_;
};

/// An alarm, or a service that is silent, as a condition.
struct FoundCondition {
  Quantity quantity = Quantity::system;
  std::uint32_t part = 0;
  std::string code, severity, text;
  bool fault = false;  ///< else a warning
};
std::vector<FoundCondition> conditions_of(const ClusterState& cluster,
                                          const std::map<std::uint32_t, std::uint32_t>& channel_of);

}  // namespace trunnion::gateway::mtconnect
