// SPDX-License-Identifier: Apache-2.0
// Spindles that follow the stream: their setpoints come with those of the axes and are passed, interpolated
// and braked along with them, so a spindle keeps its place to the axes whatever the drive does.
#include "drive_core.hpp"

namespace trunnion::drive {

const double* DriveCore::spindle_row(const Channel& channel, std::uint64_t cycle) const {
  for (const auto* frame = channel.window.peek(); frame != nullptr;
       frame = channel.window.find(frame->first + frame->count)) {
    if (cycle < frame->first || cycle >= frame->first + frame->count) continue;
    return frame->spindle.empty() ? nullptr : &frame->spindle[cycle - frame->first];
  }
  return nullptr;
}

// Before the cycle `next_` is passed.
void DriveCore::couple_spindles() {
  for (auto& [number, channel] : channels_) {
    if (!channel.active) continue;
    const double* revolutions = spindle_row(channel, next_);
    if (revolutions == nullptr) {
      release_spindle(channel);
      continue;
    }
    if (channel.spindle < 0)
      channel.spindle = machine::column_of(spindles_.axes(), channel.window.peek()->spindle_axis);
    if (channel.spindle < 0) continue;
    const double angle = status_.spindles[static_cast<std::size_t>(channel.spindle)].angle;
    spindles_.coupling(channel.spindle).couple(*revolutions, angle);
  }
}

void DriveCore::lead_spindles(double phase) {
  for (const auto& [number, channel] : channels_) {
    if (!channel.active || channel.spindle < 0) continue;
    if (const double* next = spindle_row(channel, next_))
      spindles_.coupling(channel.spindle).lead(phase, *next);
  }
}

void DriveCore::release_spindle(Channel& channel) {
  if (channel.spindle >= 0) spindles_.coupling(channel.spindle).release();
  channel.spindle = -1;
}

}  // namespace trunnion::drive
