// SPDX-License-Identifier: Apache-2.0
// What the programs decide of the channels: inhibits with their reasons, overrides, and the answers to their
// orders.
#include <algorithm>
#include <utility>

#include "commands/override_limits.hpp"
#include "plc_core.hpp"
#include "text/utf8.hpp"

namespace trunnion::plc {
namespace {

constexpr std::size_t longest_reason = 160;  // idl/plc.idl

std::string reason_of(std::size_t number, const st::Message& message) {
  return message.text + " (message " + std::to_string(number) + ")";
}

bool concerns(const st::Message& message, std::size_t channel) {
  return !message.channel || *message.channel == channel;
}

}  // namespace

void PlcCore::find_control() {
  for (std::size_t c = 0; c < channel_count; ++c) {
    const auto of = [c](const char* text) { return interface_address(text, c); };
    control_symbols_[c] = {
        of("start_inhibit"),       of("manual_inhibit"),       of("sets_overrides"),
        of("feed_override_order"), of("rapid_override_order"), of("spindle_override_order"),
        of("order_refused"),       of("order_alarm"),          of("tap_stop")};
  }
  for (std::size_t i = 0; i < message_bits_.size(); ++i) message_bits_[i] = interface_address("message", i);
}

bool PlcCore::shows_message(std::size_t number) const {
  return loaded_ && plc::load(memory_.registers, message_bits_[number]) != 0;
}

std::array<std::uint16_t, message_words> PlcCore::shown_messages() const {
  std::array<std::uint16_t, message_words> words{};
  if (loaded_) std::copy_n(memory_.registers.g.begin() + message_bits_[0].index, words.size(), words.begin());
  return words;
}

// Whether a register of any channel decides something.
bool PlcCore::controls() const {
  const auto decides = [&](const ControlSymbols& symbols) {
    return plc::load(memory_.registers, symbols.start_inhibit) != 0 ||
           plc::load(memory_.registers, symbols.manual_inhibit) != 0 ||
           plc::load(memory_.registers, symbols.sets_overrides) != 0 ||
           plc::load(memory_.registers, symbols.tap_stop) != 0;
  };
  return std::any_of(control_symbols_.begin(), control_symbols_.end(), decides);
}

// A message that inhibits something is its reason; what several say stands in the order of their numbers.
idl::plc::ChannelControl PlcCore::control(std::size_t channel) const {
  const auto& r = memory_.registers;
  const auto& symbols = control_symbols_[channel];
  const auto bit = [&](Address address) { return plc::load(r, address) != 0; };
  const auto share = [&](Address address, const commands::OverrideLimits& limits) {
    return limits.clamp(plc::load(r, address) / 100.0);
  };
  idl::plc::ChannelControl control;
  control.start_inhibit = bit(symbols.start_inhibit);
  control.manual_inhibit = bit(symbols.manual_inhibit);
  control.sets_overrides = bit(symbols.sets_overrides);
  control.tap_stop = bit(symbols.tap_stop);
  control.feed_override = control.sets_overrides ? share(symbols.feed_override, commands::feed_override) : 1;
  control.rapid_override =
      control.sets_overrides ? share(symbols.rapid_override, commands::rapid_override) : 1;
  control.spindle_override =
      control.sets_overrides ? share(symbols.spindle_override, commands::spindle_override) : 1;
  for (const auto& [number, message] : messages_) {
    if (!(message.inhibits_start || message.inhibits_manual) || !concerns(message, channel) ||
        !shows_message(number))
      continue;
    control.start_inhibit = control.start_inhibit || message.inhibits_start;
    control.manual_inhibit = control.manual_inhibit || message.inhibits_manual;
    control.reason.append(control.reason.empty() ? "" : "; ").append(reason_of(number, message));
  }
  control.reason = text::shortened(std::move(control.reason), longest_reason);
  return control;
}

// Up to the last channel of which the programs decide anything.
void PlcCore::set_control(idl::plc::Outputs& outputs) const {
  if (!loaded_ || !(controls() || shown_messages() != std::array<std::uint16_t, message_words>{})) return;
  idl::plc::ChannelControl nothing;
  nothing.feed_override = nothing.rapid_override = nothing.spindle_override = 1;
  for (std::size_t c = 0; c < channel_count; ++c) {
    auto one = control(c);
    if (one == nothing) continue;
    outputs.channels.resize(c, nothing);
    outputs.channels.push_back(std::move(one));
  }
}

std::string PlcCore::order_answered(const idl::plc::PanelRequest& request) {
  if (request.address >= channel_count) return "there is no channel " + std::to_string(request.address);
  const auto& symbols = control_symbols_[request.address];
  input(symbols.refused, request.value != 0);
  if (request.value != 0) input(symbols.alarm, request.value);
  return "";
}

}  // namespace trunnion::plc
