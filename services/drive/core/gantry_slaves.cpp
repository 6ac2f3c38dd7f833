// SPDX-License-Identifier: Apache-2.0
#include "gantry_slaves.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "channel_streams.hpp"
#include "return_move.hpp"
#include "stream/gantry_synchronization.hpp"
#include "stream/stage_core.hpp"

namespace trunnion::drive {
namespace {

constexpr std::uint8_t off_bit = 2;  // of Outputs::axis_enable

// mm: how far compensation puts the slave from where its master's setpoint says.
double compensated_offset(const GantrySlave& slave, const ChannelStreams& streams) {
  const auto* channel = streams.find(slave.channel);
  if (channel == nullptr) return 0;
  const auto* state = stream::find_state(channel->states, idl::stream::Stage::GANTRY);
  return state != nullptr ? stream::compensated_offsets(slave.places, state->values)[slave.place] : 0;
}

}  // namespace

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

double GantrySlaves::misalignment(const GantrySlave& slave, const ChannelStreams& streams,
                                  const std::vector<double>& command) {
  return slave.pair.error(command[slave.master_column()], command[slave.column()]) -
         compensated_offset(slave, streams);
}

void GantrySlaves::demand_off(const std::vector<std::uint8_t>& enable) {
  for (auto& slave : slaves_)
    slave.off_demanded = slave.pair.slave < enable.size() && (enable[slave.pair.slave] & off_bit) != 0;
}

void GantrySlaves::couple(const std::vector<double>& command) {
  for (auto& slave : slaves_) {
    if (slave.off == slave.off_demanded) continue;
    slave.off = slave.off_demanded;
    slave.held = command[slave.column()];
    slave.offset_known = slave.refused = false;
  }
}

// The error of the setpoints is what compensation wants.
void GantrySlaves::keep_distances(const ChannelStreams& streams, std::uint64_t next,
                                  const std::vector<double>& command) {
  for (auto& slave : slaves_) {
    if (slave.offset_known || slave.off) continue;
    const auto* channel = streams.find(slave.channel);
    if (channel == nullptr || !channel->active || channel->start != next) continue;
    const double* values = channel->row(next);
    const auto* batch = channel->window.peek();
    if (values == nullptr || batch == nullptr) continue;
    const auto value = [&](std::uint16_t axis) {
      const auto found = std::find(batch->axes.begin(), batch->axes.end(), axis);
      return found == batch->axes.end() ? nullptr : values + (found - batch->axes.begin());
    };
    const double *master = value(slave.pair.master), *own = value(slave.pair.slave);
    if (master == nullptr || own == nullptr) continue;
    const double distance = slave.pair.error(command[slave.master_column()], command[slave.column()]) -
                            slave.pair.error(*master, *own);
    slave.offset = std::abs(distance) > on_path_distance ? distance : 0;
    slave.offset_known = true;
  }
}

}  // namespace trunnion::drive
