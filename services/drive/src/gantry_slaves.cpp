// SPDX-License-Identifier: Apache-2.0
#include "gantry_slaves.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace trunnion::drive {

void GantrySlaves::configure(const machine::Parameters& p, std::size_t columns) {
  const auto before = std::exchange(slaves_, {});
  by_column_.assign(columns, -1);
  try {
    for (std::uint16_t channel = 0; channel < 10; ++channel) {
      const auto pairs = machine::gantry_pairs(p, channel);
      for (std::size_t k = 0; k < pairs.size(); ++k) {
        GantrySlave slave;
        const auto same = std::find_if(before.begin(), before.end(),
                                       [&](const auto& old) { return old.pair.slave == pairs[k].slave; });
        if (same != before.end()) slave = *same;
        slave.pair = pairs[k];
        slave.channel = channel, slave.place = k, slave.places = pairs.size();
        by_column_[slave.column()] = static_cast<int>(slaves_.size());
        slaves_.push_back(slave);
      }
    }
  } catch (const std::runtime_error&) {
    slaves_.clear();
    by_column_.assign(columns, -1);
  }
}

}  // namespace trunnion::drive
