// SPDX-License-Identifier: Apache-2.0
#include "spindles.hpp"

namespace trunnion::drive {

void Spindles::configure(const machine::Parameters& parameters, double period) {
  axes_ = machine::spindles(parameters);
  couplings_.resize(axes_.size());
  orientations_.resize(axes_.size());
  for (std::size_t i = 0; i < axes_.size(); ++i)
    orientations_[i].configure(orientation_settings(parameters, axes_[i].number), period);
}

void Spindles::demand_speeds(const std::vector<double>& speed) {
  for (std::size_t i = 0; i < couplings_.size(); ++i)
    couplings_[i].demand_speed(i < speed.size() ? speed[i] : 0);
}

void Spindles::demand_orientations(const std::vector<std::uint8_t>& orient) {
  for (std::size_t i = 0; i < orientations_.size(); ++i)
    orientations_[i].demand(i < orient.size() && orient[i] != 0);
}

void Spindles::lead_on(double cycles) {
  for (auto& coupling : couplings_) coupling.lead_on(cycles);
}

void Spindles::step(const std::vector<SpindleStatus>& status, bool controlled,
                    std::vector<SpindleSetpoint>& out) {
  for (std::size_t i = 0; i < couplings_.size(); ++i)
    out[i] = orientations_[i].step(couplings_[i].setpoint(), status[i], controlled);
}

void Spindles::fill(const std::vector<SpindleStatus>& status, idl::stream::Feedback& out) const {
  out.spindle_speed.resize(size());
  out.spindle_oriented.resize(size());
  for (std::size_t i = 0; i < size(); ++i) {
    out.spindle_speed[i] = status[i].speed;
    out.spindle_oriented[i] = orientations_[i].oriented(status[i]) ? 1 : 0;
  }
}

}  // namespace trunnion::drive
