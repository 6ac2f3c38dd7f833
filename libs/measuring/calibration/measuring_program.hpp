// SPDX-License-Identifier: Apache-2.0
// Part programs that measure on the machine, and what their macro variables say afterwards. Each touch is the
// macro O9801 of examples/calibration/programs: twice, the second one counts.
#pragma once

#include <array>
#include <map>
#include <string>
#include <vector>

#include "calibration/measurement_poses.hpp"

namespace trunnion::calibration {

/// X Y Z A B C U V W in machine coordinates, mm and deg.
using AxisPosition = std::array<double, 9>;
/// Positions one after the other, the first one where the axes are; all move in a straight line from one to
/// the next.
using Way = std::vector<AxisPosition>;

/// The pose with the ball over the pole, where a touch begins; `centre` as in TouchRound.
AxisPosition approach_position(const MeasurementInputs& inputs, const PlannedPose& pose, const Vec3& centre);

/// `to` with the rotary axes that count modulo 360 at most half a turn from `from`.
AxisPosition nearest_turns(const machine::MachineOutline& outline, const AxisPosition& from, AxisPosition to);

/// From `from` to `to` without knowledge of any bodies: Z up to `top`, the rotary axes, X and Y, then Z.
Way retract_way(const AxisPosition& from, const AxisPosition& to, double top);

/// One step of measuring a pose: straight to `to`, mm, machine coordinates; then, with a touch, on against
/// `direction` by at most standoff() and the measuring path, and back.
struct MeasuringStep {
  Vec3 to = Vec3::Zero();
  double feed = 0;  ///< mm/min
  bool touch = false;
  Vec3 direction = Vec3::Zero();
};
/// From the approach position, all at the angles of the pose.
std::vector<MeasuringStep> measuring_steps(const MeasurementInputs& inputs, const MeasuredMachine& machine,
                                           const PlannedPose& pose, const Vec3& centre);

/// What a program ends with: the serial number that it leaves in #52999 when all touches are made, and M30,
/// or M99 when a program calls it.
enum class EndsWith { m30, m99 };
struct ProgramEnd {
  std::uint32_t serial = 0;
  EndsWith code = EndsWith::m30;
};

/// A program that goes along `way` (its last position is the approach position), touches the sphere about
/// `centre` along the directions of the pose and returns to the approach position. Paraxial positioning goes
/// by the height of the pole from touch to touch, circular positioning around the equator where the shaft is
/// not in the way.
std::string measuring_program(const MeasurementInputs& inputs, const MeasuredMachine& machine,
                              const PlannedPose& pose, const Vec3& centre, const Way& way,
                              const ProgramEnd& end);
/// Touches the pole of the pose five times; the results are as many touches.
std::string repeatability_program(const MeasurementInputs& inputs, const MeasuredMachine& machine,
                                  const PlannedPose& pose, const Vec3& centre, const Way& way,
                                  const ProgramEnd& end);
inline constexpr std::size_t repeated_touches = 5;
/// Only goes along `way`.
std::string positioning_program(const MeasurementInputs& inputs, const MeasuredMachine& machine,
                                const Way& way, const ProgramEnd& end);

/// Macro variables by their number, without vacant ones.
using MacroVariables = std::map<std::uint32_t, double>;
/// True when the program with this serial number has made all its touches.
bool completed(const MacroVariables& variables, std::uint32_t serial);
/// Positions of X, Y, Z of `count` touches, mm. Throws std::runtime_error when one is missing.
std::vector<Vec3> measured_positions(const MacroVariables& variables, std::size_t count);
/// Largest less smallest component of the positions along `direction`, mm.
double range_along(const std::vector<Vec3>& positions, const Vec3& direction);

}  // namespace trunnion::calibration
