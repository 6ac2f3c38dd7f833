// SPDX-License-Identifier: Apache-2.0
// Values and programs of a PLC that runs, over DDS; kill -9 in every phase of a change.
#include <filesystem>
#include <fstream>
#include <random>

#include "plc_over_dds.hpp"

namespace trunnion::plc {
namespace {

using idl::plc::LoadPhase;
using idl::plc::OnlineAction;
using idl::plc::OnlineRequest;
constexpr int online_domain = 64;

// `old` runs first. Both count in `kept`; what counts in R3 tells them apart.
constexpr const char* fast_text = "PROGRAM fast\nEND_PROGRAM\n";
std::string main_text(bool is_new) {
  const std::string more = is_new ? "list : ARRAY[1..400] OF INT; " : "";
  return "PROGRAM main\nVAR " + more +
         "kept, seen : DINT; END_VAR VAR RETAIN hours : DINT; END_VAR\n"
         "IF %X16.0 THEN kept := 77; hours := 88; END_IF;\nseen := kept;\n%R3 := " +
         (is_new ? "2" : "1") + ";\nEND_PROGRAM\n";
}

void install_old(const RunningService& service) {
  service.write("state/cluster.boot", "boot\n");
  std::filesystem::create_directories(service.machine() + "/plc");
  service.write("machine/plc/fast.st", fast_text);
  service.write("machine/plc/main.st", main_text(false));
}

OnlineRequest request_of(OnlineAction action, std::vector<std::string> paths = {},
                         std::vector<std::string> values = {}) {
  OnlineRequest request;
  request.action = action;
  request.paths = std::move(paths), request.values = std::move(values);
  return request;
}

// The cells of a watch list.
std::vector<std::uint64_t> values_of(Machine& machine, const std::vector<std::string>& paths) {
  auto reader = machine.bus().reader(topics::plc_watched);
  const auto reply = machine.call(request_of(OnlineAction::WATCH, paths));
  EXPECT_TRUE(reply.accepted) << reply.reason;
  idl::plc::Watched sample;
  const bool found = eventually([&] {
    while (reader.take(sample))
      if (sample.client == reply.client && sample.number == reply.number) return true;
    return false;
  });
  EXPECT_TRUE(found);
  machine.call(OnlineAction::END_WATCH);
  return sample.cells;
}

// Holds the key until the main task, which does not run in every period, has seen it.
void set_kept_values(Machine& machine) {
  ASSERT_TRUE(machine.force(16, 1));
  ASSERT_TRUE(
      eventually([&] { return values_of(machine, {"main.kept"}) == std::vector<std::uint64_t>{77}; }));
  ASSERT_TRUE(machine.force(16, 0));
}

void write(Machine& machine, const std::string& name, const std::string& text) {
  auto request = request_of(OnlineAction::WRITE_SOURCE);
  request.file = name;
  request.data.assign(text.begin(), text.end());
  EXPECT_TRUE(machine.call(request).accepted);
}

bool is_in(Machine& machine, LoadPhase phase) {
  return eventually([&] { return machine.call(OnlineAction::LOAD_STATUS).phase == phase; });
}

OnlineRequest take_over_request() {
  auto request = request_of(OnlineAction::TAKE_OVER);
  request.accept_differences = true;  // R3
  return request;
}

// Up to and with that phase of a change to the new programs.
void go_to(Machine& machine, int phase) {
  machine.call(OnlineAction::BEGIN_LOAD);
  if (phase < 1) return;
  write(machine, "fast.st", fast_text);
  write(machine, "main.st", main_text(true));
  if (phase < 2) return;
  machine.call(OnlineAction::COMPILE);
  if (phase < 3) return;
  ASSERT_TRUE(is_in(machine, LoadPhase::COMPILED));
  if (phase < 4) return;
  EXPECT_TRUE(machine.call(OnlineAction::COMPARE).accepted);
  if (phase < 5) return;
  const auto reply = machine.call(take_over_request());
  EXPECT_TRUE(reply.accepted) << reply.reason;
}

std::string journal_of(const RunningService& service) {
  std::ifstream in(service.state() + "/plc.jsonl");
  return {std::istreambuf_iterator<char>(in), {}};
}

TEST(PlcOnline, AForceIsShownJournalledAndSurvivesAKill) {
  RunningService service(TRUNNION_PLC, "plc_force", online_domain);
  install_old(service);
  service.start({"--virtual-time"});
  Machine machine(online_domain);
  ASSERT_TRUE(machine.wait_for([] { return true; }));
  EXPECT_EQ(machine.call(request_of(OnlineAction::FORCE, {"main.seen"}, {"yes"})).reason,
            "'main.seen': 'yes' is no DINT: write a whole number -2147483648 .. 2147483647");
  ASSERT_TRUE(machine.call(request_of(OnlineAction::FORCE, {"main.seen", "%Y5.2"}, {"-3", "TRUE"})).accepted);
  EXPECT_EQ(values_of(machine, {"main.seen", "%Y5.2"}),
            (std::vector<std::uint64_t>{static_cast<std::uint64_t>(-3), 1}));
  ASSERT_TRUE(machine.wait_for([&] {
    return machine.forced_text ==
           "2 of the PLC's values are forced, the first is main.seen = -3: release them with 'trunnion plc "
           "force --release'";
  })) << machine.forced_text;
  EXPECT_NE(journal_of(service).find("\"what\":\"force\",\"paths\":[\"main.seen\",\"%Y5.2\"]"),
            std::string::npos)
      << journal_of(service);
  service.kill_hard();
  machine.have_outputs = false;
  machine.forced_text.clear();
  service.start({"--virtual-time"});
  ASSERT_TRUE(machine.wait_for([&] { return !machine.forced_text.empty(); }));
  EXPECT_EQ(values_of(machine, {"main.seen"}).at(0), static_cast<std::uint64_t>(-3));
  ASSERT_TRUE(machine.call(OnlineAction::RELEASE).accepted);
  ASSERT_TRUE(machine.wait_for([&] { return machine.forced_text.empty(); }));
  EXPECT_EQ(values_of(machine, {"main.seen"}).at(0), 0u);
}

TEST(PlcOnline, NewProgramsTakeOverWithTheOldValuesAndAreUndone) {
  RunningService service(TRUNNION_PLC, "plc_load", online_domain);
  install_old(service);
  service.start({"--virtual-time"});
  Machine machine(online_domain);
  ASSERT_TRUE(machine.wait_for([] { return true; }));
  set_kept_values(machine);

  machine.call(OnlineAction::BEGIN_LOAD);
  write(machine, "fast.st", fast_text);
  write(machine, "main.st", "PROGRAM main\nlamp := TRUE;\nEND_PROGRAM\n");
  machine.call(OnlineAction::COMPILE);
  ASSERT_TRUE(is_in(machine, LoadPhase::WITH_ERRORS));
  EXPECT_EQ(machine.call(OnlineAction::LOAD_STATUS).messages,
            (std::vector<std::string>{"main.st:2:1: error: there is no variable 'lamp'"}));
  EXPECT_FALSE(machine.call(take_over_request()).accepted);
  EXPECT_EQ(values_of(machine, {"main.kept", "%R3"}), (std::vector<std::uint64_t>{77, 1}));

  go_to(machine, 4);
  EXPECT_EQ(machine.call(OnlineAction::TAKE_OVER).reason,
            "1 registers or variables differ, the running one's value first; tick 100, register R3: 1 and 2");
  EXPECT_EQ(values_of(machine, {"main.kept", "%R3"}), (std::vector<std::uint64_t>{77, 1}));
  EXPECT_TRUE(machine.call(take_over_request()).accepted);
  EXPECT_EQ(values_of(machine, {"main.kept", "main.hours", "%R3"}), (std::vector<std::uint64_t>{77, 88, 2}));

  auto read = request_of(OnlineAction::READ_SOURCE);
  read.program = idl::plc::ProgramSet::PREVIOUS, read.first = 1;
  const auto source = machine.call(read);
  EXPECT_EQ(source.file, "main.st");
  EXPECT_EQ(std::string(source.data.begin(), source.data.end()), main_text(false));
  machine.call(OnlineAction::BEGIN_LOAD);
  write(machine, "fast.st", fast_text);
  write(machine, "main.st", main_text(false));
  machine.call(OnlineAction::COMPILE);
  EXPECT_TRUE(machine.call(take_over_request()).accepted);
  EXPECT_EQ(values_of(machine, {"main.kept", "main.hours", "%R3"}), (std::vector<std::uint64_t>{77, 88, 1}));
  EXPECT_EQ(machine.call(request_of(OnlineAction::WATCH, {"main.list"})).reason,
            "'main.list': there is no such variable");
}

// Whatever the instant: the old programs or the new ones, each with the values that were there.
TEST(PlcOnline, AKillInEveryPhaseLosesNoValueAndLeavesWholePrograms) {
  std::mt19937 random(17);
  int is_new = 0;
  for (int round = 0; round < 16; ++round) {
    const int phase = round < 6 ? round : 6;
    RunningService service(TRUNNION_PLC, "plc_kill_" + std::to_string(round), online_domain);
    install_old(service);
    service.start({"--virtual-time"});
    Machine machine(online_domain);
    ASSERT_TRUE(machine.wait_for([] { return true; }));
    set_kept_values(machine);
    go_to(machine, std::min(phase, 5) - (phase == 6 ? 1 : 0));
    if (phase == 6) {
      machine.send(take_over_request());
      usleep(random() % 6000);
    }
    service.kill_hard();
    machine.have_outputs = false;
    service.start({"--virtual-time"});
    ASSERT_TRUE(machine.wait_for([&] { return !machine.outputs.emergency_stop; }));
    const auto values = values_of(machine, {"main.kept", "main.hours"});
    EXPECT_EQ(values, (std::vector<std::uint64_t>{77, 88})) << "phase " << phase;
    const auto program = values_of(machine, {"%R3"}).at(0);
    if (phase < 5) {
      EXPECT_EQ(program, 1u) << "phase " << phase;
    }
    if (phase == 5) {
      EXPECT_EQ(program, 2u);
    }
    if (phase == 6) is_new += program == 2;
    // A load goes on from its beginning.
    EXPECT_EQ(machine.call(OnlineAction::LOAD_STATUS).phase, LoadPhase::NO_LOAD);
  }
  RecordProperty("taken over before the kill, of 10", is_new);
}

// The directory of the machine wins at the start of a cluster when it has other programs than it had.
TEST(PlcOnline, LoadedProgramsRunInLaterStartsUntilTheMachineGetsOthers) {
  RunningService service(TRUNNION_PLC, "plc_later", online_domain);
  install_old(service);
  service.start({"--virtual-time"});
  {
    Machine machine(online_domain);
    ASSERT_TRUE(machine.wait_for([] { return true; }));
    set_kept_values(machine);
    go_to(machine, 5);
  }
  service.kill_hard();
  service.write("state/cluster.boot", "another boot\n");
  service.start({"--virtual-time"});
  {
    Machine machine(online_domain);
    ASSERT_TRUE(machine.wait_for([] { return true; }));
    EXPECT_EQ(values_of(machine, {"main.kept", "main.hours", "%R3"}), (std::vector<std::uint64_t>{0, 88, 2}));
  }
  service.kill_hard();
  service.write("state/cluster.boot", "a third boot\n");
  service.write("machine/plc/main.st", main_text(false) + "// corrected\n");
  service.start({"--virtual-time"});
  Machine machine(online_domain);
  ASSERT_TRUE(machine.wait_for([] { return true; }));
  EXPECT_EQ(values_of(machine, {"%R3"}).at(0), 1u);
}

TEST(PlcOnline, ProgramsWithAnErrorAreReplacedWhileThePlcRuns) {
  RunningService service(TRUNNION_PLC, "plc_corrected", online_domain);
  install_old(service);
  service.write("machine/plc/main.st", "PROGRAM main\nlamp := TRUE;\nEND_PROGRAM\n");
  service.start({"--virtual-time"});
  Machine machine(online_domain);
  ASSERT_TRUE(machine.wait_for([&] { return machine.state.lifecycle == idl::service::Lifecycle::FAULT; }));
  go_to(machine, 3);
  EXPECT_TRUE(machine.call(take_over_request()).accepted);
  ASSERT_TRUE(machine.wait_for([&] { return machine.state.lifecycle == idl::service::Lifecycle::ACTIVE; }));
  EXPECT_FALSE(machine.outputs.emergency_stop);
  EXPECT_EQ(values_of(machine, {"%R3"}).at(0), 2u);
}

}  // namespace
}  // namespace trunnion::plc
