// SPDX-License-Identifier: Apache-2.0
#include "round_recorder.hpp"

#include <cstring>

namespace trunnion::plc {

bool RoundRecorder::begin_round(std::uint32_t generation, const PlcCore& core, std::uint64_t revision) {
  if (generation == generation_) return false;
  generation_ = generation;
  steps_.clear();
  if (generation == 0) return false;
  const PlcState state = core.state();
  before_ = state.memory.registers;
  number_ = 0;
  round_ = {};
  round_.generation = generation;
  round_.start.resize(sizeof state);
  std::memcpy(round_.start.data(), &state, sizeof state);
  round_.revision = revision;
  round_.rescanned = changes(before_, core.rescanned());
  round_.tick = state.memory.tick;
  round_.outputs = core.outputs();
  round_.state = state_digest(state);
  return true;
}

void RoundRecorder::record(StepKind kind, std::uint64_t value) {
  if (on()) steps_.push_back({kind, value, {}});
}

void RoundRecorder::record(const idl::stream::Feedback& feedback) {
  if (!on()) return;
  idl::stream::Feedback seen;
  seen.first = feedback.first;
  seen.count = feedback.count;
  seen.tick = feedback.tick;
  seen.spindle_speed = feedback.spindle_speed;
  seen.spindle_oriented = feedback.spindle_oriented;
  seen.spindles = feedback.spindles;
  seen.enabled = feedback.enabled;
  for (const auto& echo : feedback.channels) {
    auto& kept = seen.channels.emplace_back();
    kept.channel = echo.channel;
    kept.active = echo.active;
  }
  record(StepKind::FEEDBACK, seen);
}

const Round& RoundRecorder::end_round(const PlcCore& core, const std::vector<idl::plc::AuxiliaryDone>& done) {
  const PlcState state = core.state();
  round_ = {};
  round_.generation = generation_;
  round_.number = ++number_;
  round_.steps.swap(steps_);
  round_.tick = state.memory.tick;
  round_.changed = changes(before_, state.memory.registers);
  round_.outputs = core.outputs();
  round_.done = done;
  round_.state = state_digest(state);
  before_ = state.memory.registers;
  return round_;
}

}  // namespace trunnion::plc
