// SPDX-License-Identifier: Apache-2.0
#include "stream_writer.hpp"

#include <algorithm>

#include "channel_snapshot.hpp"

namespace trunnion::channel {

void StreamWriter::start() {
  if (!may_start_) return;
  equal_cycles_ = 0;
  link_.request_start();
}

// The slowest replica may not have heard of this motion yet.
bool StreamWriter::may_write(std::uint32_t count, std::uint64_t ahead) {
  if (!link_.credit(count, ahead)) return false;
  if (link_.starts()) motion_start_ = link_.next();
  const auto end = link_.next() + count, distance = 2 * ahead;
  if (end > limit_) return false;
  return end <= distance || end - distance <= std::max(floor_, motion_start_);
}

void StreamWriter::open(idl::stream::PathBatch& batch) const {
  batch.setpoints.clear();
  batch.lines.clear();
  batch.spindle.clear();
  batch.turning_radius.clear();
  batch.ends = false;
  batch.count = 0;
}

void StreamWriter::add(idl::stream::PathBatch& batch, const StreamCycle& cycle) {
  const auto number = this->cycle(batch);
  auto& written = written_[number % history];
  written = cycle.shown;
  written.cycle = number;
  batch.setpoints.insert(batch.setpoints.end(), cycle.setpoint.begin(), cycle.setpoint.end());
  batch.lines.push_back(cycle.line);
  if (cycle.spindle) batch.spindle.push_back(*cycle.spindle);
  // Of each setpoint or none: one without has that of its neighbour.
  if (cycle.radius)
    batch.turning_radius.resize(batch.count + 1, *cycle.radius);
  else if (!batch.turning_radius.empty())
    batch.turning_radius.push_back(batch.turning_radius.back());
  ++batch.count;
  equal_cycles_ = cycle.stopped && cycle.setpoint == last_setpoint_ ? equal_cycles_ + 1 : 0;
  last_setpoint_ = cycle.setpoint;
  batch.ends = cycle.may_end && (cycle.at_rest || (cycle.holding && equal_cycles_ > standstill_cycles));
}

void StreamWriter::close(idl::stream::PathBatch& batch, const ChannelPath& path, bool machine_coordinates,
                         std::uint64_t revision, std::uint16_t spindle_axis) {
  batch.channel = channel_;
  batch.replica = 0;
  batch.epoch = link_.epoch();
  batch.first = link_.next();
  batch.revision = revision;
  batch.starts = link_.starts();
  const bool rtcp = path.rtcp() && !machine_coordinates;
  batch.transformation = idl_of(rtcp ? language::Transformation::rtcp : language::Transformation::none);
  batch.tool_length = machine_coordinates ? 0 : path.tool_length();
  batch.spindle_axis = spindle_axis;
  batch.states.clear();
  if (batch.starts) batch.states = link_.states();
}

const WrittenSetpoint* StreamWriter::executed() const {
  if (link_.executed() == 0) return nullptr;
  const auto& written = at(link_.executed() - 1);
  return written.cycle == link_.executed() - 1 ? &written : nullptr;
}

void StreamWriter::forget_blocks() {
  for (auto& written : written_) written.sequence = 0, written.line = 0;
}

}  // namespace trunnion::channel
