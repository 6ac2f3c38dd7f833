// SPDX-License-Identifier: Apache-2.0
// What goes wrong with an order to a channel, told apart from what was shown already.
#pragma once

#include <string>

#include "cluster/client.hpp"

namespace trunnion::cli {

/// The errors of a channel that come behind its state of now. A new reader finds older ones first: they are
/// not those of the order that follows.
class NewAlarms {
 public:
  /// Throws std::runtime_error when the channel publishes no state.
  NewAlarms(cluster::Client& client, std::uint16_t channel);

  /// The newest error, "alarm NUMBER: TEXT"; empty while there is none.
  const std::string& error();

 private:
  std::uint16_t channel_;
  bus::Reader<idl::service::Alarm> alarms_;
  std::int64_t began_ = 0;  ///< source time of the state: the channel writes its alarms by the same clock
  std::string error_;
};

}  // namespace trunnion::cli
