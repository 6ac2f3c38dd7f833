// SPDX-License-Identifier: Apache-2.0
#include "gantry_link.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "machine/parameter_constants.hpp"
#include "servo_test.hpp"

namespace trunnion::drive {

std::vector<GantryLink> GantryLink::of(const machine::Parameters& p,
                                       const std::optional<volumetric::BeamErrors>& beam) {
  std::vector<GantryLink> links;
  std::vector<machine::GantryPair> pairs;
  try {
    pairs = machine::gantry_pairs(p);
  } catch (const std::runtime_error&) {
    return links;  // the gantry stage reports it
  }
  const auto letters = machine::channel_axes(p, 0);
  for (const auto& pair : pairs) {
    Slave slave;
    slave.pair = pair;
    const auto own = machine::DriveSynchronization::from(p, pair.slave);
    const auto master = machine::DriveSynchronization::from(p, pair.master);
    const bool follows = own.on && own.slave && master.on && !master.slave;
    slave.torque_follow = follows && own.torque_follow;
    // Motors that turn the opposite ways for the same travel need opposite torques.
    const auto turns = [&](std::uint16_t axis) {
      return std::copysign(1.0, p.get(parameter::travel_per_revolution, axis));
    };
    slave.torque_sign = (own.inverted ? -1 : 1) * turns(pair.slave) * turns(pair.master);
    if (follows && !own.torque_follow && own.compensates && master.compensates) slave.compensation = own.gain;
    slave.common_stop = own.common_stop && master.common_stop;
    if (beam && beam->racking_frequency > 0)
      for (std::size_t i = 0; i < letters.index.size(); ++i)
        if (letters.index[i] == beam->axis && letters.number[i] == pair.master) {
          const double inertia = ServoParameters::from(p, pair.slave).inertia;
          const double w = 2 * std::numbers::pi * beam->racking_frequency;
          slave.stiffness = inertia * w * w;
          slave.damping = 2 * beam->racking_damping * inertia * w;
          slave.misalignment = beam->misalignment;
        }
    const auto column = static_cast<std::size_t>(pair.master_column);
    auto link = std::find_if(links.begin(), links.end(), [&](const auto& l) { return l.master_ == column; });
    if (link == links.end()) {
      links.emplace_back();
      link = links.end() - 1;
      link->master_ = column;
    }
    link->slaves_.push_back(slave);
    link->scratch_.resize(link->slaves_.size());
  }
  return links;
}

bool GantryLink::active() const {
  return std::any_of(slaves_.begin(), slaves_.end(), [](const Slave& slave) { return slave.active(); });
}

bool GantryLink::has(std::size_t column) const {
  return column == master_ || std::any_of(slaves_.begin(), slaves_.end(), [&](const Slave& slave) {
           return static_cast<std::size_t>(slave.pair.slave_column) == column;
         });
}

// The stretch half a step ahead keeps the energy of the vibration.
double GantryLink::force(const Slave& slave, const std::vector<SimulatedAxis>& axes, double ahead) const {
  if (slave.stiffness <= 0) return 0;
  const auto& m = axes[master_];
  const auto& s = axes[static_cast<std::size_t>(slave.pair.slave_column)];
  const double sign = slave.pair.sign;
  const double speed = sign * s.load_speed() - m.load_speed();
  const double stretch = sign * (s.beam_position() - slave.pair.zero_deviation) - m.beam_position() +
                         speed * ahead + slave.misalignment;
  return slave.stiffness * stretch + slave.damping * speed;
}

double GantryLink::forces(const std::vector<SimulatedAxis>& axes, double ahead,
                          std::vector<double>& each) const {
  double sum = 0;
  for (std::size_t k = 0; k < slaves_.size(); ++k) sum += each[k] = force(slaves_[k], axes, ahead);
  return sum;
}

void GantryLink::step(std::vector<SimulatedAxis>& axes, std::span<const AxisSetpoint> setpoints, double dt,
                      ServoTest& test) {
  const double h = dt / servo_substeps;
  auto& master = axes[master_];
  master.begin(setpoints[master_], dt, test.of(master_));
  for (const auto& slave : slaves_) {
    const auto s = static_cast<std::size_t>(slave.pair.slave_column);
    axes[s].begin(setpoints[s], dt, test.of(s));
  }
  for (int i = 0; i < servo_substeps; ++i) {
    PartnerInput on_master;
    on_master.force = forces(axes, h / 2, scratch_);
    master.substep(i, on_master);
    for (std::size_t k = 0; k < slaves_.size(); ++k) {
      const auto& slave = slaves_[k];
      auto& axis = axes[static_cast<std::size_t>(slave.pair.slave_column)];
      PartnerInput in;
      in.force = -slave.pair.sign * scratch_[k];
      in.torque_follow = slave.torque_follow;
      in.torque = slave.torque_sign * master.torque_command();
      // Both position errors are one period old for the slave.
      if (slave.compensation > 0)
        in.speed_correction =
            slave.compensation * (axis.position_error() - slave.pair.sign * master.position_error());
      axis.substep(i, in);
    }
  }
  master.end();
  for (const auto& slave : slaves_) axes[static_cast<std::size_t>(slave.pair.slave_column)].end();
}

void GantryLink::run_out(std::vector<SimulatedAxis>& axes, std::span<const RunOut> ways, double dt) {
  const double h = dt / servo_substeps;
  const auto advance = [&](std::size_t column, double force) {
    if (ways[column] != RunOut::none)
      axes[column].run_out(ways[column], h, force);
    else
      axes[column].hold();
  };
  for (int i = 0; i < servo_substeps; ++i) {
    advance(master_, forces(axes, h / 2, scratch_));
    for (std::size_t k = 0; k < slaves_.size(); ++k)
      advance(static_cast<std::size_t>(slaves_[k].pair.slave_column), -slaves_[k].pair.sign * scratch_[k]);
  }
}

void GantryLink::hold(std::vector<SimulatedAxis>& axes) const {
  double sum = 0;
  for (const auto& slave : slaves_) {
    const double f = force(slave, axes, 0);
    sum += f;
    axes[static_cast<std::size_t>(slave.pair.slave_column)].preload(-slave.pair.sign * f);
  }
  axes[master_].preload(sum);
}

}  // namespace trunnion::drive
