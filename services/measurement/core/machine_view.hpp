// SPDX-License-Identifier: Apache-2.0
// What a measurement has heard of the machine.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "calibration/measuring_program.hpp"
#include "contracts/types.hpp"

namespace trunnion::measurement {

/// An alarm that stops a channel.
struct StoppingAlarm {
  std::uint32_t number = 0;
  std::string text;
};

class MachineView {
 public:
  /// Of every channel; forgets what was heard of another one.
  void watch(std::uint16_t channel);
  std::uint16_t channel() const { return channel_; }

  /// `now`: s, monotonic.
  void take(const idl::channel::ChannelState& state, double now);
  void take(const idl::service::Alarm& alarm);
  void take(const idl::channel::Variables& variables);

  /// Null until the channel was heard.
  const idl::channel::ChannelState* state() const { return state_ ? &*state_ : nullptr; }
  std::uint64_t states() const { return states_; }     ///< how many states came
  double heard() const { return heard_; }              ///< s, when the newest one came
  bool running() const;                                ///< it moves, waits or brakes
  bool stopped() const { return !stopping_.empty(); }  ///< an alarm stops the channel
  /// The active alarms that stop a channel in one line, the strongest reaction first, then by arrival: what
  /// follows from a cause comes after it.
  StoppingAlarm stopping() const;
  const calibration::MacroVariables& variables() const { return variables_; }
  void forget_variables() { variables_.clear(); }
  /// Where the axes are, machine coordinates.
  calibration::AxisPosition position() const;

 private:
  std::uint16_t channel_ = 0;
  std::map<std::uint16_t, idl::channel::ChannelState> others_;
  std::optional<idl::channel::ChannelState> state_;
  std::uint64_t states_ = 0;
  double heard_ = 0;
  struct Entry {
    std::pair<int, std::uint64_t> rank;
    StoppingAlarm alarm;
  };
  std::map<std::array<std::uint32_t, 3>, Entry> stopping_;  // by instance, number, part
  std::uint64_t order_ = 0;
  calibration::MacroVariables variables_;
};

}  // namespace trunnion::measurement
