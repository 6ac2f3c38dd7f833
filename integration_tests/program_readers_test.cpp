// SPDX-License-Identifier: Apache-2.0
// The first alarm of a program is the same wherever it is read: by `trunnion check`, by the page and by the
// channel.
#include <gtest/gtest.h>

#include <cstdlib>
#include <memory>
#include <ostream>
#include <sstream>

#include "analysis/check_program.hpp"
#include "bus/json.hpp"
#include "channel_fixture.hpp"
#include "collision_guard/collision_guard.hpp"
#include "core/program_check.hpp"
#include "parameter_store/machine_tables.hpp"

namespace trunnion {
namespace {

struct FirstAlarm {
  std::uint32_t number = 0, line = 0;
  bool operator==(const FirstAlarm&) const = default;
};
void PrintTo(const FirstAlarm& alarm, std::ostream* out) {
  *out << alarm.number << " in line " << alarm.line;
}

struct WrongProgram {
  const char* text;
  FirstAlarm alarm;
};
void PrintTo(const WrongProgram& program, std::ostream* out) { *out << program.text; }

FirstAlarm alarm_of(const bus::Json& document) {
  if (!document.contains("error")) return {};
  const auto& error = document["error"];
  return {error["number"].get<std::uint32_t>(), error["line"].get<std::uint32_t>()};
}

/// X Y Z of 400 mm to either side, tool 1, no spindle.
class ProgramReaders : public channel::testing::Channel, public ::testing::WithParamInterface<WrongProgram> {
 protected:
  FirstAlarm by_check() {
    channel_setup::ChannelSetup machine(0);
    configure(machine);
    language::StringSource source(GetParam().text);
    std::ostringstream out;
    analysis::CheckOptions options;
    options.json_lines = true;
    const auto guard = guard_of(machine);
    options.guard = guard.get();
    analysis::check_program(
        source, machine, machine.reference_position(), options, [](std::uint32_t) { return "part.nc"; }, out);
    std::istringstream lines(out.str());
    std::string last;
    for (std::string line; std::getline(lines, line);) last = line;
    return alarm_of(bus::Json::parse(last));
  }
  FirstAlarm by_page() {
    channel_setup::ChannelSetup machine(0);
    configure(machine);
    language::StringSource source(GetParam().text);
    const auto guard = guard_of(machine);
    return alarm_of(gateway::check_program(source, machine, guard.get(), {}));
  }
  FirstAlarm by_channel() {
    load(GetParam().text);
    EXPECT_TRUE(ask(idl::channel::CommandKind::CYCLE_START).accepted);
    run();
    const std::string name = "part.nc:";
    for (const auto& event : events)
      if (event.text.starts_with(name))
        return {event.alarm->number,
                static_cast<std::uint32_t>(std::strtoul(event.text.c_str() + name.size(), nullptr, 10))};
    return {};
  }
  std::string bodies_;  ///< bodies.yaml; empty: the machine has none

 private:
  std::unique_ptr<collision_guard::CollisionGuard> guard_of(const channel_setup::ChannelSetup& setup) const {
    if (bodies_.empty()) return nullptr;
    auto guard = std::make_unique<collision_guard::CollisionGuard>(
        setup, machine::CollisionMode::stop, collision_guard::BodiesText{"bodies.yaml", bodies_});
    guard->configure(*parameters, 0);
    return guard;
  }
  void configure(channel_setup::ChannelSetup& machine) const {
    machine.configure(*parameters);
    idl::parameters::ToolTable tools;
    tools.tools.resize(1);
    tools.tools[0].number = 1, tools.tools[0].length = 50;
    machine.set_tools(tools);
    machine.set_offsets({});
  }
};

TEST_P(ProgramReaders, FindTheSameFirstAlarm) {
  EXPECT_EQ(by_check(), GetParam().alarm);
  EXPECT_EQ(by_page(), GetParam().alarm);
  EXPECT_EQ(by_channel(), GetParam().alarm);
}

INSTANTIATE_TEST_SUITE_P(
    Text, ProgramReaders,
    ::testing::Values(
        WrongProgram{"G0 X1\nX2 @5\nM30\n", {1003, 2}}, WrongProgram{"G0 X1\nX2 (open\nM30\n", {1004, 2}},
        WrongProgram{"G0 X1\nX Y1\nM30\n", {1005, 2}}, WrongProgram{"G0 X1\nX1234567890\nM30\n", {1006, 2}},
        WrongProgram{"G0 X1\nX2 Y1 X3\nM30\n", {1007, 2}}, WrongProgram{"G0 X1\nTANGON P0\nM30\n", {1011, 2}},
        WrongProgram{"G0 X1\nG77 X2\nM30\n", {1101, 2}}, WrongProgram{"G0 X1\nG0 G1 X2\nM30\n", {1103, 2}},
        WrongProgram{"G0 X1\nM1000\nM30\n", {1104, 2}}, WrongProgram{"G0 X1\nT1.5\nM30\n", {1540, 2}},
        WrongProgram{"G0 X1\nG1 X2 F100 R5\nM30\n", {1107, 2}}, WrongProgram{"G0 X1\nG43\nM30\n", {1108, 2}},
        WrongProgram{"G0 X1\nW1\nM30\n", {1109, 2}}, WrongProgram{"G0 X1\nF0\nM30\n", {1112, 2}}));

INSTANTIATE_TEST_SUITE_P(Meaning, ProgramReaders,
                         ::testing::Values(WrongProgram{"G2 X1 F100\nM30\n", {1201, 1}},
                                           // The radii are 5 and 5.11 mm: 0.11 apart, 0.1 allowed.
                                           WrongProgram{"G2 X10.11 I5 F100\nM30\n", {1204, 1}},
                                           // Half the chord is 5 mm.
                                           WrongProgram{"G2 X10 R4.89 F100\nM30\n", {1205, 1}},
                                           WrongProgram{"G0 X1\nG43 H7\nM30\n", {1303, 2}},
                                           WrongProgram{"G0 X1\nG29 X1\nM30\n", {1305, 2}},
                                           WrongProgram{"G0 X1\nM98 P77\nM30\n", {1401, 2}},
                                           WrongProgram{"M98 P5\nM30\nO5\nG0 X1\n", {1403, 5}},
                                           WrongProgram{"G0 X1\nENDIF\nM30\n", {1404, 2}},
                                           WrongProgram{"IF [1 EQ 2]\nG0 X1\nM30\n", {1405, 1}},
                                           WrongProgram{"G0 X1\nGOTO 10\nN20 M30\n", {1407, 2}},
                                           WrongProgram{"#1=1\n#3000=12 (TOOL BROKEN)\nM30\n", {1501, 2}},
                                           WrongProgram{"G0 X1\n#1=5/[3-3]\nM30\n", {1505, 2}},
                                           WrongProgram{"G0 X1\n#1=LN[0]\nM30\n", {1506, 2}},
                                           WrongProgram{"G0 X1\n#1=#200\nM30\n", {1509, 2}},
                                           WrongProgram{"G0 X1\n#5001=1\nM30\n", {1510, 2}},
                                           WrongProgram{"G0 X1\nG81 X5 F100\nM30\n", {1601, 2}},
                                           WrongProgram{"G0 X1\nG41 D7\nM30\n", {1701, 2}},
                                           WrongProgram{"G0 X1\nT4 M6\nM30\n", {1709, 2}}));

// What the language allows and the machine does not.
INSTANTIATE_TEST_SUITE_P(
    Machine, ProgramReaders,
    ::testing::Values(WrongProgram{"G0 X390\nX401\nM30\n", {140, 2}},
                      // A circle about X410 of radius 20 goes to X430.
                      WrongProgram{"G0 X390 Y0\nG2 X390 Y0 I20 F10000\nM30\n", {140, 2}},
                      WrongProgram{"M98 P5\nM30\nO5\nG0 X1\nX401\nM99\n", {140, 5}},
                      // The input of a skip move need not come before its end.
                      WrongProgram{"G0 X390\nG31 X401 F1000\nM30\n", {140, 2}},
                      // No speed of the spindle: the feed per revolution is none per minute.
                      WrongProgram{"G0 X1\nG95 G1 X10 F0.1\nM30\n", {1112, 2}},
                      WrongProgram{"S400 M3\nG0 Z5\nG99 G84 X0 Y0 Z-10 R2 F500\nG80\nM30\n", {1125, 3}},
                      WrongProgram{"G0 X10\nG4 P100\nM3 S100\nX0\nM30\n", {0, 0}}));

/// The AC machine with a post at +X.
class ProgramReadersAmongBodies : public ProgramReaders {
 protected:
  void SetUp() override {
    drive = channel::testing::FakeDrive(5);
    auto table = std::make_shared<machine::Parameters>(
        tool_tables::load_machine_tables(std::string(MACHINES_DIRECTORY) + "/ac-table").parameters);
    table->values[902] = {16, ""}, table->values[903] = {32, ""};
    parameters = table;
    bodies_ = R"(
structure: "[w C' A' b X Y Z (S) t]"
clearance_mm: 1
bodies:
  - {name: head, on: spindle, sphere: {diameter_mm: 20}}
  - {name: post, on: base, box: {size_mm: [20, 300, 300]}, position_mm: [110, 0, 0]}
)";
    ProgramReaders::SetUp();
    core->guard(machine::CollisionMode::stop, {"bodies.yaml", bodies_});
  }
};

TEST_P(ProgramReadersAmongBodies, FindTheSameFirstAlarm) {
  EXPECT_EQ(by_check(), GetParam().alarm);
  EXPECT_EQ(by_page(), GetParam().alarm);
  EXPECT_EQ(by_channel(), GetParam().alarm);
}

// The head of radius 10 may go to X89: the post begins at X100, and the clearance is 1 mm.
INSTANTIATE_TEST_SUITE_P(Bodies, ProgramReadersAmongBodies,
                         ::testing::Values(WrongProgram{"G90\nG0 X80\nX150\nM30\n", {176, 3}},
                                           WrongProgram{"G90\nG0 X80\nX0\nM30\n", {0, 0}}));

}  // namespace
}  // namespace trunnion
