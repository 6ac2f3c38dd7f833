// SPDX-License-Identifier: Apache-2.0
#include "order_service.hpp"

#include "machine/alarm_constants.hpp"
#include "machine/axes.hpp"
#include "machine/parameter_constants.hpp"
#include "service/request.hpp"

namespace trunnion::plc {
namespace {

constexpr double quiet_period = 0.5;         // s after the start: keys that are pressed then are held already
constexpr double order_resend_period = 0.2;  // s
constexpr double longest_order_wait = 1;     // s for an answer

const machine::AlarmDefinition& alarm_of(st::MessageReaction reaction) {
  switch (reaction) {
    case st::MessageReaction::feed_hold:
      return alarm::plc_hold;
    case st::MessageReaction::axis_stop:
      return alarm::plc_stop;
    case st::MessageReaction::show:
      break;
  }
  return alarm::plc_hint;
}

}  // namespace

OrderService::OrderService(service::Node& node, PlcCore& core)
    : node_(node),
      core_(core),
      requests_(node.bus().writer(topics::channel_request)),
      replies_(node.bus().reader(topics::channel_reply)),
      panel_(node.bus().writer(topics::panel_request)),
      panel_client_(service::make_client_id()),
      orders_(static_cast<std::uint32_t>(service::make_client_id())) {
  for (auto& client : clients_) client = service::make_client_id();
  core_.set_orders(&orders_);
}

void OrderService::configure(const machine::Parameters& parameters) {
  JogLimits limits;
  for (const auto& axis : machine::drive_axes(parameters))
    if (axis.number < limits.speed.size())
      limits.speed[axis.number] = parameters.get(parameter::jog_feed, axis.number);
  for (std::size_t c = 0; c < limits.renewal_us.size(); ++c)
    limits.renewal_us[c] = static_cast<std::uint64_t>(
        1e6 * parameters.get(parameter::jog_renewal_time, static_cast<std::uint32_t>(c)));
  orders_.configure(limits);
}

void OrderService::pump(double now) {
  show_messages();
  if (node_.snapshot() != nullptr) return;
  if (started_ == 0) started_ = now;
  if (!begun_ && now - started_ > quiet_period) {
    orders_.begin(core_.memory().registers);
    begun_ = true;
  }
  take_answers();
  for (std::size_t c = 0; c < channel_count; ++c) send(c, now);
}

void OrderService::take_answers() {
  idl::channel::ChannelReply reply;
  while (replies_.take(reply))
    for (auto& under_way : under_way_) {
      if (!under_way || under_way->request.client != reply.client ||
          under_way->request.number != reply.number)
        continue;
      const auto request = under_way->request;
      under_way.reset();
      orders_.answered(request, reply.accepted);
      // A renewal is no order of the operator: it is refused when the jog has ended at the end of the travel.
      if (request.command != idl::channel::CommandKind::JOG_RENEW)
        tell_programs(request.channel, reply.accepted ? 0 : reply.alarm);
    }
}

void OrderService::send(std::size_t channel, double now) {
  auto& under_way = under_way_[channel];
  if (under_way && now - under_way->begun > longest_order_wait) {
    orders_.answered(under_way->request, false);
    orders_.drop(channel);
    under_way.reset();
  }
  if (!under_way) {
    auto request = orders_.take(channel, core_.memory().now_us);
    if (!request) return;
    request->client = clients_[channel];
    request->number = ++numbers_[channel];
    under_way = UnderWay{std::move(*request), now, 0};
  }
  if (now - under_way->sent < order_resend_period) return;
  requests_.write(under_way->request);
  under_way->sent = now;
}

// The answer is an input of the PLC: it goes through the log of its inputs, so that a verification repeats
// it.
void OrderService::tell_programs(std::uint16_t channel, std::uint32_t alarm) {
  if (alarm == 0 && load(core_.memory().registers, interface_address("order_refused", channel)) == 0) return;
  idl::plc::PanelRequest request;
  request.client = panel_client_;
  request.number = ++panel_number_;
  request.kind = idl::plc::PanelRequestKind::CHANNEL_ANSWER;
  request.address = channel;
  request.value = alarm;
  panel_.write(request);
}

void OrderService::programs_changed() {
  for (const auto& [number, alarm] : shown_) node_.alarms().clear(*alarm, number);
  shown_.clear();
  message_bits_ = {};
}

void OrderService::show_messages() {
  const auto bits = core_.shown_messages();
  if (bits == message_bits_) return;
  message_bits_ = bits;
  for (std::uint16_t number = 0; number < st::most_messages; ++number) {
    const bool shows = core_.shows_message(number);
    if (shows == shown_.contains(number)) continue;
    if (shows) {
      const auto found = core_.messages().find(number);
      const bool known = found != core_.messages().end();
      const auto& alarm = known ? alarm_of(found->second.reaction) : alarm::plc_hint;
      shown_[number] = &alarm;
      const auto text = known ? found->second.text : "there is no text of this number in messages.yaml";
      node_.alarms().raise(alarm, number, "Message " + std::to_string(number) + ": " + text,
                           core_.executed());
      continue;
    }
    const auto& alarm = *shown_[number];
    shown_.erase(number);
    if (alarm.number == alarm::plc_hint.number)
      node_.alarms().clear(alarm, number);
    else
      node_.alarms().release(alarm, number);
  }
}

}  // namespace trunnion::plc
