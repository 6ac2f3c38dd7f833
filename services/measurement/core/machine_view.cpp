// SPDX-License-Identifier: Apache-2.0
#include "machine_view.hpp"

#include <algorithm>

#include "canonical/axes.hpp"
#include "machine/alarm_constants.hpp"

namespace trunnion::measurement {

using idl::channel::RunState;

void MachineView::watch(std::uint16_t channel) {
  if (channel == channel_) return;
  channel_ = channel;
  states_ = 0;
  variables_.clear();
  state_.reset();
  if (const auto known = others_.find(channel); known != others_.end()) state_ = known->second;
}

void MachineView::take(const idl::channel::ChannelState& state, double now) {
  others_[state.channel] = state;
  if (state.channel != channel_) return;
  state_ = state;
  ++states_;
  heard_ = now;
}

void MachineView::take(const idl::service::Alarm& alarm) {
  // What a measurement itself reports stops no other one.
  if (alarm.number == alarm::measurement_stopped.number) return;
  const std::array<std::uint32_t, 3> key{alarm.instance, alarm.number, alarm.part};
  if (!alarm.active)
    stopping_.erase(key);
  else if (alarm.severity >= idl::service::Severity::ERROR)
    stopping_.try_emplace(key,
                          Entry{{-static_cast<int>(alarm.reaction), ++order_},
                                {alarm.number, "alarm " + std::to_string(alarm.number) + ": " + alarm.text}});
}

void MachineView::take(const idl::channel::Variables& variables) {
  if (variables.channel != channel_) return;
  variables_.clear();
  for (std::size_t i = 0; i < std::min(variables.numbers.size(), variables.values.size()); ++i)
    variables_[variables.numbers[i]] = variables.values[i];
}

bool MachineView::running() const {
  return state_ && (state_->state == RunState::RUNNING || state_->state == RunState::HOLDING ||
                    state_->state == RunState::WAITING);
}

StoppingAlarm MachineView::stopping() const {
  std::map<std::pair<int, std::uint64_t>, const StoppingAlarm*> sorted;
  for (const auto& [key, entry] : stopping_) sorted[entry.rank] = &entry.alarm;
  StoppingAlarm all;
  for (const auto& [rank, alarm] : sorted) {
    if (all.number == 0) all.number = alarm->number;
    if (!all.text.empty()) all.text += "; ";
    all.text += alarm->text;
  }
  return all;
}

calibration::AxisPosition MachineView::position() const {
  calibration::AxisPosition position{};
  if (!state_) return position;
  for (std::size_t i = 0; i < std::min(state_->letters.size(), state_->machine.size()); ++i) {
    const auto axis = canonical::axis_letters.find(state_->letters[i]);
    if (axis != std::string_view::npos) position[axis] = state_->machine[i];
  }
  return position;
}

}  // namespace trunnion::measurement
