// SPDX-License-Identifier: Apache-2.0
#include "standby_comparison.hpp"

#include <algorithm>
#include <cstring>

#include "force_request.hpp"

namespace trunnion::plc {
namespace {

// Calls `use` with the sample of the step; false when it is none.
template <class T, class Use>
bool with_sample(const Step& step, Use use) {
  T sample;
  if (!bus::decode(step.sample, sample)) return false;
  use(sample);
  return true;
}

std::int32_t value_in(const Registers& registers, const RegisterValue& at) {
  return load(registers, {static_cast<Area>(at.area), at.index, -1});
}

const RegisterValue* find(const Changes& changes, const RegisterValue& at) {
  const auto found = std::find_if(changes.begin(), changes.end(), [&](const RegisterValue& other) {
    return other.area == at.area && other.index == at.index;
  });
  return found == changes.end() ? nullptr : &*found;
}

}  // namespace

StandbyComparison::Outcome StandbyComparison::play(const Round& round, std::uint32_t generation) {
  if (!difference_.empty()) return Outcome::differs;
  if (round.generation != generation) return Outcome::equal;
  if (round.number == 0) return begin(round);
  if (round.generation != generation_ || round.number != number_ + 1) return Outcome::gap;
  for (const Step& step : round.steps)
    if (step.kind == StepKind::PARAMETERS && find_(step.value) == nullptr) return Outcome::waiting;
  const Registers before = core_.memory().registers;
  for (const Step& step : round.steps)
    if (!repeat(step))
      return differ(round.tick,
                    std::string("a step ") + bus::to_string(step.kind) + " whose sample it cannot read");
  number_ = round.number;
  const Outcome outcome = compare(round, before);
  if (outcome == Outcome::equal) equal_ticks_ += round.tick - std::min(tick_, round.tick);
  tick_ = round.tick;
  return outcome;
}

StandbyComparison::Outcome StandbyComparison::begin(const Round& round) {
  PlcState state;
  if (round.start.size() != sizeof state) return differ(round.tick, "a different memory layout");
  if (!parameters(round.revision)) return Outcome::waiting;
  std::memcpy(&state, round.start.data(), sizeof state);
  if (!core_.accepts(state.memory.program))
    return differ(round.tick, "the variables of the programs: names, types or places differ");
  core_.adopt(state);
  generation_ = round.generation;
  number_ = 0;
  tick_ = round.tick;
  started_ = true;
  const Registers& registers = core_.memory().registers;
  if (const auto own = changes(registers, core_.rescanned()); own != round.rescanned)
    return differ(round.tick, registers, round.rescanned, own);
  return compare(round, registers);
}

bool StandbyComparison::parameters(std::uint64_t revision) {
  const auto found = find_(revision);
  if (found) core_.configure(*found, virtual_time_);
  return found != nullptr;
}

bool StandbyComparison::repeat(const Step& step) {
  switch (step.kind) {
    case StepKind::PARAMETERS:
      return parameters(step.value);
    case StepKind::FEEDBACK:
      return with_sample<idl::stream::Feedback>(step, [&](const auto& s) { core_.set_feedback(s); });
    case StepKind::CHANNEL_STATE:
      return with_sample<idl::channel::ChannelState>(step, [&](const auto& s) { core_.set_channel(s); });
    case StepKind::AUXILIARY_REQUEST:
      return with_sample<idl::channel::AuxiliaryRequest>(step, [&](const auto& s) { core_.set_request(s); });
    case StepKind::ALARMS:
      core_.set_alarms((step.value & 1) != 0, (step.value & 2) != 0);
      return true;
    case StepKind::PANEL_REQUEST:
      return with_sample<idl::plc::PanelRequest>(step, [&](const auto& s) { core_.panel(s); });
    case StepKind::RESET_BUTTON:
      core_.press_reset();
      return true;
    case StepKind::GIVE_UP_WAITING:
      core_.give_up_waiting();
      return true;
    case StepKind::ONLINE_REQUEST:
      return with_sample<idl::plc::OnlineRequest>(
          step, [&](const auto& s) { change_forces(s, variables_, core_); });
    case StepKind::ADVANCE:
      core_.advance(step.value);
      return true;
  }
  return false;
}

StandbyComparison::Outcome StandbyComparison::compare(const Round& round, const Registers& before) {
  if (const auto own = changes(before, core_.memory().registers); own != round.changed)
    return differ(round.tick, before, round.changed, own);
  if (core_.outputs() != round.outputs) return differ(round.tick, "the outputs");
  if (core_.take_done() != round.done) return differ(round.tick, "the functions finished");
  if (state_digest(core_.state()) != round.state)
    return differ(round.tick, "a variable that no register shows yet");
  return Outcome::equal;
}

StandbyComparison::Outcome StandbyComparison::differ(std::uint64_t tick, const std::string& what) {
  difference_ = "tick " + std::to_string(tick) + ", " + what;
  return Outcome::differs;
}

// The first register of the image whose value is not the same; a register that only one of the two has
// changed has kept its value in the other.
StandbyComparison::Outcome StandbyComparison::differ(std::uint64_t tick, const Registers& before,
                                                     const Changes& running, const Changes& own) {
  const auto order = [](const RegisterValue& a, const RegisterValue& b) {
    return std::pair(a.area, a.index) < std::pair(b.area, b.index);
  };
  Changes all = running;
  all.insert(all.end(), own.begin(), own.end());
  std::stable_sort(all.begin(), all.end(), order);
  for (const RegisterValue& at : all) {
    const auto value = [&](const Changes& changes) {
      const auto* changed = find(changes, at);
      return changed != nullptr ? changed->value : value_in(before, at);
    };
    if (value(running) != value(own))
      return differ(tick, "register " + register_name(at) + ": " + std::to_string(value(running)) + " and " +
                              std::to_string(value(own)));
  }
  return differ(tick, "the registers");
}

}  // namespace trunnion::plc
