// SPDX-License-Identifier: Apache-2.0
// Motion without a program: jog, reference return, the handwheel in place of a path and its offset on a path.
#pragma once

#include <optional>
#include <string>
#include <variant>

#include "answer.hpp"
#include "channel_setup/channel_setup.hpp"
#include "handwheel.hpp"

namespace trunnion::channel {

/// A straight move of one axis.
struct AxisMove {
  std::uint8_t axis = 0;  ///< language::Axis
  double target = 0;      ///< mm or degrees, machine coordinates of the path
  double feed = 0;        ///< mm/min or degrees/min
};

/// Positions are machine coordinates of the path: those of the axes without the handwheel offset.
class ManualMotion {
 public:
  /// `machine` must outlive this and be configured before configure().
  explicit ManualMotion(const channel_setup::ChannelSetup& machine) : machine_(machine) {}

  /// Takes the machine's limits. The offset stays where it is.
  void configure();
  /// What an offset that may move leaves of the axes' limits to the path.
  motion::Limits path_limits() const;

  /// `index` counts the channel's axes, and the channel may not have that many.
  std::optional<Refusal> axis_error(std::uint8_t index) const;
  /// The request's own errors come first, then those of the position.
  std::optional<Refusal> jog_error(std::uint8_t index, double feed) const;
  /// `feed` is signed; `increment` 0: to the end of travel.
  std::variant<AxisMove, Refusal> jog(std::uint8_t index, double feed, double increment,
                                      const AxisValues& from) const;
  std::variant<AxisMove, Refusal> reference(std::uint8_t index) const;
  /// The move within the travel; without length when the axis is there.
  language::Command command(const AxisMove& move, const AxisValues& from) const;

  /// Turns axis `axis` of a path at rest at `from`; the distance that its travel lets it move.
  double turn(std::uint8_t axis, double distance, const AxisValues& from);
  /// Turns the offset while the path keeps within `path`; the distance that the travel lets it move.
  double turn_offset(std::uint8_t axis, double distance, const channel_setup::AxisBox& path);

  void switch_offset(bool on) { offset_on_ = on; }
  bool offset_on() const { return offset_on_; }
  /// What the path has to reckon with: nothing when the offset is off.
  std::optional<AxisValues> offset_target() const {
    return offset_on_ ? std::optional(offset_.target()) : std::nullopt;
  }
  const AxisValues& offset() const { return offset_.position(); }
  void place_offset(const AxisValues& position) { offset_.start(position); }
  bool offset_at_rest() const { return offset_.at_rest(); }
  const AxisValues& step_offset() { return offset_.step(); }

  void step_wheel() { wheel_.step(); }
  bool wheel_at_rest() const { return wheel_.at_rest(); }
  /// As wheel(), where the axes are going.
  const AxisValues& wheel_target() const { return wheel_.target(); }
  /// The distance of each axis since the wheel was last ended.
  const AxisValues& wheel() const { return wheel_.position(); }
  void end_wheel() { wheel_.start({}); }

  /// Wheel and offset come to rest as soon as they can.
  void stop();

 private:
  std::uint8_t axis(std::uint8_t index) const { return machine_.channel_axes().index[index]; }

  const channel_setup::ChannelSetup& machine_;
  bool offset_on_ = false;
  Handwheel offset_;  // added to the path
  Handwheel wheel_;   // in place of a path
};

}  // namespace trunnion::channel
