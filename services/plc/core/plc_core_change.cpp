// SPDX-License-Identifier: Apache-2.0
// What changes a running PLC core from outside its programs: other programs, forces, the operator panel.
#include <algorithm>
#include <string>
#include <utility>

#include "plc_core.hpp"

namespace trunnion::plc {

void PlcCore::take_over(Programs& next, const st::Changeover& change) {
  const auto old = memory_.program;
  std::swap(structured_, next.structured), std::swap(switches_, next.switches);
  std::swap(messages_, next.messages);
  structured_.reset(memory_.program);
  // Programs with an error never ran; the corrected ones find their variables.
  if (!loaded_ && structured_.fits(old)) memory_.program = old;
  for (const auto& move : change.moves())
    std::copy_n(old.values.begin() + (move.from - st::image_cells), move.count,
                memory_.program.values.begin() + (move.to - st::image_cells));
  structured_.restore(memory_.program);
  memory_.program.main = {};  // it begins again
  structured_.set_not_run(memory_.program);
  auto& forces = memory_.forces;
  const auto before = std::exchange(forces, {});
  for (std::uint32_t i = 0; i < before.count; ++i)
    if (const auto cell = change.moved(before.values[i].cell)) {
      forces.values[forces.count] = before.values[i];
      forces.values[forces.count++].cell = *cell;
    }
  loaded_ = true;
  view_.changed = true;
}

bool PlcCore::force(const Force& force) {
  auto& forces = memory_.forces;
  const auto end = forces.values.begin() + forces.count;
  auto* at = std::find_if(forces.values.begin(), end, [&](const Force& other) {
    return other.cell == force.cell && other.bit == force.bit;
  });
  if (at == end && forces.count == most_forces) return false;
  if (at == end) ++forces.count;
  *at = force;
  view_.changed = true;
  return true;
}

bool PlcCore::release(std::uint32_t cell, int bit) {
  auto& forces = memory_.forces;
  const auto end = forces.values.begin() + forces.count;
  const auto at = std::find_if(forces.values.begin(), end,
                               [&](const Force& other) { return other.cell == cell && other.bit == bit; });
  if (at == end) return false;
  std::copy(at + 1, end, at);
  forces.values[--forces.count] = {};
  view_.changed = true;
  return true;
}

void PlcCore::release_all() {
  view_.changed = view_.changed || memory_.forces.count > 0;
  memory_.forces = {};
}

void PlcCore::apply_forces() {
  for (std::uint32_t i = 0; i < memory_.forces.count; ++i) {
    const auto& force = memory_.forces.values[i];
    if (force.cell >= st::image_cells) {
      structured_.put(force.cell, force.value, memory_.program);
    } else {
      const auto at = st::register_at(force.cell);
      store(memory_.registers, {at.area, at.index, static_cast<std::int8_t>(force.bit)},
            static_cast<std::int64_t>(force.value));
    }
  }
}

// Their cells are those of other programs.
void PlcCore::drop_forces_of_variables() {
  for (std::uint32_t i = memory_.forces.count; i-- > 0;)
    if (const auto force = memory_.forces.values[i]; force.cell >= st::image_cells)
      release(force.cell, force.bit);
}

// A press that arrives together with the release before it would otherwise be no change at all.
void PlcCore::scan_before(std::size_t byte) {
  if (unscanned_[byte]) advance(memory_.tick);
  unscanned_.set(byte);
}

std::string PlcCore::panel(const idl::plc::PanelRequest& request) {
  using idl::plc::PanelRequestKind;
  switch (request.kind) {
    case PanelRequestKind::PRESS_EMERGENCY_STOP:
      scan_before(emergency_button_.index);
      press_emergency_stop({request.client, request.number});
      break;
    case PanelRequestKind::RELEASE_EMERGENCY_STOP:
      scan_before(emergency_button_.index);
      input(emergency_button_, 0);
      view_.press_acted = true;
      break;
    case PanelRequestKind::RESET_EMERGENCY_STOP:
      press_reset();
      break;
    case PanelRequestKind::FORCE_INPUT:
      if (request.address >= register_count)
        return "input byte " + std::to_string(request.address) + " is outside 0 .. 511";
      if (request.value > 255) return "value " + std::to_string(request.value) + " is outside 0 .. 255";
      scan_before(request.address);
      input({Area::x, static_cast<std::uint16_t>(request.address), -1}, request.value);
      break;
    case PanelRequestKind::CHANNEL_ANSWER:
      return order_answered(request);
  }
  return "";
}

}  // namespace trunnion::plc
