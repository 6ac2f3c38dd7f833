// SPDX-License-Identifier: Apache-2.0
#include "round_recorder.hpp"

#include <cstring>

namespace trunnion::plc {

bool RoundRecorder::begin_round(std::uint32_t generation, const PlcCore& core, std::uint64_t revision) {
  if (generation == generation_) return false;
  generation_ = generation;
  steps_.clear();
  if (generation == 0) return false;
  const Snapshot snapshot = core.snapshot();
  before_ = snapshot.memory.registers;
  number_ = 0;
  round_ = {};
  round_.generation = generation;
  round_.start.resize(sizeof snapshot);
  std::memcpy(round_.start.data(), &snapshot, sizeof snapshot);
  round_.revision = revision;
  round_.rescanned = changes(before_, core.rescanned());
  round_.tick = snapshot.memory.tick;
  round_.outputs = core.outputs();
  round_.state = state_digest(snapshot);
  return true;
}

void RoundRecorder::record(StepKind kind, std::uint64_t value) {
  if (on()) steps_.push_back({kind, value, {}});
}

void RoundRecorder::record(const idl::stream::FeedbackFrame& frame) {
  if (!on()) return;
  idl::stream::FeedbackFrame seen;
  seen.first = frame.first;
  seen.count = frame.count;
  seen.tick = frame.tick;
  seen.spindle_speed = frame.spindle_speed;
  seen.enabled = frame.enabled;
  for (const auto& echo : frame.channels) {
    auto& kept = seen.channels.emplace_back();
    kept.channel = echo.channel;
    kept.active = echo.active;
  }
  record(StepKind::FEEDBACK, seen);
}

const Round& RoundRecorder::end_round(const PlcCore& core, const std::vector<idl::plc::AuxiliaryDone>& done) {
  const Snapshot snapshot = core.snapshot();
  round_ = {};
  round_.generation = generation_;
  round_.number = ++number_;
  round_.steps.swap(steps_);
  round_.tick = snapshot.memory.tick;
  round_.changed = changes(before_, snapshot.memory.registers);
  round_.outputs = core.outputs();
  round_.done = done;
  round_.state = state_digest(snapshot);
  before_ = snapshot.memory.registers;
  return round_;
}

}  // namespace trunnion::plc
