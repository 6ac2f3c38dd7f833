// SPDX-License-Identifier: Apache-2.0
// The explicit state of the executor, from which a verification continues.
#include "drive_core.hpp"
#include "snapshot/fields.hpp"

namespace trunnion::drive {
namespace {
// Written where there is something. It is behind the rest, as recordings have it.
constexpr const char* rare[] = {"homing_members",  "homing_channel",  "unsettled", "off_periods",
                                "slaves",          "after_alignment", "ramps",     "gears",
                                "synchronization", "surface"};

void put_last(bus::Json& state, const std::string& name) {
  const auto found = state.find(name);
  if (found == state.end()) return;
  auto value = std::move(*found);
  state.erase(name);
  state[name] = std::move(value);
}
}  // namespace

bus::Json DriveHardware::explicit_state() const { return nullptr; }

bus::Json DriveCore::explicit_state() const {
  auto hardware = hardware_->explicit_state();
  if (hardware.is_null()) return nullptr;
  auto state = snapshot::written(*this);
  for (const auto* name : rare) put_last(state, name);
  state["hardware"] = std::move(hardware);
  return state;
}

void DriveCore::continue_from(const bus::Json& state) {
  snapshot::read(state, *this);
  hardware_->continue_from(state.at("hardware"));
  hardware_->status(status_);
}

}  // namespace trunnion::drive
