// SPDX-License-Identifier: Apache-2.0
// What the programs order of the channels with registers of area G: operator commands at rising edges, jog as
// long as a bit is set, counts of a handwheel. No DDS, no clock.
#pragma once

#include <array>
#include <deque>
#include <optional>
#include <vector>

#include "contracts/types.hpp"
#include "memory.hpp"

namespace trunnion::plc {

using idl::channel::ChannelRequest;

inline constexpr std::size_t order_axis_count = 16;  ///< axes with registers for jog

/// What the parameters say of jog.
struct JogLimits {
  std::array<double, order_axis_count> speed{};  ///< of each axis by its logical number, mm/min or deg/min
  std::array<std::uint64_t, channel_count>
      renewal_us{};  ///< machine time that a jog lasts without renewal (04c917)
  bool operator==(const JogLimits&) const = default;
};

/// A bit that is set at begin() is a key that is held already: it gives no order before it was 0, and the
/// counter of the handwheel at begin() counts as 0.
class PanelOrders {
 public:
  /// `first_press` numbers the presses of jog keys from there on; two stations should not use the same
  /// numbers.
  explicit PanelOrders(std::uint32_t first_press);

  void configure(const JogLimits& limits) { limits_ = limits; }
  /// `axes`: logical numbers, in the order of ChannelState.axes.
  void set_axes(std::size_t channel, const std::vector<std::uint16_t>& axes);
  /// Nothing of before is ordered any longer.
  void begin(const Registers& registers);
  /// After each scan, with the PLC's time. Does nothing before begin(). Allocates only when an order arises.
  void after_scan(const Registers& registers, std::uint64_t now_us);

  /// The next request of the channel. A stop comes before all others and ends the starts and jogs that wait.
  std::optional<ChannelRequest> take(std::size_t channel, std::uint64_t now_us);
  /// The channel has answered the request; a refused jog or renewal ends the press.
  void answered(const ChannelRequest& request, bool accepted);
  /// The channel does not answer: what waits for it is not ordered any longer.
  void drop(std::size_t channel);

 private:
  struct Held {
    std::uint16_t axis = 0;  ///< logical number
    bool plus = false;
    std::uint32_t press = 0;
    std::uint64_t renewed_us = 0;
  };
  struct Wheel {
    std::uint16_t axis = 0;       ///< from 1; 0: none
    std::uint16_t increment = 0;  ///< um or 0.001 deg
    std::int64_t counts = 0;
  };
  struct Channel {
    std::vector<std::uint16_t> axes;
    std::deque<ChannelRequest> waiting;
    std::optional<Held> held;
    Wheel wheel;
  };
  void keys(std::size_t channel, const Registers& now);
  void jog(std::size_t channel, const Registers& now, std::uint64_t now_us);
  void press(std::size_t channel, std::uint8_t index, bool plus, const Registers& now, std::uint64_t now_us);
  void stop_jog(Channel& channel, std::size_t number);
  void turn(std::size_t channel, const Registers& now);
  void flush_wheel(Channel& channel, std::size_t number);
  void stop_first(Channel& channel, const ChannelRequest& request);

  JogLimits limits_;
  std::array<Channel, channel_count> channels_;
  Registers before_;
  bool begun_ = false;
  std::uint32_t press_;
};

}  // namespace trunnion::plc
