// SPDX-License-Identifier: Apache-2.0
#include "cluster_side/mailbox.hpp"

#include <algorithm>

#include "commands/command_table.hpp"

namespace trunnion::gateway {

Links::Links(bus::Bus& bus)
    : channel(bus, topics::channel_request, topics::channel_reply),
      panel(bus, topics::panel_request, topics::panel_reply),
      parameters(bus, topics::parameter_request, topics::parameter_reply),
      program(bus, topics::program_request, topics::program_reply),
      online(bus, topics::online_request, topics::online_reply),
      measurement(bus, topics::measurement_request, topics::measurement_reply),
      alarm_resets(bus),
      journal(bus) {}

bool Links::receive() {
  const bool any[] = {channel.receive(), panel.receive(),  parameters.receive(),
                      program.receive(), online.receive(), measurement.receive()};
  return std::find(std::begin(any), std::end(any), true) != std::end(any);
}

void Links::pump(double now) {
  channel.pump(now);
  panel.pump(now);
  parameters.pump(now);
  program.pump(now);
  online.pump(now);
  measurement.pump(now);
}

std::optional<double> Links::period() const {
  std::optional<double> shortest;
  for (const auto& period : {channel.period(), panel.period(), parameters.period(), program.period(),
                             online.period(), measurement.period()})
    if (period) shortest = std::min(*period, shortest.value_or(*period));
  return shortest;
}

void Links::withdraw_stops(const idl::channel::ChannelRequest& start) {
  idl::channel::ChannelReply reply{};
  reply.reason = "not repeated: an order that starts motion followed before the channel answered";
  channel.withdraw([&](const auto& other) { return other.channel == start.channel; }, reply);
}

void Links::withdraw_starts(const idl::channel::ChannelRequest& stop) {
  using idl::channel::CommandKind;
  idl::channel::ChannelReply reply{};
  reply.reason = "not repeated: an order that stops motion followed before the channel answered";
  channel.cease(
      [&](const auto& other) {
        return other.channel == stop.channel &&
               commands::motion_of(other.command) == commands::Motion::starts &&
               (stop.command != CommandKind::JOG_STOP || other.command == CommandKind::JOG_AXIS);
      },
      reply);
}

void Links::repeat_only(const idl::channel::ChannelRequest& stop) {
  channel.withdraw([&](const auto& other) {
    return other.channel == stop.channel && other.command == stop.command && other.axis == stop.axis;
  });
}

void Mailbox::post(Job job) {
  {
    const std::lock_guard lock(mutex_);
    jobs_.push_back(std::move(job));
  }
  wake_();
}

std::shared_ptr<const ClusterState> Mailbox::newest() const {
  const std::lock_guard lock(mutex_);
  return newest_;
}

std::vector<Job> Mailbox::take() {
  const std::lock_guard lock(mutex_);
  return std::exchange(jobs_, {});
}

void Mailbox::publish(std::shared_ptr<const ClusterState> cluster) {
  const std::lock_guard lock(mutex_);
  newest_.swap(cluster);
}

}  // namespace trunnion::gateway
