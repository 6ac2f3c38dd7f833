// SPDX-License-Identifier: Apache-2.0
#include "mailbox.hpp"

namespace trunnion::gateway {

Links::Links(bus::Bus& bus)
    : channel(bus, topics::channel_request, topics::channel_reply),
      panel(bus, topics::panel_request, topics::panel_reply),
      parameters(bus, topics::parameter_request, topics::parameter_reply),
      program(bus, topics::program_request, topics::program_reply),
      alarm_resets(bus),
      journal(bus) {}

void Links::pump(double now) {
  for (const auto& [number, axis] : jog.expired(now)) {
    idl::channel::ChannelRequest stop{};
    stop.channel = number;
    stop.axis = axis;
    stop.command = idl::channel::CommandKind::JOG_STOP;
    channel.submit(
        stop,
        [this](const auto& asked, const auto&) {
          journal.write(jog_stop_line(asked.channel, asked.axis, {asked.client, asked.number, 1}));
        },
        now);
  }
  channel.pump(now);
  panel.pump(now);
  parameters.pump(now);
  program.pump(now);
}

bool Links::busy() const {
  return channel.busy() || panel.busy() || parameters.busy() || program.busy() || jog.watching();
}

void Mailbox::post(Job job) {
  {
    const std::lock_guard lock(mutex_);
    jobs_.push_back(std::move(job));
  }
  wake_();
}

std::shared_ptr<const Snapshot> Mailbox::newest() const {
  const std::lock_guard lock(mutex_);
  return newest_;
}

std::vector<Job> Mailbox::take() {
  const std::lock_guard lock(mutex_);
  return std::exchange(jobs_, {});
}

void Mailbox::publish(std::shared_ptr<const Snapshot> snapshot) {
  const std::lock_guard lock(mutex_);
  newest_.swap(snapshot);
}

}  // namespace trunnion::gateway
