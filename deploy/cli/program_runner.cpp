// SPDX-License-Identifier: Apache-2.0
#include "program_runner.hpp"

#include <csignal>
#include <functional>
#include <stdexcept>

#include "canonical/axes.hpp"

namespace trunnion::cli {
namespace {

using idl::channel::RunState;

constexpr double silence = 10;      // s without a state of a running channel
constexpr double first_state = 10;  // s, of a computer under load
constexpr double late_news = 0.5;   // s: alarms come on another topic than the state
constexpr double variables_wait = 5;

std::atomic<bool> interrupt_requested{false};

}  // namespace

InterruptWatch::InterruptWatch() {
  interrupt_requested = false;
  for (const int number : {SIGINT, SIGTERM}) std::signal(number, [](int) { interrupt_requested = true; });
}
InterruptWatch::~InterruptWatch() {
  for (const int number : {SIGINT, SIGTERM}) std::signal(number, SIG_DFL);
}
bool InterruptWatch::requested() { return interrupt_requested; }

struct ProgramRunner::Readers {
  explicit Readers(bus::Bus& bus)
      : states(bus.reader(topics::channel_state)),
        alarm_news(bus.reader(topics::alarm)),
        variable_news(bus.reader(topics::variables)),
        lists(bus.reader(topics::program_list)) {}

  bus::Reader<idl::channel::ChannelState> states;
  bus::Reader<idl::service::Alarm> alarm_news;
  bus::Reader<idl::channel::Variables> variable_news;
  bus::Reader<idl::program::ProgramList> lists;
  idl::channel::ChannelState state;
  idl::program::ProgramList list;
  bool have_list = false;
  std::uint64_t state_count = 0;
  double newest_state = 0;  // s, monotonic
  struct Stopping {
    // The strongest reaction first, then by arrival: what follows from it comes after the cause.
    std::pair<int, std::uint64_t> rank;
    std::string text;
  };
  std::map<std::array<std::uint32_t, 3>, Stopping> stopping;  // by instance, number, part
  std::uint64_t order = 0;
  calibration::MacroVariables variables;
};

ProgramRunner::ProgramRunner(std::uint32_t domain, std::uint16_t channel)
    : channel_(channel), client_(domain), readers_(std::make_unique<Readers>(client_.bus())) {
  if (!wait(first_state, [&] { return readers_->state_count > 0; }))
    throw std::runtime_error("channel " + std::to_string(channel) + " of the cluster publishes no state");
  wait(late_news, [] { return false; });
  const auto& state = readers_->state;
  if (!readers_->stopping.empty()) throw std::runtime_error(alarms());
  if (state.state != RunState::IDLE)
    throw std::runtime_error("channel " + std::to_string(channel) + " is " + bus::to_string(state.state) +
                             " with a program: end or reset it first");
  if (!state.homed)
    throw std::runtime_error("channel " + std::to_string(channel) +
                             ": an axis has no reference; home the axes first");
}

ProgramRunner::~ProgramRunner() = default;

void ProgramRunner::drain() {
  auto& r = *readers_;
  idl::channel::ChannelState state;
  while (r.states.take(state)) {
    if (state.channel != channel_) continue;
    r.state = state, ++r.state_count;
    r.newest_state = service::monotonic_seconds();
  }
  idl::service::Alarm alarm;
  while (r.alarm_news.take(alarm)) {
    const std::array<std::uint32_t, 3> key{alarm.instance, alarm.number, alarm.part};
    if (!alarm.active)
      r.stopping.erase(key);
    else if (alarm.severity >= idl::service::Severity::ERROR)
      r.stopping.try_emplace(key,
                             Readers::Stopping{{-static_cast<int>(alarm.reaction), ++r.order},
                                               "alarm " + std::to_string(alarm.number) + ": " + alarm.text});
  }
  r.have_list = r.lists.take_newest(r.list) || r.have_list;
  idl::channel::Variables variables;
  while (r.variable_news.take(variables)) {
    if (variables.channel != channel_) continue;
    r.variables.clear();
    for (std::size_t i = 0; i < std::min(variables.numbers.size(), variables.values.size()); ++i)
      r.variables[variables.numbers[i]] = variables.values[i];
  }
}

bool ProgramRunner::wait(double seconds, const std::function<bool()>& condition) {
  const double end = service::monotonic_seconds() + seconds;
  for (;;) {
    drain();
    if (condition()) return true;
    if (service::monotonic_seconds() >= end) return false;
    client_.bus().signal().wait(0.01);
  }
}

std::string ProgramRunner::alarms() const {
  std::map<std::pair<int, std::uint64_t>, std::string> sorted;
  for (const auto& [key, alarm] : readers_->stopping) sorted[alarm.rank] = alarm.text;
  std::string text;
  for (const auto& [rank, alarm] : sorted) text += (text.empty() ? "" : "; ") + alarm;
  return text;
}

void ProgramRunner::fail(const std::string& otherwise) {
  wait(late_news, [] { return false; });
  const auto raised = alarms();
  throw std::runtime_error(raised.empty() ? otherwise : raised);
}

void ProgramRunner::provide(const std::string& name, const std::string& text) {
  if (!wait(5, [&] { return readers_->have_list; }))
    throw std::runtime_error("the program service publishes no list of the programs");
  for (const auto& program : readers_->list.programs)
    if (program.name == name) return;
  client_.upload(name, text);
}

void ProgramRunner::remove(const std::string& name) {
  idl::program::ProgramRequest request;
  request.operation = idl::program::Operation::REMOVE;
  request.name = name;
  client_.program(request);
}

// The list with a new program may reach the channel after the answer of the store.
void ProgramRunner::select(const std::string& name) {
  constexpr int tries = 100;
  for (int i = 0;; ++i) try {
      client_.select_program(channel_, name);
      return;
    } catch (const std::exception&) {
      if (i == tries) throw;
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
}

void ProgramRunner::hold() {
  try {
    client_.channel(channel_, cluster::CommandKind::FEED_HOLD);
  } catch (const std::exception& e) {
    throw std::runtime_error(std::string("interrupted; the channel could not be held: ") + e.what());
  }
  if (!wait(silence, [&] {
        return readers_->state.state != RunState::RUNNING && readers_->state.state != RunState::HOLDING;
      }))
    throw std::runtime_error("interrupted; the channel does not come to rest");
  throw std::runtime_error(std::string("interrupted; the channel is ") +
                           bus::to_string(readers_->state.state) + ", reset it before anything else");
}

calibration::MacroVariables ProgramRunner::run(const std::string& name, const std::string& text,
                                               std::uint32_t serial) {
  auto& r = *readers_;
  if (InterruptWatch::requested()) throw std::runtime_error("interrupted; the channel is at rest");
  client_.upload(name, text);
  client_.set_mode(channel_, idl::channel::Mode::AUTO);
  select(name);
  r.variables.clear();
  client_.channel(channel_, cluster::CommandKind::CYCLE_START);
  drain();
  // The first state after the answer may have been on its way before, the second cannot.
  const auto before = r.state_count;
  if (!wait(silence, [&] { return r.state_count >= before + 2 || InterruptWatch::requested(); }))
    fail("channel " + std::to_string(channel_) + " does not answer");
  for (;;) {
    wait(0.1, [&] { return r.state.state == RunState::IDLE || InterruptWatch::requested(); });
    if (InterruptWatch::requested()) hold();
    if (r.state.state == RunState::IDLE) break;
    if (r.state.state == RunState::INTERRUPTED)
      fail("the motion was interrupted in line " + std::to_string(r.state.line) + " of " + name + " (" +
           (r.state.detail.empty() ? std::string("a process of the stream has ended") : r.state.detail) +
           "); reset the channel");
    if (r.state.state == RunState::HELD && !r.stopping.empty()) fail("");
    if (service::monotonic_seconds() - r.newest_state > silence)
      fail("channel " + std::to_string(channel_) + " does not answer");
  }
  if (!wait(variables_wait,
            [&] { return calibration::completed(r.variables, serial) || !r.stopping.empty(); }) ||
      !r.stopping.empty())
    fail(name + " was ended before its last touch, by a reset");
  return r.variables;
}

calibration::AxisPosition ProgramRunner::position() {
  const auto count = readers_->state_count;
  wait(1, [&] { return readers_->state_count > count; });
  const auto& state = readers_->state;
  calibration::AxisPosition position{};
  for (std::size_t i = 0; i < std::min(state.letters.size(), state.machine.size()); ++i) {
    const auto axis = canonical::axis_letters.find(state.letters[i]);
    if (axis != std::string_view::npos) position[axis] = state.machine[i];
  }
  return position;
}

}  // namespace trunnion::cli
