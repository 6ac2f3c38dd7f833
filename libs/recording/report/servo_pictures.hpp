// SPDX-License-Identifier: Apache-2.0
// Pictures of servo tests, SVG.
#pragma once

#include <string>
#include <vector>

#include "servo_analysis/test_picture.hpp"

namespace trunnion::report {

/// One diagram with a legend; at most 4000 points of each curve are drawn.
std::string picture_of(const std::string& title, const servo_analysis::Diagram& diagram);
/// Several diagrams below each other.
std::string stacked_picture(const std::string& title, const std::vector<servo_analysis::Diagram>& diagrams);
/// Magnitude in dB and phase over the logarithm of the frequency.
std::string picture_of(const std::string& title, const servo_analysis::BodeDiagram& bode);
/// Deviation of a circle in polar coordinates, magnified.
std::string picture_of(const std::string& title, const servo_analysis::RoundnessFigures& figures);

std::string picture_of(const servo_analysis::TestPicture& picture);

}  // namespace trunnion::report
