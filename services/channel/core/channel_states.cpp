// SPDX-License-Identifier: Apache-2.0
#include "channel_states.hpp"

namespace trunnion::channel {
namespace {

template <class... F>
struct Overloaded : F... {
  using F::operator()...;
};
template <class... F>
Overloaded(F...) -> Overloaded<F...>;

const char* name_of(const Running& running) {
  switch (running.activity) {
    case Activity::program:
      return running.retracing ? "retracing" : "program";
    case Activity::mdi:
      return "MDI";
    case Activity::jog:
      return running.stopping ? "jog stopping" : "jog";
    case Activity::handwheel:
      return "handwheel";
  }
  return "";
}
const char* name_of(const Preparing&) { return "preparing"; }
std::string name_of(const Active& active) {
  return std::visit([](const auto& part) { return std::string(name_of(part)); }, active);
}

}  // namespace

void ChannelStates::require(bool allowed) {
  if (!allowed) throw std::bad_variant_access();
}

Active* ChannelStates::active() {
  return std::visit(Overloaded{[](Waiting& s) { return &s.then; }, [](Holding& s) { return &s.then; },
                               [](Held& s) { return &s.then; }, [](Interrupted& s) { return &s.then; },
                               [](auto&) { return static_cast<Active*>(nullptr); }},
                    state_);
}

const Active* ChannelStates::active() const {
  return std::visit(
      Overloaded{[](const Waiting& s) { return &s.then; }, [](const Holding& s) { return &s.then; },
                 [](const Held& s) { return &s.then; }, [](const Interrupted& s) { return &s.then; },
                 [](const auto&) { return static_cast<const Active*>(nullptr); }},
      state_);
}

Active ChannelStates::take_active() {
  if (auto* running = std::get_if<Running>(&state_)) return *running;
  if (auto* preparing = std::get_if<Preparing>(&state_)) return std::move(*preparing);
  auto* inner = active();
  if (inner == nullptr) throw std::bad_variant_access();
  return std::move(*inner);
}

void ChannelStates::advance(Active active) {
  std::visit([this](auto& part) { state_ = std::move(part); }, active);
}

std::optional<Activity> ChannelStates::activity() const {
  if (const auto* part = running()) return part->activity;
  if (preparing() != nullptr) return Activity::program;
  return std::nullopt;
}

bool ChannelStates::feed_hold() const {
  if (const auto* holding = std::get_if<Holding>(&state_)) return holding->feed_hold;
  const auto* interrupted = std::get_if<Interrupted>(&state_);
  return interrupted != nullptr && interrupted->feed_hold;
}

bool ChannelStates::resetting() const {
  if (const auto* holding = std::get_if<Holding>(&state_)) return holding->reset;
  const auto* interrupted = std::get_if<Interrupted>(&state_);
  return interrupted != nullptr && interrupted->reset;
}

bool ChannelStates::abandoned() const { return resetting() || (running() != nullptr && running()->stopping); }

bool ChannelStates::needs_reset() const {
  const auto* interrupted = std::get_if<Interrupted>(&state_);
  return (interrupted != nullptr && interrupted->drives_off) || (suspended_ && suspended_->drives_off);
}

bool ChannelStates::may_suspend() const {
  return in<Held>() && running() != nullptr && is(Activity::program) && !retracing();
}

RunState ChannelStates::published() const {
  return std::visit(
      Overloaded{[](const Idle&) { return RunState::IDLE; }, [](const Running&) { return RunState::RUNNING; },
                 [](const Preparing&) { return RunState::RUNNING; },
                 [](const Waiting&) { return RunState::WAITING; },
                 [](const Holding&) { return RunState::HOLDING; }, [](const Held&) { return RunState::HELD; },
                 [](const Interrupted&) { return RunState::INTERRUPTED; },
                 [](const Suspended&) { return RunState::HELD; }},
      state_);
}

std::string ChannelStates::name() const {
  const auto state = std::visit(
      Overloaded{[](const Idle&) { return std::string("Idle"); },
                 [](const Running& s) { return std::string("Running ") + name_of(s); },
                 [](const Preparing&) { return std::string("Preparing"); },
                 [](const Waiting& s) { return "Waiting " + name_of(s.then); },
                 [](const Holding& s) { return "Holding " + name_of(s.then) + (s.reset ? ", reset" : ""); },
                 [](const Held& s) { return "Held " + name_of(s.then); },
                 [](const Interrupted& s) {
                   return "Interrupted " + name_of(s.then) + (s.drives_off ? ", drives off" : "");
                 },
                 [](const Suspended&) { return std::string("Suspended"); }},
      state_);
  return suspended_ && busy() ? state + " (program suspended)" : state;
}

void ChannelStates::begin(Activity activity) {
  require(!busy() || (in<Interrupted>() && activity == Activity::program));
  state_ = Running{activity};
}

void ChannelStates::begin_interrupted() {
  require(in<Idle>());
  state_ = Interrupted{Running{Activity::program}};
}

void ChannelStates::prepare(Preparation preparation, bool confirm) {
  require(in<Running>() && is(Activity::program));
  Preparing preparing{std::move(preparation)};
  if (confirm)
    state_ = Held{std::move(preparing)};
  else
    state_ = std::move(preparing);
}

void ChannelStates::begin_return(Preparation preparation) {
  require(in<Suspended>());
  state_ = Preparing{std::move(preparation)};
}

void ChannelStates::end_preparation() {
  require(in<Preparing>());
  state_ = Running{Activity::program};
  suspended_.reset();
}

void ChannelStates::wait() {
  require(advances() && interpreting());
  state_ = Waiting{take_active()};
}

void ChannelStates::end_wait(bool hold) {
  if (!in<Waiting>()) return;
  auto active = take_active();
  if (hold)
    state_ = Held{std::move(active)};
  else
    advance(std::move(active));
}

void ChannelStates::hold() {
  require(advances());
  state_ = Holding{take_active(), true};
}

void ChannelStates::pause() {
  require(advances());
  state_ = Held{take_active()};
}

void ChannelStates::come_to_rest() { state_ = Held{std::move(std::get<Holding>(state_).then)}; }

void ChannelStates::resume() {
  auto active = std::move(std::get<Held>(state_).then);
  if (auto* running = std::get_if<Running>(&active)) running->retracing = false;
  advance(std::move(active));
}

void ChannelStates::resume_interrupted() {
  const bool dropped = abandoned(), reset = resetting();
  auto active = std::move(std::get<Interrupted>(state_).then);
  if (dropped)
    state_ = Holding{std::move(active), false, reset};
  else
    advance(std::move(active));
}

void ChannelStates::retrace(bool on) {
  auto* part = running();
  require(part != nullptr && part->activity == Activity::program);
  part->retracing = on;
  if (on && in<Held>()) advance(take_active());
}

void ChannelStates::stop_jog() {
  if (auto* part = running(); part != nullptr && part->activity == Activity::jog) part->stopping = true;
}

void ChannelStates::reset_at_rest() {
  require(advances() || in<Holding>());
  const bool braking = feed_hold();
  auto active = take_active();
  if (auto* running = std::get_if<Running>(&active)) running->retracing = false;
  state_ = Holding{std::move(active), braking, true};
}

void ChannelStates::interrupt(bool drives_off) {
  if (suspended_ && drives_off) suspended_->drives_off = true;
  if (!busy()) return;
  const bool off = drives_off || needs_reset(), braking = feed_hold(), reset = resetting();
  state_ = Interrupted{take_active(), braking, reset, off};
}

void ChannelStates::drop_preparation() {
  if (auto* inner = active(); inner != nullptr && std::holds_alternative<Preparing>(*inner))
    *inner = Running{Activity::program};
  else if (in<Preparing>())
    state_ = Running{Activity::program};
  else
    return;
  suspended_.reset();
}

void ChannelStates::suspend(SuspendedProgram program) {
  require(may_suspend());
  suspended_ = program;
  state_ = Suspended{};
}

void ChannelStates::end() {
  if (suspended_)
    state_ = Suspended{};
  else
    state_ = Idle{};
}

}  // namespace trunnion::channel
