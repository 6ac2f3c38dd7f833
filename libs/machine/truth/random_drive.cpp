// SPDX-License-Identifier: Apache-2.0
#include "truth/random_drive.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/random_source.hpp"

namespace trunnion::truth {
namespace {

// `axis`: any number that tells the axes apart. Frequencies stay where the steps of the simulation permit
// them. `turns`: backlash in deg.
MechanicsTruth draw_mechanics(const Grade& grade, std::uint64_t seed, std::uint32_t axis, bool turns) {
  // Another stream than that of the geometry.
  geometry::RandomSource random(seed * 0x2545f4914f6cdd1d + 0x1000 + axis);
  const auto& g = grade.drive;
  const auto about = [&](double mean) { return mean * std::clamp(1 + 0.25 * random.normal(), 0.4, 1.6); };
  MechanicsTruth m;
  m.load_share = std::clamp(about(g.load_share), 0.15, 0.8);
  // The resonance stays below 500 Hz.
  m.locked_frequency = std::min(about(g.locked_frequency_Hz), 480 * std::sqrt(1 - m.load_share));
  m.damping_ratio = about(g.damping_ratio);
  m.coulomb = about(g.coulomb);
  m.breakaway = m.coulomb * (1 + about(g.breakaway_excess));
  m.stribeck_speed = about(2);
  m.viscous = about(g.viscous_per_mm_per_s);
  const double backlash = about(g.backlash_um) * 1e-3;
  m.backlash = turns ? backlash * 1e-3 * 180 / std::numbers::pi / 0.1 : backlash;
  m.cogging = about(g.cogging);
  m.cogging_period = 10;
  m.cogging_phase = 360 * random.uniform();
  return m;
}

}  // namespace

std::map<std::string, DriveTruth> draw_drives(const Grade& grade, std::uint64_t seed,
                                              const machine::MachineOutline& machine) {
  std::map<std::string, DriveTruth> drives;
  for (std::size_t i = 0; i < machine.drives.size(); ++i) {
    const auto& name = machine.drives[i];
    const bool turns =
        std::find(machine.turning.begin(), machine.turning.end(), name) != machine.turning.end();
    drives[name].mechanics = draw_mechanics(grade, seed, static_cast<std::uint32_t>(i), turns);
  }
  return drives;
}

BeamTruth draw_beam(const Grade& grade, std::uint64_t seed, const machine::MachineOutline& machine,
                    std::size_t axis) {
  geometry::RandomSource random(seed * 0x2545f4914f6cdd1d + 0x2000);
  const auto about = [&](double mean) { return mean * std::clamp(1 + 0.25 * random.normal(), 0.4, 1.6); };
  const std::size_t across = axis == 0 ? 1 : 0;
  BeamTruth beam;
  beam.axis = axis;
  beam.master_foot = machine.axes[across].low * Vec3::Unit(static_cast<Eigen::Index>(across));
  beam.slave_foot = machine.axes[across].high * Vec3::Unit(static_cast<Eigen::Index>(across));
  beam.misalignment = grade.beam.misalignment_um * 1e-3 * random.normal();
  beam.racking_frequency = about(grade.beam.racking_frequency_Hz);
  beam.racking_damping = about(grade.beam.racking_damping_ratio);
  return beam;
}

}  // namespace trunnion::truth
