// SPDX-License-Identifier: Apache-2.0
// Volumetric errors of a machine over random poses.
#pragma once

#include "truth/pose_report.hpp"

namespace trunnion::identification {

struct VolumetricErrors {
  truth::Spread tip;        ///< mm
  truth::Spread direction;  ///< rad
};

/// Over `count` random poses in the travel, with the compensation of `report`. With `about_mean` the mean
/// deviation of the tip is taken off: setting the workpiece zero removes it, and no instrument that is set to
/// zero shows it.
VolumetricErrors volumetric_errors(const truth::PoseReport& report, std::size_t count, std::uint64_t seed,
                                   bool about_mean);

}  // namespace trunnion::identification
