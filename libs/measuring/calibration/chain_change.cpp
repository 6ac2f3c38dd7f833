// SPDX-License-Identifier: Apache-2.0
#include "calibration/chain_change.hpp"

#include <stdexcept>

#include "machine/kinematics.hpp"
#include "machine/parameter_constants.hpp"

namespace trunnion::calibration {
namespace {

using machine::RealParameter;
using metrology::Slot;
using metrology::Vec3;

// In the order of Slot.
constexpr std::array<RealParameter, 6> offsets{parameter::table_offset_2, parameter::table_offset_1,
                                               parameter::table_offset_0, parameter::head_offset_2,
                                               parameter::head_offset_1,  parameter::head_offset_0};
constexpr std::array<RealParameter, 6> corrections{
    parameter::table_correction_2, parameter::table_correction_1, parameter::table_correction_0,
    parameter::head_correction_2,  parameter::head_correction_1,  parameter::head_correction_0};
constexpr std::array<RealParameter, 6> directions{parameter::table_direction_2, parameter::table_direction_1,
                                                  parameter::table_direction_0, parameter::head_direction_2,
                                                  parameter::head_direction_1,  parameter::head_direction_0};

}  // namespace

std::uint32_t offset_number(Slot slot, bool correction, std::uint16_t channel) {
  return (correction ? corrections : offsets)[metrology::index_of(slot)].number(channel);
}

std::uint32_t direction_number(Slot slot, std::uint16_t channel) {
  return directions[metrology::index_of(slot)].number(channel);
}

std::map<std::uint32_t, machine::ParameterValue> changed_parameters(const metrology::ChainParameters& before,
                                                                    const metrology::ChainParameters& after,
                                                                    std::uint16_t channel) {
  std::map<std::uint32_t, machine::ParameterValue> values;
  const auto set = [&](std::uint32_t number, double value) {
    if (const auto refused = machine::Catalogue::instance().check(number, value, ""); !refused.empty())
      throw std::runtime_error("nothing written: " + refused);
    values[number] = {value, ""};
  };
  const auto compare = [&](std::uint32_t number, const Vec3& old, const Vec3& now) {
    for (std::uint32_t i = 0; i < 3; ++i)
      if (old[i] != now[i]) set(number + i, now[i]);
  };
  for (const Slot slot : metrology::all_slots) {
    const auto& old = axis_at(before, slot);
    const auto& now = axis_at(after, slot);
    if (!old || !now) continue;
    compare(offset_number(slot, false, channel), old->offset, now->offset);
    compare(offset_number(slot, true, channel), old->correction, now->correction);
    if (old->direction.normalized() != now->direction.normalized())
      compare(direction_number(slot, channel), old->direction, now->direction);
  }
  compare(parameter::chain_origin.number(channel), before.origin, after.origin);
  if (before.open != after.open) set(parameter::chain_open.number(channel), after.open ? 1 : 0);
  return values;
}

std::array<bool, metrology::slot_count> named_corrections(const machine::Parameters& parameters,
                                                          std::uint16_t channel) {
  std::array<bool, metrology::slot_count> named{};
  for (const auto& element : machine::correction_elements(parameters, channel))
    for (const Slot slot : metrology::all_slots)
      if (offset_number(slot, true, channel) == element.number) named[metrology::index_of(slot)] = true;
  return named;
}

}  // namespace trunnion::calibration
