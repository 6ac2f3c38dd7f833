// SPDX-License-Identifier: Apache-2.0
// A contact of the touch probe outside a skip move.
#include <cstdio>
#include <string>

#include "drive_core.hpp"
#include "machine/alarm_constants.hpp"

namespace trunnion::drive {

// Behind the last setpoint of a skip move the contact may still come: the axes follow with their lag.
void DriveCore::watch_probe() {
  if (!probe_.made((status_.skip_inputs & 1u) != 0, row_.probe_on)) return;
  if (mode_ != Mode::HOMING && streams_.any_skips()) return;
  std::string place;
  for (std::size_t i = 0; i < axes_.size() && place.size() < 120; ++i) {
    char text[48];
    const bool turns = axes_[i].type != machine::axis_type_linear;
    std::snprintf(text, sizeof text, "%s%s %.4f%s", place.empty() ? "" : ", ", axes_[i].name.c_str(),
                  status_.axes[i].position, turns ? " deg" : " mm");
    place += text;
  }
  raise(alarm::probe_contact, 0,
        "The touch probe made contact outside a skip move at " + place + ": reset, then retract the probe");
  if (mode_ == Mode::RETURNING)
    begin_braking();
  else
    stop();
}

}  // namespace trunnion::drive
