// SPDX-License-Identifier: Apache-2.0
#include "stream_settings.hpp"

#include <algorithm>

#include "machine/parameter_constants.hpp"

namespace trunnion::machine {

// Two batches must fit into what may be written, or the credits would never let the second be written.
StreamSettings::StreamSettings(const Parameters& p, bool virtual_time) {
  const auto cycles = [&](const auto& number) { return static_cast<std::uint64_t>(p.integer(number)); };
  lead = cycles(parameter::stream_lead);
  ahead = virtual_time ? std::max(lead, cycles(parameter::virtual_time_lead)) : lead;
  const auto size =
      cycles(virtual_time ? parameter::batch_cycles_virtual_time : parameter::batch_cycles_real_time);
  const auto fitting = [&](std::uint64_t distance) {
    return static_cast<std::uint32_t>(std::min(size, std::max<std::uint64_t>(1, distance / 2)));
  };
  batch = fitting(ahead);
  feedback_batch = fitting(lead);
}

}  // namespace trunnion::machine
