// SPDX-License-Identifier: Apache-2.0
// Sends the orders of the programs to the channels, and the channels' answers to the programs.
#pragma once

#include <array>
#include <map>
#include <optional>

#include "plc_core.hpp"
#include "service/node.hpp"

namespace trunnion::plc {

/// Each channel has one order under way; it is sent again until it is answered, for a second at most. What an
/// operator has ordered longer ago must not move the machine. In a verification nothing is sent: the
/// recording has the orders, and the answers as inputs of the panel.
class OrderService {
 public:
  /// `core` must outlive this.
  OrderService(service::Node& node, PlcCore& core);
  /// With each revision of the parameters.
  void configure(const machine::Parameters& parameters);
  void set_channel(const idl::channel::ChannelState& state) { orders_.set_axes(state.channel, state.axes); }
  /// Other programs may have other messages.
  void programs_changed();
  /// Raises the alarms of the messages that the programs show, and ends them.
  void pump(double now);

 private:
  struct UnderWay {
    idl::channel::ChannelRequest request;
    double begun = 0, sent = 0;  ///< s
  };
  void take_answers();
  void send(std::size_t channel, double now);
  void tell_programs(std::uint16_t channel, std::uint32_t alarm);
  void show_messages();

  service::Node& node_;
  PlcCore& core_;
  bus::Writer<idl::channel::ChannelRequest> requests_;
  bus::Reader<idl::channel::ChannelReply> replies_;
  bus::Writer<idl::plc::PanelRequest> panel_;
  std::array<std::uint64_t, channel_count>
      clients_{};  ///< of each channel: requests of one client come in order
  std::array<std::uint64_t, channel_count> numbers_{};
  std::uint64_t panel_client_, panel_number_ = 0;
  std::array<std::optional<UnderWay>, channel_count> under_way_;
  PanelOrders orders_;
  double started_ = 0;  ///< s
  bool begun_ = false;
  std::array<std::uint16_t, message_words> message_bits_{};
  std::map<std::uint16_t, const machine::AlarmDefinition*> shown_;  ///< messages and how they are shown
};

}  // namespace trunnion::plc
