// SPDX-License-Identifier: Apache-2.0
// Directions of the tool as angles of the rotary axes of a channel.
#include <algorithm>
#include <cmath>
#include <variant>

#include "channel_setup/channel_setup.hpp"

namespace trunnion::channel_setup {
namespace {

constexpr double turn_worth_a_move = 1e-6;  // degrees
constexpr std::uint32_t most_vector_pieces = 1024;

}  // namespace

geometry::OrientationAnswer ChannelSetup::orientation(const language::Vector3& direction,
                                                      const AxisValues& current,
                                                      language::RotaryChoice choice) const {
  geometry::OrientationRequest request;
  request.direction = {direction[0], direction[1], direction[2]};
  request.present = geometry::angles_of(current.data());
  request.travel = rotary_travel_;
  request.tolerance = limits_.orientation_tolerance;
  for (std::size_t i = 0; i < geometry::angle_count; ++i)
    if (const double rate = limits_.axes[3 + i].rapid_velocity; rate > 0) request.rate[i] = rate;
  switch (choice) {
    case language::RotaryChoice::shortest:
      request.choice = geometry::SolutionChoice::shortest;
      break;
    case language::RotaryChoice::positive:
      request.choice = geometry::SolutionChoice::positive;
      break;
    case language::RotaryChoice::negative:
      request.choice = geometry::SolutionChoice::negative;
      break;
    case language::RotaryChoice::continuous:
      request.choice = geometry::SolutionChoice::continuous;
      break;
  }
  return solver_->best(request);
}

std::optional<AxisValues> ChannelSetup::orient(const language::Vector3& direction, const AxisValues& current,
                                               language::RotaryChoice choice) const {
  const auto answer = orientation(direction, current, choice);
  if (answer.status != geometry::OrientationStatus::found) return std::nullopt;
  AxisValues result = current;
  std::copy(answer.best.angles.begin(), answer.best.angles.end(), result.begin() + 3);
  return result;
}

std::optional<language::Vector3> ChannelSetup::nearest_direction(const language::Vector3& direction,
                                                                 const AxisValues& current) const {
  const auto answer = orientation(direction, current, language::RotaryChoice::continuous);
  if (answer.status != geometry::OrientationStatus::unreachable) return std::nullopt;
  return language::Vector3{answer.nearest[0], answer.nearest[1], answer.nearest[2]};
}

std::variant<geometry::DirectionPath, geometry::DirectionPathFault> ChannelSetup::direction_path(
    const AxisValues& current, const language::Vector3& direction) const {
  geometry::DirectionPathRequest request;
  request.present = geometry::angles_of(current.data());
  request.from = chain_->tool_direction_in_workpiece(request.present);
  request.to = {direction[0], direction[1], direction[2]};
  request.travel = rotary_travel_;
  request.tolerance = limits_.orientation_tolerance;
  request.avoid_poles = avoid_poles_;
  request.pole_range = pole_range_;
  return geometry::DirectionPath::make(*solver_, request);
}

language::VectorPath ChannelSetup::vector_path(const AxisValues& current,
                                               const language::Vector3& direction) const {
  using Fault = language::VectorPath::Fault;
  using PathFault = geometry::DirectionPathFault;
  language::VectorPath way;
  const auto made = direction_path(current, direction);
  if (const auto* fault = std::get_if<PathFault>(&made)) {
    switch (fault->kind) {
      case PathFault::not_a_direction:
        way.fault = Fault::end;
        break;
      case PathFault::opposite:
        way.fault = Fault::opposite;
        break;
      case PathFault::unreachable:
        way.fault = fault->s == 1 ? Fault::end : Fault::between;
        way.nearest = {fault->nearest[0], fault->nearest[1], fault->nearest[2]};
        break;
      case PathFault::outside_travel:
        way.fault = Fault::travel;
        break;
      case PathFault::pole:
        way.fault = Fault::pole;
        break;
    }
    return way;
  }
  const auto& path = std::get<geometry::DirectionPath>(made);
  const auto present = geometry::angles_of(current.data()), start = path.start();
  for (std::size_t i = 0; i < present.size(); ++i)
    way.turns_first = way.turns_first || std::abs(start[i] - present[i]) > turn_worth_a_move;
  way.pieces = path.pieces(*chain_, std::max(0.1 * limits_.orientation_tolerance, 1e-4), most_vector_pieces);
  return way;
}

AxisValues ChannelSetup::on_vector_path(const AxisValues& current, const language::Vector3& direction,
                                        double s) const {
  AxisValues result = current;
  const auto made = direction_path(current, direction);
  if (const auto* path = std::get_if<geometry::DirectionPath>(&made)) {
    const auto angles = path->angles(s);
    std::copy(angles.begin(), angles.end(), result.begin() + 3);
  }
  return result;
}

}  // namespace trunnion::channel_setup
