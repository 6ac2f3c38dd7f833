// SPDX-License-Identifier: Apache-2.0
// Writes the channel's setpoints into the stream: its place there, batches of cycles, and what of them the
// drive has executed.
#pragma once

#include <optional>
#include <vector>

#include "channel_path.hpp"
#include "path_progress.hpp"
#include "stream_link.hpp"

namespace trunnion::channel {

/// What is written of one cycle.
struct StreamCycle {
  WrittenSetpoint shown;  ///< its cycle is the writer's
  AxisValues setpoint{};
  std::uint32_t line = 0;         ///< of the program
  std::optional<double> spindle;  ///< revolutions of a coupled spindle
  std::optional<double> radius;   ///< mm, with a constant surface speed
  bool stopped = false;           ///< the path speed is 0
  bool at_rest = false;           ///< the path has come to its end
  bool holding = false;           ///< the path brakes for a hold
  bool may_end = true;            ///< nothing else is in motion
};

class StreamWriter {
 public:
  explicit StreamWriter(std::uint16_t channel) : channel_(channel), link_(channel), written_(history) {}

  StreamLink& link() { return link_; }
  const StreamLink& link() const { return link_; }
  /// The stream is active or its last setpoints are being executed.
  bool moving() const { return link_.state() == LinkState::active || link_.state() == LinkState::ending; }
  /// The stream is idle: nothing is written that the drive has not executed.
  bool idle() const { return link_.state() == LinkState::idle; }

  /// The replicas of every stage are in step, or a start has to wait. `floor` is the cycle the slowest of
  /// them computes next; nothing is written farther than twice `ahead` beyond it.
  void set_replicas(bool may_start, std::uint64_t floor) { may_start_ = may_start, floor_ = floor; }
  /// Nothing is written beyond the cycle `limit`, up to which recorders read in time.
  void set_limit(std::uint64_t limit) { limit_ = limit; }
  /// Asks the drive for a place in the stream, once the replicas are in step.
  void start();

  /// Credit of the drive, of the replicas and of the recorders for `count` more cycles, at most `ahead`
  /// beyond the executed one.
  bool may_write(std::uint32_t count, std::uint64_t ahead);
  /// An empty batch, from the next cycle on.
  void open(idl::stream::PathBatch& batch) const;
  /// The cycle that the next add() writes.
  std::uint64_t cycle(const idl::stream::PathBatch& batch) const { return link_.next() + batch.count; }
  void add(idl::stream::PathBatch& batch, const StreamCycle& cycle);
  /// Fills the header of a batch with at least one cycle; with `machine_coordinates` the stages transform
  /// nothing. When the stream starts, the states of all stages are in it.
  void close(idl::stream::PathBatch& batch, const ChannelPath& path, bool machine_coordinates,
             std::uint64_t revision, std::uint16_t spindle_axis);
  /// Behind close() and the channel's own state.
  void written(const idl::stream::PathBatch& batch) { link_.written(batch.count, batch.ends); }

  /// What was written in `cycle`, one of the newest `history`.
  const WrittenSetpoint& at(std::uint64_t cycle) const { return written_[cycle % history]; }
  /// The newest cycle that the drive has executed, when this process wrote it; else null.
  const WrittenSetpoint* executed() const;
  /// Of the newest executed cycle: what a process needs that continues this one.
  void set_executed(const WrittenSetpoint& written) { written_[written.cycle % history] = written; }
  /// A program or a line of MDI begins: what was written before belongs to none of its blocks.
  void forget_blocks();

  static constexpr std::size_t history = 2048;

 private:
  // A hold has ended in a standstill when the setpoints have been equal for this many cycles: a rounding at a
  // stop may still run out after the path speed is 0.
  static constexpr int standstill_cycles = 3;

  std::uint16_t channel_;
  StreamLink link_;
  bool may_start_ = true;
  std::uint64_t floor_ = ~0ull, limit_ = ~0ull, motion_start_ = 0;
  int equal_cycles_ = 0;
  AxisValues last_setpoint_{};
  std::vector<WrittenSetpoint> written_;
};

}  // namespace trunnion::channel
