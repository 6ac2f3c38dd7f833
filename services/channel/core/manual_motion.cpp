// SPDX-License-Identifier: Apache-2.0
#include "manual_motion.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "machine/alarm_constants.hpp"
#include "text/quantity.hpp"

namespace trunnion::channel {
namespace {
const char* feed_unit(std::uint8_t axis) { return canonical::is_rotary(axis) ? "deg/min" : "mm/min"; }
}  // namespace

void ManualMotion::configure() {
  const auto& limits = machine_.limits();
  AxisValues by_hand{};
  for (std::size_t i = 0; i < by_hand.size(); ++i)
    by_hand[i] = machine_.jog_feed(static_cast<std::uint8_t>(i)) / 60;
  const auto offset = offset_.position();
  const double cycle = machine_.cycle_seconds();
  wheel_.configure(limits, by_hand, 1, cycle);
  offset_.configure(limits, by_hand, machine_.handwheel_share(), cycle);
  offset_.start(offset);
}

motion::Limits ManualMotion::path_limits() const {
  auto limits = machine_.limits();
  if (!offset_on_) return limits;
  const double share = machine_.handwheel_share();
  for (auto& axis : limits.axes) {
    axis.velocity *= 1 - share;
    axis.rapid_velocity *= 1 - share;
    axis.acceleration *= 1 - share;
    axis.jerk *= 1 - share;
  }
  return limits;
}

std::optional<Refusal> ManualMotion::axis_error(std::uint8_t index) const {
  if (index < machine_.channel_axes().index.size()) return std::nullopt;
  return Refusal{&alarm::request_invalid, "The channel has no axis number " + std::to_string(index)};
}

std::optional<Refusal> ManualMotion::jog_error(std::uint8_t index, double feed) const {
  if (auto error = axis_error(index)) return error;
  const double fastest = machine_.jog_feed(axis(index));
  if (std::abs(feed) > fastest * 1.0001)
    return Refusal{&alarm::request_invalid,
                   "Jog speed " + text::quantity(std::abs(feed), feed_unit(axis(index))) + " is above the " +
                       text::quantity(fastest, feed_unit(axis(index))) + " of axis " +
                       language::axis_letters[axis(index)]};
  return std::nullopt;
}

std::variant<AxisMove, Refusal> ManualMotion::jog(std::uint8_t index, double feed, double increment,
                                                  const AxisValues& from) const {
  const auto a = axis(index);
  const auto& travel = machine_.travel(a);
  const double direction = feed > 0 ? 1 : -1;
  const double position = from[a] + offset_.target()[a];
  const double end = direction > 0 ? travel.positive : travel.negative;
  if ((end - position) * direction <= 0)
    return Refusal{&alarm::travel_limit,
                   fmt::format("Axis {} is at its travel limit", language::axis_letters[a])};
  const double distance = increment > 0 ? direction * increment : end - position;
  return AxisMove{a, from[a] + distance, std::abs(feed)};
}

std::variant<AxisMove, Refusal> ManualMotion::reference(std::uint8_t index) const {
  if (auto error = axis_error(index)) return *error;
  const auto a = axis(index);
  return AxisMove{a, machine_.reference_position()[a], machine_.reference_feed(a)};
}

// An axis that is outside its travel already may only come back.
language::Command ManualMotion::command(const AxisMove& move, const AxisValues& from) const {
  language::Command command;
  command.kind = language::CommandKind::line;
  command.target = from;
  const double offset = offset_.target()[move.axis];
  const auto& travel = machine_.travel(move.axis);
  const double low = std::min(travel.negative - offset, from[move.axis]),
               high = std::max(travel.positive - offset, from[move.axis]);
  command.target[move.axis] = std::clamp(move.target, low, high);
  command.modal.feed = move.feed;
  return command;
}

double ManualMotion::turn(std::uint8_t axis, double distance, const AxisValues& from) {
  const auto& travel = machine_.travel(axis);
  const double position = from[axis] + offset_.target()[axis];
  return wheel_.turn(axis, distance, travel.negative - position, travel.positive - position);
}

double ManualMotion::turn_offset(std::uint8_t axis, double distance, const channel_setup::AxisBox& path) {
  const auto& travel = machine_.travel(axis);
  return offset_.turn(axis, distance, travel.negative - path.low[axis], travel.positive - path.high[axis]);
}

void ManualMotion::stop() {
  offset_.stop();
  wheel_.stop();
}

}  // namespace trunnion::channel
