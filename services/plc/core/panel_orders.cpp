// SPDX-License-Identifier: Apache-2.0
#include "panel_orders.hpp"

#include <algorithm>
#include <cmath>

#include "address.hpp"

namespace trunnion::plc {
namespace {

using idl::channel::CommandKind;
using idl::channel::Mode;

constexpr std::int64_t most_counts = 10000;  // of one request, idl/operator_commands.yaml
constexpr std::uint64_t renewals = 4;        // in the time that a jog lasts without one

struct ModeKey {
  Address key;
  Mode mode;
};
struct Level {
  Address bit;
  CommandKind command;
};
struct ChannelOrders {
  std::array<ModeKey, 4> modes;
  Address start, hold, reset;
  std::array<Level, 3> levels;
  Address block_skip;
  Address jog_feed, jog_rapid, jog_increment;
  Address wheel_axis, wheel_counter, wheel_increment;
};
struct AxisOrders {
  Address plus, minus, reference, plus_inhibit, minus_inhibit;
};

const std::array<ChannelOrders, channel_count>& channel_orders() {
  static const auto all = [] {
    std::array<ChannelOrders, channel_count> result;
    for (std::size_t c = 0; c < channel_count; ++c) {
      const auto of = [c](const char* name) { return interface_address(name, c); };
      result[c] = {{{{of("order_auto"), Mode::AUTO},
                     {of("order_mdi"), Mode::MDI},
                     {of("order_jog"), Mode::JOG},
                     {of("order_ref"), Mode::REF}}},
                   of("order_start"),
                   of("order_hold"),
                   of("order_reset"),
                   {{{of("order_single_block"), CommandKind::SINGLE_BLOCK},
                     {of("order_optional_stop"), CommandKind::OPTIONAL_STOP},
                     {of("order_dry_run"), CommandKind::DRY_RUN}}},
                   of("order_block_skip"),
                   of("jog_feed"),
                   of("jog_rapid"),
                   of("jog_increment"),
                   of("handwheel_axis"),
                   of("handwheel_counter"),
                   of("handwheel_increment")};
    }
    return result;
  }();
  return all;
}

const std::array<AxisOrders, order_axis_count>& axis_orders() {
  static const auto all = [] {
    std::array<AxisOrders, order_axis_count> result;
    for (std::size_t a = 0; a < order_axis_count; ++a) {
      const auto of = [a](const char* name) { return interface_address(name, a); };
      result[a] = {of("jog_plus"), of("jog_minus"), of("order_reference"), of("jog_plus_inhibit"),
                   of("jog_minus_inhibit")};
    }
    return result;
  }();
  return all;
}

ChannelRequest request_of(std::size_t channel, CommandKind command) {
  ChannelRequest request;
  request.channel = static_cast<std::uint16_t>(channel);
  request.command = command;
  return request;
}

bool starts_motion(CommandKind command) {
  return command == CommandKind::CYCLE_START || command == CommandKind::JOG_AXIS ||
         command == CommandKind::REFERENCE_AXIS || command == CommandKind::HANDWHEEL;
}

bool stops(CommandKind command) {
  return command == CommandKind::RESET || command == CommandKind::FEED_HOLD ||
         command == CommandKind::JOG_STOP;
}

double millimetres(std::uint16_t micrometres) { return micrometres / 1000.0; }

}  // namespace

PanelOrders::PanelOrders(std::uint32_t first_press) : press_(first_press) {
  channel_orders();
  axis_orders();
}

void PanelOrders::set_axes(std::size_t channel, const std::vector<std::uint16_t>& axes) {
  if (channel >= channel_count || channels_[channel].axes == axes) return;
  stop_jog(channels_[channel], channel);  // its index may be another axis' now
  channels_[channel].axes = axes;
}

void PanelOrders::begin(const Registers& registers) {
  before_ = registers;
  begun_ = true;
  for (std::size_t c = 0; c < channel_count; ++c) {
    drop(c);
    channels_[c].held.reset();
  }
}

void PanelOrders::after_scan(const Registers& registers, std::uint64_t now_us) {
  if (!begun_ || registers.g == before_.g) return;
  for (std::size_t c = 0; c < channel_count; ++c) {
    if (channels_[c].axes.empty()) continue;  // no such channel
    keys(c, registers);
    jog(c, registers, now_us);
    turn(c, registers);
  }
  before_.g = registers.g;
}

void PanelOrders::keys(std::size_t channel, const Registers& now) {
  const auto& orders = channel_orders()[channel];
  auto& own = channels_[channel];
  const auto rises = [&](Address bit) { return load(before_, bit) == 0 && load(now, bit) != 0; };
  const auto changes = [&](Address value) { return load(before_, value) != load(now, value); };
  if (rises(orders.hold)) stop_first(own, request_of(channel, CommandKind::FEED_HOLD));
  if (rises(orders.reset)) stop_first(own, request_of(channel, CommandKind::RESET));
  for (const auto& [key, mode] : orders.modes)
    if (rises(key)) {
      own.waiting.push_back(request_of(channel, CommandKind::SET_MODE));
      own.waiting.back().mode = mode;
    }
  for (const auto& [bit, command] : orders.levels)
    if (changes(bit)) {
      own.waiting.push_back(request_of(channel, command));
      own.waiting.back().on = load(now, bit) != 0;
    }
  if (changes(orders.block_skip)) {
    own.waiting.push_back(request_of(channel, CommandKind::BLOCK_SKIP));
    own.waiting.back().levels = static_cast<std::uint16_t>(load(now, orders.block_skip));
  }
  // A stop that is ordered in the same scan prevails.
  if (rises(orders.start) && load(now, orders.hold) == 0 && load(now, orders.reset) == 0)
    own.waiting.push_back(request_of(channel, CommandKind::CYCLE_START));
}

void PanelOrders::jog(std::size_t channel, const Registers& now, std::uint64_t now_us) {
  auto& own = channels_[channel];
  if (own.held) {
    const auto& orders = axis_orders()[own.held->axis];
    const bool plus = own.held->plus;
    const bool stays = load(now, plus ? orders.plus : orders.minus) != 0 &&
                       load(now, plus ? orders.minus : orders.plus) == 0 &&
                       load(now, plus ? orders.plus_inhibit : orders.minus_inhibit) == 0;
    if (!stays) stop_jog(own, channel);
  }
  for (std::size_t i = 0; i < own.axes.size(); ++i) {
    if (own.axes[i] >= order_axis_count) continue;
    const auto& orders = axis_orders()[own.axes[i]];
    const auto rises = [&](Address bit) { return load(before_, bit) == 0 && load(now, bit) != 0; };
    const auto index = static_cast<std::uint8_t>(i);
    if (rises(orders.reference)) {
      own.waiting.push_back(request_of(channel, CommandKind::REFERENCE_AXIS));
      own.waiting.back().axis = index;
    }
    const bool plus = load(now, orders.plus) != 0;
    if (plus == (load(now, orders.minus) != 0)) continue;
    if (rises(plus ? orders.plus : orders.minus) &&
        load(now, plus ? orders.plus_inhibit : orders.minus_inhibit) == 0)
      press(channel, index, plus, now, now_us);
  }
}

void PanelOrders::press(std::size_t channel, std::uint8_t index, bool plus, const Registers& now,
                        std::uint64_t now_us) {
  auto& own = channels_[channel];
  const auto& orders = channel_orders()[channel];
  const auto axis = own.axes[index];
  auto request = request_of(channel, CommandKind::JOG_AXIS);
  const double speed = load(now, orders.jog_rapid) != 0
                           ? limits_.speed[axis]
                           : std::min<double>(load(now, orders.jog_feed), limits_.speed[axis]);
  request.axis = index;
  request.speed = plus ? speed : -speed;
  request.increment = millimetres(static_cast<std::uint16_t>(load(now, orders.jog_increment)));
  request.press = ++press_ == 0 ? ++press_ : press_;  // 0 cannot be renewed
  own.waiting.push_back(request);
  if (request.increment == 0) own.held = Held{axis, plus, request.press, now_us};
}

void PanelOrders::stop_jog(Channel& channel, std::size_t number) {
  if (!channel.held) return;
  channel.held.reset();
  stop_first(channel, request_of(number, CommandKind::JOG_STOP));
}

// In the order of the stops themselves. The end of a jog ends nothing else.
void PanelOrders::stop_first(Channel& channel, const ChannelRequest& request) {
  const bool all = request.command != CommandKind::JOG_STOP;
  std::erase_if(channel.waiting, [&](const auto& waits) {
    return waits.command == CommandKind::JOG_AXIS || (all && starts_motion(waits.command));
  });
  if (all) channel.wheel.counts = 0;
  channel.held.reset();
  const auto at = std::find_if(channel.waiting.begin(), channel.waiting.end(),
                               [](const auto& waits) { return !stops(waits.command); });
  channel.waiting.insert(at, request);
}

void PanelOrders::turn(std::size_t channel, const Registers& now) {
  auto& own = channels_[channel];
  const auto& orders = channel_orders()[channel];
  const auto axis = static_cast<std::uint16_t>(load(now, orders.wheel_axis));
  const auto increment = static_cast<std::uint16_t>(load(now, orders.wheel_increment));
  // The counter wraps around: the difference modulo 2^16, with its sign, is what it was turned by.
  const auto turned =
      static_cast<std::int16_t>(load(now, orders.wheel_counter) - load(before_, orders.wheel_counter));
  if (axis != own.wheel.axis || increment != own.wheel.increment) {
    flush_wheel(own, channel);
    own.wheel.axis = axis, own.wheel.increment = increment;
  }
  if (axis != 0) own.wheel.counts += turned;
}

// At most so many counts to a request.
void PanelOrders::flush_wheel(Channel& channel, std::size_t number) {
  while (channel.wheel.counts != 0) {
    auto request = request_of(number, CommandKind::HANDWHEEL);
    request.axis = static_cast<std::uint8_t>(std::min<std::uint16_t>(channel.wheel.axis, 255) - 1);
    request.counts = static_cast<std::int32_t>(std::clamp(channel.wheel.counts, -most_counts, most_counts));
    request.increment = millimetres(channel.wheel.increment);
    channel.wheel.counts -= request.counts;
    channel.waiting.push_back(request);
  }
}

std::optional<ChannelRequest> PanelOrders::take(std::size_t channel, std::uint64_t now_us) {
  auto& own = channels_[channel];
  if (own.waiting.empty()) flush_wheel(own, channel);
  if (own.waiting.empty() && own.held &&
      now_us - own.held->renewed_us >= limits_.renewal_us[channel] / renewals) {
    own.held->renewed_us = now_us;
    auto request = request_of(channel, CommandKind::JOG_RENEW);
    request.press = own.held->press;
    return request;
  }
  if (own.waiting.empty()) return std::nullopt;
  const auto request = own.waiting.front();
  own.waiting.pop_front();
  return request;
}

void PanelOrders::answered(const ChannelRequest& request, bool accepted) {
  const bool jogs = request.command == CommandKind::JOG_AXIS || request.command == CommandKind::JOG_RENEW;
  if (accepted || !jogs || request.channel >= channel_count) return;
  auto& held = channels_[request.channel].held;
  if (held && held->press == request.press) held.reset();
}

void PanelOrders::drop(std::size_t channel) {
  channels_[channel].waiting.clear();
  channels_[channel].wheel.counts = 0;
}

}  // namespace trunnion::plc
