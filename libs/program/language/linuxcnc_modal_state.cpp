// SPDX-License-Identifier: Apache-2.0
#include "language/linuxcnc_modal_state.hpp"

namespace trunnion::language {
namespace {

constexpr std::uint16_t mist_code = 7, flood_code = 8, coolant_off_code = 9;

}  // namespace

Fault LinuxcncModalState::restore(const SavedModes& saved) {
  ModalState& modal = state_.modal;
  const ModalState& then = saved.modal;
  if (const Fault fault = restore_tool(then)) return fault;
  if (const Fault fault = modal_.set_plane(0, then.plane)) return fault;
  if (then.work_offset != modal.work_offset) {
    if (const Fault fault = frames_.select(0, then.work_offset)) return fault;
  }
  modal.metric = then.metric;
  modal.absolute = then.absolute;
  modal.feed_mode = then.feed_mode;
  modal.feed = then.feed;
  modal.path_control = then.path_control;
  modal.path_tolerance = then.path_tolerance;
  modal.return_to_initial = then.return_to_initial;
  modal.absolute_centres = then.absolute_centres;
  restore_spindle(then);
  restore_coolant(saved.coolant);
  return {};
}

Fault LinuxcncModalState::restore_tool(const ModalState& saved) {
  const ModalState& modal = state_.modal;
  if (saved.cutter_side != modal.cutter_side) {
    if (saved.cutter_side != CutterSide::off)
      return {AlarmNumber::linuxcnc_function_missing, 0, "G41 and G42 are not restored"};
    if (const Fault fault = tools_.set_cutter_side(0, CutterSide::off)) return fault;
  }
  const bool same = saved.length_offset == modal.length_offset && saved.tool_length == modal.tool_length;
  return same ? Fault{} : tools_.put_length(0, saved.length_offset, saved.tool_length);
}

void LinuxcncModalState::restore_spindle(const ModalState& saved) {
  ModalState& modal = state_.modal;
  const bool same = saved.spindle_mode == modal.spindle_mode && saved.spindle_speed == modal.spindle_speed &&
                    saved.surface_speed == modal.surface_speed && saved.spindle_limit == modal.spindle_limit;
  if (!same) {
    modal.spindle_mode = saved.spindle_mode;
    modal.spindle_speed = saved.spindle_speed;
    modal.surface_speed = saved.surface_speed;
    modal.spindle_limit = saved.spindle_limit;
    output_.push(CommandKind::spindle_speed).value =
        saved.spindle_mode == SpindleMode::surface ? saved.surface_speed : saved.spindle_speed;
  }
  if (saved.spindle_direction == modal.spindle_direction) return;
  modal.spindle_direction = saved.spindle_direction;
  state_.parked = SpindleDirection::stopped;
  output_.push(CommandKind::auxiliary).number = saved.spindle_direction == SpindleDirection::cw    ? 3
                                                : saved.spindle_direction == SpindleDirection::ccw ? 4
                                                                                                   : 5;
}

// Only M9 switches off, and both.
void LinuxcncModalState::restore_coolant(std::uint8_t saved) {
  const auto give = [&](std::uint16_t code) {
    output_.push(CommandKind::auxiliary).number = code;
    note_coolant(code);
  };
  if ((state_.coolant & ~saved) != 0) give(coolant_off_code);
  const int missing = saved & ~state_.coolant;
  if ((missing & mist_on) != 0) give(mist_code);
  if ((missing & flood_on) != 0) give(flood_code);
}

void LinuxcncModalState::stop_at_end() {
  ModalState stopped = state_.modal;
  stopped.spindle_direction = SpindleDirection::stopped;
  restore_spindle(stopped);
  restore_coolant(0);
}

void LinuxcncModalState::note_coolant(std::uint16_t code) {
  if (code == mist_code) state_.coolant = static_cast<std::uint8_t>(state_.coolant | mist_on);
  if (code == flood_code) state_.coolant = static_cast<std::uint8_t>(state_.coolant | flood_on);
  if (code == coolant_off_code) state_.coolant = 0;
}

}  // namespace trunnion::language
