// SPDX-License-Identifier: Apache-2.0
// What the drives of a cluster sample while a channel executes a program.
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "circular_tests/circle_program.hpp"
#include "geometry/types.hpp"
#include "machine_tests/servo_session.hpp"
#include "servo_analysis/channel_motion.hpp"

namespace trunnion::machine_tests {

/// Runs `program` and samples the axes `sampled` (letters) every `decimation` periods of the speed loop while
/// the channel moves; the other axes rest where they are. When this computer loses samples, the program runs
/// again, at last with a quarter of the rate: the interval of the result says which.
servo_analysis::ChannelMotion run_sampled(ServoSession& session, const std::string& program,
                                          const std::string& sampled, std::uint16_t decimation);

/// Where X, Y and Z of the channel stand, mm; 0 where it has no such axis.
geometry::Vec3 linear_place(const ServoSession& session);

/// X, Y and Z of the channel. Throws std::runtime_error when one is missing.
std::array<servo_analysis::TestedAxis, 3> linear_axes(const ServoSession& session);

/// Runs the circle in both senses, X, Y and Z sampled in every cycle of 1 ms; the axes go back to where they
/// stand. Throws std::runtime_error when the machine cannot run it.
servo_analysis::ChannelMotion run_circle(ServoSession& session, const circular_tests::CircleMotion& circle);

}  // namespace trunnion::machine_tests
