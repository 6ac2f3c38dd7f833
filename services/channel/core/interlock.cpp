// SPDX-License-Identifier: Apache-2.0
#include "interlock.hpp"

#include "machine/alarm_constants.hpp"

namespace trunnion::channel {

bool Interlock::set_control(const idl::plc::ChannelControl& control) {
  const bool inhibited = control.manual_inhibit && !control_.manual_inhibit;
  control_ = control;
  return inhibited;
}

std::optional<Refusal> Interlock::motion(bool interrupted) const {
  if (!ready_) return Refusal{&alarm::not_ready, "The cluster is not ready: see the services"};
  if (holds()) return Refusal{&alarm::not_ready, hold_};
  if (drive_stopped() && !interrupted) return Refusal{&alarm::not_ready, drive_stopped_};
  return std::nullopt;
}

std::optional<Refusal> Interlock::start() const {
  if (!control_.start_inhibit) return std::nullopt;
  return Refusal{
      &alarm::not_ready,
      "No cycle start: " + (control_.reason.empty() ? "the machine's PLC inhibits it" : control_.reason)};
}

std::optional<Refusal> Interlock::manual_motion() const {
  if (!control_.manual_inhibit) return std::nullopt;
  return Refusal{
      &alarm::not_ready,
      "No manual motion: " + (control_.reason.empty() ? "the machine's PLC inhibits it" : control_.reason)};
}

}  // namespace trunnion::channel
