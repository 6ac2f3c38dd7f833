// SPDX-License-Identifier: Apache-2.0
// Machines whose errors are drawn by a seed, of a stated grade (grades.yaml).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "machine/machine_outline.hpp"
#include "truth/true_geometry.hpp"

namespace trunnion::truth {

/// Standard deviations of the errors of a machine, in the units of grades.yaml. An error function has this
/// root mean square over the travel.
struct Grade {
  std::string name, about;
  struct Linear {
    double scale_um_per_m = 0;  ///< positioning error in proportion to the position
    double positioning_um = 0, straightness_um = 0, angular_urad = 0, squareness_urad = 0;
    double pitch_um = 0, pitch_mm = 10;  ///< amplitude and period of the screw's error
    double reversal_um = 0;
  } linear;
  struct Rotary {
    double displacement_um = 0, inclination_urad = 0, zero_urad = 0;
    double translation_um = 0, tilt_urad = 0, positioning_urad = 0, reversal_urad = 0;
  } rotary;
  struct Spindle {
    double inclination_urad = 0;
  } spindle;
  /// Means; each machine has its own within about a fifth.
  struct Thermal {
    double expansion_um_per_m_K = 0, rise_K_per_m_per_min = 0, time_constant_s = 2400;
    double spindle_growth_um_per_K = 0, spindle_rise_K_per_1000_rpm = 0, spindle_time_constant_s = 1200;
  } thermal;
  /// Means of the mechanics of a servo axis (random_drive.hpp); each axis has its own within about a quarter.
  struct Drive {
    double load_share = 0.5, locked_frequency_Hz = 120, damping_ratio = 0.05;
    double coulomb = 0, breakaway_excess = 0, viscous_per_mm_per_s = 0;  ///< breakaway over coulomb, less one
    double backlash_um = 0, cogging = 0;  ///< a rotary axis: at a radius of 100 mm
  } drive;
  /// Of a machine with a gantry: a standard deviation, and means.
  struct Beam {
    double misalignment_um = 0, racking_frequency_Hz = 20, racking_damping_ratio = 0.05;
  } beam;
};

/// Those of grades.yaml, in its order.
const std::vector<Grade>& grades();

/// Draws the errors of the axes that the machine has. The same bits for the same arguments on every host.
GeometryTruth draw_machine(const Grade& grade, std::uint64_t seed, const machine::MachineOutline& machine);

}  // namespace trunnion::truth
