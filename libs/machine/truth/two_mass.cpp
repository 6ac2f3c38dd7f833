// SPDX-License-Identifier: Apache-2.0
#include "truth/two_mass.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/angle.hpp"

namespace trunnion::truth {
namespace {
// mm/s or deg/s: friction is steep rather than a step around standstill, so that the solution does not
// chatter.
constexpr double steep = 0.05;
}  // namespace

double friction(const MechanicsTruth& m, double speed) {
  const double v = speed / m.stribeck_speed;
  const double dry = m.coulomb + std::max(0.0, m.breakaway - m.coulomb) / (1 + v * v);
  return dry * std::clamp(speed / steep, -1.0, 1.0) + m.viscous * speed;
}

void TwoMass::configure(const MechanicsTruth& mechanics, double inertia, double rated_torque) {
  mechanics_ = mechanics;
  for (auto* terms : {&mechanics_.screw.terms, &mechanics_.screw.positive, &mechanics_.screw.negative})
    for (auto& table : terms->tables) table.finish();
  rated_torque_ = rated_torque;
  load_mass_ = inertia * mechanics.load_share;
  motor_mass_ = inertia - load_mass_;
  const double w = 2 * std::numbers::pi * mechanics.locked_frequency;
  stiffness_ = load_mass_ * w * w;
  damping_ = 2 * mechanics.damping_ratio * load_mass_ * w;
}

double TwoMass::cogging() const {
  if (mechanics_.cogging == 0) return 0;
  const double angle = 360 * (motor_ / mechanics_.cogging_period) + mechanics_.cogging_phase;
  return mechanics_.cogging * rated_torque_ * geometry::sine_cosine(angle).sine;
}

void TwoMass::place(double motor) {
  motor_ = motor;
  motor_speed_ = load_speed_ = 0;
  // A load with weight lies on the lower flank of the backlash.
  const double flank = mechanics_.gravity > 0 ? -0.5 : mechanics_.gravity < 0 ? 0.5 : 0.0;
  load_ = motor + mechanics_.screw.value(motor, 0) + flank * mechanics_.backlash -
          mechanics_.gravity * rated_torque_ / stiffness_;
}

void TwoMass::step(double torque, double dt, double load_force) {
  const int direction = (motor_speed_ > 0) - (motor_speed_ < 0);
  const double wind_up = motor_ + mechanics_.screw.value(motor_, direction) - load_;
  const double half = mechanics_.backlash / 2;
  const double stretch = wind_up - std::clamp(wind_up, -half, half);
  double coupling = 0;
  if (stretch != 0 || half == 0) {
    coupling = stiffness_ * stretch + damping_ * (motor_speed_ - load_speed_);
    // The flanks push and do not pull.
    if (half > 0 && coupling * stretch < 0) coupling = 0;
  }
  const double weight = mechanics_.gravity * rated_torque_;
  motor_speed_ += (torque + cogging() - coupling) / motor_mass_ * dt;
  // Friction is taken at the end of the step (one iteration), which is stable where it is steep.
  const double free = load_speed_ + (coupling - weight + load_force) / load_mass_ * dt;
  const double slope = rated_torque_ * std::max(mechanics_.coulomb, mechanics_.breakaway) / steep;
  const double damped = std::abs(free) / (1 + slope * dt / load_mass_);
  if (damped < steep)
    load_speed_ = free / (1 + (slope + rated_torque_ * mechanics_.viscous) * dt / load_mass_);
  else
    load_speed_ = free - rated_torque_ * friction(mechanics_, free) / load_mass_ * dt;
  motor_ += motor_speed_ * dt;
  load_ += load_speed_ * dt;
}

}  // namespace trunnion::truth
