// SPDX-License-Identifier: Apache-2.0
#include "new_alarms.hpp"

#include <stdexcept>

#include "machine/service_constants.hpp"

namespace trunnion::cli {
namespace {

constexpr double longest_wait = 30;  // s

std::int64_t time_of_state(cluster::Client& client, std::uint16_t channel) {
  auto states = client.reader_from_now(topics::channel_state);
  const double until = service::monotonic_seconds() + longest_wait;
  while (service::monotonic_seconds() < until) {
    for (idl::channel::ChannelState state; states.take(state);)
      if (state.channel == channel) return states.info().source_timestamp;
    client.bus().signal().wait(0.02);
  }
  throw std::runtime_error("channel " + std::to_string(channel) + " publishes no state");
}

}  // namespace

NewAlarms::NewAlarms(cluster::Client& client, std::uint16_t channel)
    : channel_(channel),
      alarms_(client.bus().reader(topics::alarm)),
      began_(time_of_state(client, channel)) {}

const std::string& NewAlarms::error() {
  for (idl::service::Alarm alarm; alarms_.take(alarm);)
    if (alarm.active && alarm.severity >= idl::service::Severity::ERROR && alarm.part == channel_ &&
        alarm.source == machine::service::channel.name && alarms_.info().source_timestamp > began_)
      error_ = "alarm " + std::to_string(alarm.number) + ": " + alarm.text;
  return error_;
}

}  // namespace trunnion::cli
