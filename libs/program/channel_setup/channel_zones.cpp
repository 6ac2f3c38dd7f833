// SPDX-License-Identifier: Apache-2.0
// The zones that programs forbid, on the way of a move.
#include <fmt/core.h>

#include <cmath>

#include "channel_setup/channel_setup.hpp"
#include "channel_setup/zone_search.hpp"
#include "motion/path_segment.hpp"

namespace trunnion::channel_setup {
namespace {

constexpr std::size_t box_axes = 3;  // X Y Z

std::string place_words(const AxisValues& machine, const language::StrokeZone& zone) {
  constexpr double shown = 5e-5;  // less is 0, without a sign
  std::string words;
  for (std::size_t axis = 0; axis < box_axes; ++axis)
    if (zone.bounded[axis])
      words += fmt::format("{}{} {:.4f}", words.empty() ? "" : " ", language::axis_letters[axis],
                           std::abs(machine[axis]) < shown ? 0.0 : machine[axis]);
  return words;
}

/// The sides of the box as the travel of the axes; those without sides go everywhere.
std::array<Travel, language::axis_count> travels_of(const language::StrokeZone& zone) {
  constexpr double everywhere = 1e12;
  std::array<Travel, language::axis_count> travels{};
  travels.fill({-everywhere, everywhere});
  for (std::size_t axis = 0; axis < box_axes; ++axis)
    if (zone.bounded[axis]) travels[axis] = {zone.low[axis], zone.high[axis]};
  return travels;
}

}  // namespace

std::string ChannelSetup::zone_error(const AxisValues& from, const language::Command& move,
                                     const language::StrokeZone& zone, const AxisValues& offset) const {
  const bool rtcp = move.modal.transformation == language::Transformation::rtcp;
  const bool arc = move.kind == language::CommandKind::arc;
  const auto path = arc ? motion::PathSegment::arc(from, move.target, move.arc)
                        : motion::PathSegment::line(from, move.target);
  const double length = path.length();
  const auto at = [&](double share) {
    AxisValues place = share >= 1 ? move.target : path.position(length * share);
    if (rtcp) place = machine_from_tip(place, move.modal.tool_length);
    for (std::size_t axis = 0; axis < box_axes; ++axis) place[axis] += offset[axis];
    return place;
  };
  double degrees = arc ? move.arc.sweep : 0;
  if (rtcp)
    for (std::size_t i = language::A; i < from.size(); ++i)
      if (chain_->turns(i - language::A)) degrees += std::abs(move.target[i] - from[i]);
  if (!zone.outside) {
    const auto entered = first_in_zone(at, degrees, zone);
    return entered ? fmt::format("it would enter it at {}", place_words(*entered, zone)) : std::string();
  }
  const auto left = farthest_breach(at, degrees, channel_axes_.index, travels_of(zone));
  if (!left) return "";
  return fmt::format("{} would go to {:.4f}, its zone is {:.4f} .. {:.4f}",
                     language::axis_letters[left->axis], left->position, zone.low[left->axis],
                     zone.high[left->axis]);
}

}  // namespace trunnion::channel_setup
