// SPDX-License-Identifier: Apache-2.0
// Every service of a machine is swapped, or killed, at every kind of rest; then the machine moves, without
// `down`. Of all pairs of a rest and a service each service is taken once for each action; the others, and
// rests that take minutes, with TRUNNION_ALL_RESTS (`make rests`).
#include <cstdlib>

#include "machine/parameter_constants.hpp"
#include "machine/services.hpp"
#include "recorded_machine.hpp"

namespace trunnion::integration {
namespace {

constexpr double position_tolerance = 0.01;  // mm

// By MDI to X in machine coordinates, as an operator who resets first: behind a change, a loss or a program.
void move(RecordedMachine& machine, double x) {
  auto& cluster = machine.cluster();
  const auto& channel = cluster.channels[0];
  const auto accepted = [&] {
    try {
      cluster.reset_alarms();
      cluster.client().channel(0, CommandKind::RESET);
      cluster.client().set_mode(0, Mode::MDI);
      cluster.client().mdi(0, "G90 G53 G1 X" + std::to_string(x) + " F6000");
      return true;
    } catch (const std::exception&) {
      return false;
    }
  };
  ASSERT_TRUE(cluster.until(accepted)) << cluster.told();
  ASSERT_TRUE(cluster.until([&] {
    return !channel.machine.empty() && std::abs(channel.machine[0] - x) < position_tolerance &&
           channel.state == RunState::IDLE;
  })) << cluster.told();
}

void run(RecordedMachine& machine, const std::string& program) {
  auto& cluster = machine.cluster();
  cluster.start_text(program);
  ASSERT_TRUE(cluster.finish(0, 300)) << cluster.told();
}

// The value waits for a reset.
void set_rapid_feed(RecordedMachine& machine) {
  static int calls = 0;
  idl::parameters::ParameterRequest request;
  request.role = 2;  // a builder's
  request.who = "test";
  request.operation = idl::parameters::Operation::SET;
  request.values = {{parameter::rapid_feed.number(0), 9000.0 + ++calls, ""}};
  ASSERT_TRUE(machine.cluster().client().parameter(request).accepted);
}

void change_the_program(RecordedMachine& machine) {
  run(machine, "G90 G1 X5 F6000\nM30\n");
  machine.cluster().client().upload("test0.nc", "G90 G1 X6 F6000\nM30\n");
}

// In virtual time a machine without motion has no cycles: what passes is the time of its messages.
void wait(RecordedMachine& machine, double seconds) {
  machine.cluster().until([] { return false; }, seconds);
}

void live_for_three_days(RecordedMachine& machine) {
  constexpr std::uint64_t cycles = 3 * 24 * 3600 * 1000ull;  // of 1 ms
  machine.down();
  ASSERT_NO_FATAL_FAILURE(machine.set_counters(cycles, cycles));
  machine.up();
}

struct Rest {
  const char* name;
  void (*act)(RecordedMachine&);
  /// Before each service; otherwise the services follow each other at one rest.
  bool again;
};
constexpr Rest short_rests[] = {
    {"BehindAMotion", [](RecordedMachine&) {}, true},
    {"BehindADwell", [](RecordedMachine& machine) { run(machine, "G4 X30\nM30\n"); }, true},
    {"WithAValueThatWaits", set_rapid_feed, true},
    {"WithChangedValues", [](RecordedMachine& machine) { machine.change_values(); }, true},
    {"WithAChangedProgram", change_the_program, true}};
// A writer keeps 90 s of the feedback of a machine at rest.
constexpr Rest long_rests[] = {
    {"BehindADwellOfTenMinutes", [](RecordedMachine& machine) { run(machine, "G4 X600\nM30\n"); }, false},
    {"LongerThanTheHistory", [](RecordedMachine& machine) { wait(machine, 100); }, false},
    {"AfterThreeDays", live_for_three_days, false}};

struct Action {
  const char* name;
  void (RecordedMachine::*replace)(const std::string& service);
};
constexpr Action actions[] = {{"Swap", &RecordedMachine::swap}, {"Loss", &RecordedMachine::kill_service}};

struct Case {
  Rest rest;
  Action action;
  std::size_t number;  // of the sample
};

bool all_rests() { return std::getenv("TRUNNION_ALL_RESTS") != nullptr; }

std::vector<Case> cases() {
  std::vector<Case> all;
  const auto add = [&](const Rest& rest, std::size_t number) {
    for (std::size_t i = 0; i < std::size(actions); ++i) all.push_back({rest, actions[i], number + i});
  };
  for (std::size_t i = 0; i < std::size(short_rests); ++i) add(short_rests[i], 2 * i);
  for (const auto& rest : long_rests)
    if (all_rests()) add(rest, 0);
  return all;
}

void PrintTo(const Case& one, std::ostream* out) { *out << one.action.name << one.rest.name; }

// Those of this machine. Of the sample every fifth: over the five short rests each of them once.
std::vector<std::string> services(RecordedMachine& machine, const Case& one) {
  std::vector<std::string> chosen;
  std::size_t place = 0;
  for (const auto& definition : machine::service::all) {
    if (machine.cluster().service(definition.name) == nullptr) continue;
    if (all_rests() || (place + one.number) % std::size(short_rests) == 0)
      chosen.emplace_back(definition.name);
    ++place;
  }
  return chosen;
}

class Rests : public testing::TestWithParam<Case> {};

TEST_P(Rests, EveryServiceIsReplacedAndTheMachineMoves) {
  const auto& [rest, action, number] = GetParam();
  RecordedMachine machine("ac-table", Time::virtual_);
  const auto chosen = services(machine, GetParam());
  ASSERT_FALSE(chosen.empty());
  double x = 10;
  ASSERT_NO_FATAL_FAILURE(move(machine, x));
  for (const auto& service : chosen) {
    SCOPED_TRACE(service);
    if (rest.again || service == chosen.front()) {
      ASSERT_NO_FATAL_FAILURE(rest.act(machine));
    }
    ASSERT_TRUE(machine.cluster().rests()) << machine.cluster().told();
    ASSERT_NO_FATAL_FAILURE((machine.*action.replace)(service));
    if (!rest.again && service != chosen.back()) continue;
    x = -x;
    ASSERT_NO_FATAL_FAILURE(move(machine, x));
    EXPECT_TRUE(machine.cluster().until([&] { return machine.cluster().active_alarms().empty(); }))
        << machine.cluster().active_alarms();
  }
}

INSTANTIATE_TEST_SUITE_P(Sample, Rests, testing::ValuesIn(cases()), [](const auto& test) {
  return std::string(test.param.action.name) + test.param.rest.name;
});

}  // namespace
}  // namespace trunnion::integration
