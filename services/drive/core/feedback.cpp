// SPDX-License-Identifier: Apache-2.0
// What the drive reports: executed rows, the axes, and the consistent cut of every channel.
#include "drive_core.hpp"

namespace trunnion::drive {

void DriveCore::fill(idl::stream::Feedback& out) {
  const std::size_t n = axes_.size();
  rows_.fill(out, next_);
  out.tick = tick_;
  out.mode = mode_ == Mode::HELD && streams_.resume_demanded() ? Mode::RETURNING : mode_;
  out.revision = revision_;
  out.axis_count = static_cast<std::uint16_t>(n);
  out.velocity.resize(n);
  out.torque.resize(n);
  out.position.resize(n);
  out.enabled.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    out.velocity[i] = status_.axes[i].velocity;
    out.torque[i] = status_.axes[i].torque;
    out.position[i] = status_.axes[i].position;
    const auto* slave = slaves_.at(i);
    out.enabled[i] = mode_ == Mode::OFF ? 0 : slave != nullptr && slave->off ? 3 : 1;
  }
  spindles_.fill(status_.spindles, row_.spindles, row_.controlled, out, row_.spindles_controlled);
  out.starved = starved_;
  out.skip_inputs = status_.skip_inputs;
  streams_.fill(next_, out);
}

}  // namespace trunnion::drive
