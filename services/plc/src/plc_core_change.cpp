// SPDX-License-Identifier: Apache-2.0
// What changes a running PLC core from outside its programs: other programs, forces.
#include <algorithm>
#include <utility>

#include "plc_core.hpp"

namespace trunnion::plc {

void PlcCore::take_over(Programs& next, const st::Changeover& change) {
  const auto old = memory_.program;
  std::swap(fast_, next.fast), std::swap(main_, next.main);
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

}  // namespace trunnion::plc
