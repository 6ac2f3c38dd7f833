// SPDX-License-Identifier: Apache-2.0
// Pictures of a machine's errors and of measurements.
#pragma once

#include <string>

#include "truth/measurement.hpp"

namespace trunnion::report {

/// Three planes through the middle of the travel (XY, XZ, YZ), rotary axes at zero: the grid of the travel,
/// and the same grid with the deviation of the tip magnified. SVG.
std::string truth_picture(const truth::PoseReport& report, const machine::MachineOutline& machine,
                          const std::string& title);

/// Both circles of a ballbar in polar coordinates about the nominal circle, the deviations magnified. SVG.
std::string ballbar_picture(const truth::BallbarMeasurement& measured, const std::string& title);

/// Deviations over the positions, every run up and down. `unit` is the factor to `unit_name`. SVG.
std::string laser_picture(const truth::LaserMeasurement& measured, const std::string& title, double unit,
                          const std::string& unit_name);

}  // namespace trunnion::report
