// SPDX-License-Identifier: Apache-2.0
#include "spindle_read.hpp"

#include <cmath>
#include <cstddef>

#include "canonical/spindle_value.hpp"

namespace trunnion::channel {

double spindle_value(const idl::stream::Feedback& feedback, std::uint32_t number) {
  using canonical::SpindleValue;
  using idl::stream::SpindleCondition;
  const auto spindle = canonical::read_spindle(number);
  if (spindle >= feedback.spindles.size()) return 0;
  const auto& state = feedback.spindles[spindle];
  switch (canonical::read_value(number)) {
    case SpindleValue::homed:
      return state.homed ? 1 : 0;
    case SpindleValue::synchronized:
      return state.condition == SpindleCondition::SPINDLE_SYNCHRONIZED ? 1 : 0;
    case SpindleValue::master:
      return state.master + 1;
    case SpindleValue::error:
      return state.synchronization_error * 360;
    case SpindleValue::reference:
      return state.reference;
    case SpindleValue::angle:
      return (state.angle - std::floor(state.angle)) * 360;
    case SpindleValue::positioned:
      return state.condition == SpindleCondition::SPINDLE_POSITIONING ||
                     state.condition == SpindleCondition::SPINDLE_ORIENTED ||
                     state.condition == SpindleCondition::SPINDLE_FOLLOWS_PATH
                 ? 1
                 : 0;
  }
  return 0;
}

std::uint32_t synchronized_spindles(const idl::stream::Feedback& feedback) {
  using idl::stream::SpindleCondition;
  std::uint32_t spindles = 0;
  for (std::size_t slave = 0; slave < feedback.spindles.size(); ++slave) {
    const auto& state = feedback.spindles[slave];
    const bool follows = state.condition == SpindleCondition::SPINDLE_SYNCHRONIZING ||
                         state.condition == SpindleCondition::SPINDLE_SYNCHRONIZED;
    if (!follows || state.master < 0) continue;
    spindles |= 1u << slave;
    spindles |= 1u << static_cast<unsigned>(state.master);
  }
  return spindles;
}

}  // namespace trunnion::channel
