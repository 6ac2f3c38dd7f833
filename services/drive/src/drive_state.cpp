// SPDX-License-Identifier: Apache-2.0
// The explicit state of the executor, from which a verification continues.
#include <algorithm>

#include "drive_core.hpp"
#include "snapshot/fields.hpp"

namespace trunnion::drive {

/// The list of fields; limits, axes and other values that configure() takes from the parameters are none.
struct DriveState {
  // No fields, configure() sets them: dt_, virtual_time_, lead_, prefill_, revision_, axes_, limits_,
  // spindle_axes_. No fields, the hardware has a state of its own and gives its status: hardware_, status_.
  // No fields, every use sets them before: scratch_, before_. No fields, the service has taken them:
  // resumed_, events_. No field, its slaves are one: slaves_. No field, a row of a simulation is in force in
  // its own period: moved_.
  template <class Core>
  struct Of {
    Core& core;
    template <class Self, class Visit>
    static void fields(Self& self, Visit&& visit) {
      auto& c = self.core;
      visit("channels", c.channels_), visit("row", c.row_), visit("rows", c.rows_);
      visit("probe_contact", c.probe_contact_), visit("probe_watched", c.probe_watched_);
      visit("mode", c.mode_), visit("enabled", c.enabled_), visit("control_lost", c.control_lost_);
      visit("next", c.next_), visit("tick", c.tick_), visit("starved", c.starved_);
      visit("command", c.command_), visit("target", c.target_), visit("velocity", c.velocity_);
      visit("rate", c.rate_), visit("rate_step", c.rate_step_), visit("phase", c.phase_);
      visit("dip_step", c.dip_step_), visit("dip_depth", c.dip_depth_), visit("dip_periods", c.dip_periods_);
      visit("off_path", c.off_path_), visit("reserve", c.reserve_);
      visit("settle", c.settle_), visit("homing", c.homing_), visit("homing_axis", c.homing_axis_);
      visit("return_from", c.return_from_), visit("return_to", c.return_to_);
      visit("return_periods", c.return_periods_), visit("return_done", c.return_done_);
      visit("spindles", c.spindles_), visit("orientations", c.orientations_);
      visit("reported", c.reported_);
      // Written where there is something: recordings of machines without gantries have no such state.
      constexpr bool reads = !std::is_const_v<Core>;
      if (reads || !c.homing_members_.empty()) visit("homing_members", c.homing_members_);
      if (reads || c.homing_channel_ != 0) visit("homing_channel", c.homing_channel_);
      if (reads || std::any_of(c.unsettled_.begin(), c.unsettled_.end(), [](auto n) { return n > 0; }))
        visit("unsettled", c.unsettled_);
      if (reads || c.off_periods_ != 0) visit("off_periods", c.off_periods_);
      if (reads || !c.slaves_.empty()) visit("slaves", c.slaves_.all());
      if (reads || c.after_alignment_ != Mode::OFF) visit("after_alignment", c.after_alignment_);
    }
  };
};

bus::Json DriveHardware::explicit_state() const { return nullptr; }

bus::Json DriveCore::explicit_state() const {
  auto hardware = hardware_->explicit_state();
  if (hardware.is_null()) return nullptr;
  auto state = snapshot::written(DriveState::Of<const DriveCore>{*this});
  state["hardware"] = std::move(hardware);
  return state;
}

void DriveCore::continue_from(const bus::Json& state) {
  DriveState::Of<DriveCore> fields{*this};
  snapshot::read(state, fields);
  hardware_->continue_from(state.at("hardware"));
  hardware_->status(status_);
}

}  // namespace trunnion::drive
