// SPDX-License-Identifier: Apache-2.0
// The explicit state of the executor, from which a verification continues.
#include "drive_core.hpp"
#include "snapshot/fields.hpp"

namespace trunnion::drive {

bus::Json DriveHardware::explicit_state() const { return nullptr; }

bus::Json DriveCore::explicit_state() const {
  auto hardware = hardware_->explicit_state();
  if (hardware.is_null()) return nullptr;
  auto state = snapshot::written(*this);
  state["hardware"] = std::move(hardware);
  return state;
}

void DriveCore::continue_from(const bus::Json& state) {
  snapshot::read(state, *this);
  hardware_->continue_from(state.at("hardware"));
  hardware_->status(status_);
}

}  // namespace trunnion::drive
