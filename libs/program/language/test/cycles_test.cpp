// SPDX-License-Identifier: Apache-2.0
// Canned cycles and hole patterns.
#include <gtest/gtest.h>

#include <set>

#include "test_machine.hpp"

namespace trunnion::language::test {
namespace {

TestMachine machine_for_cycles() {
  TestMachine machine;
  machine.cycles = {.retract = 0.5, .clearance = 1, .shift_axis = 1};
  return machine;
}

TEST(Cycles, TheSpindleOfATappingCycleIsNoAxisOfTheChannel) {
  TestMachine machine = machine_for_cycles();
  machine.axis_mask = 0b111;
  EXPECT_EQ(run(machine, "S100 G95 F1 G84 Z-5 R0 J3\n").last, Step::end);
  machine.axis_mask |= 1u << C;
  EXPECT_EQ(run(machine, "S100 G95 F1 G84 Z-5 R0 J3\n").alarm.number, AlarmNumber::value_range);
}

// HNC-8, "Five-axis rigid tapping": the axis number of the letter that J names is -2. A letter that is no
// axis at all (-1) taps nothing.
TEST(Cycles, JNamesALetterThatIsASpindle) {
  TestMachine machine = machine_for_cycles();
  machine.axis_mask = 0b11111;
  machine.spindles = 1u << U | 1u << W;
  for (const auto& [j, good] : {std::pair(3, false), {4, true}, {5, false}, {6, true}}) {
    const Interpretation result = run(machine, "S100 G95 F1 G84 Z-5 R0 J" + std::to_string(j) + "\n");
    EXPECT_EQ(result.alarm.number, good ? AlarmNumber::none : AlarmNumber::value_range) << j;
    std::set<std::uint32_t> axes;
    for (const Command& command : result.commands)
      if (command.kind == CommandKind::tap) axes.insert(command.number);
    EXPECT_EQ(axes, good ? std::set<std::uint32_t>{static_cast<std::uint32_t>(j)} : std::set<std::uint32_t>{})
        << j;
    const bool told = std::string(result.alarm.text.data()).find("must be -2") != std::string::npos;
    EXPECT_NE(told, good) << j;
  }
}

// M29 makes the next G84 rigid on Fanuc; here it is, so that a machine's logic need not know the code.
TEST(Cycles, M29PreparesWhatIsAlwaysSo) {
  TestMachine machine = machine_for_cycles();
  // 500 mm/min at 400 1/min: 1.25 mm a turn.
  const std::string text = "M29 S400\nF500 G99 G84 X0 Z-5 R0\nG80\nM30\n";
  machine.functions.emplace();
  machine.functions->add("3 4 5");
  EXPECT_EQ(stream(run(machine, text)),
            (std::vector<std::string>{"S400", "tap Z-5 lead1.25", "tap lead1.25", "end 30"}));
  machine.functions->add("29");
  EXPECT_EQ(stream(run(machine, text)),
            (std::vector<std::string>{"S400", "M29", "tap Z-5 lead1.25", "tap lead1.25", "end 30"}));
  EXPECT_EQ(run(machine, "M28\n").alarm.number, AlarmNumber::unknown_m);
}

TEST(Cycles, TheMachineSaysWhetherAHoleMayBeDrilledWithoutPecks) {
  const auto alarm = [](OneStroke rule, const std::string& text) {
    TestMachine machine = machine_for_cycles();
    machine.cycles.one_stroke = rule;
    return run(machine, text + "\n").alarm.number;
  };
  using enum AlarmNumber;
  for (const char* const code : {"G73", "G83"}) {
    const std::string zero = std::string(code) + " X1 Z-5 R2 Q0 F100";
    const std::string without = std::string(code) + " X1 Z-5 R2 F100";
    EXPECT_EQ(alarm(OneStroke::never, zero), cycle_peck_missing) << code;
    EXPECT_EQ(alarm(OneStroke::never, without), cycle_peck_missing) << code;
    EXPECT_EQ(alarm(OneStroke::by_zero, zero), none) << code;
    EXPECT_EQ(alarm(OneStroke::by_zero, without), cycle_peck_missing) << code;
    EXPECT_EQ(alarm(OneStroke::always, zero), none) << code;
    EXPECT_EQ(alarm(OneStroke::always, without), none) << code;
  }
}

// 5 mm times 2 and 1 mm times 2; the lead of the tap is what it is.
TEST(Cycles, AScaleActsOnTheDepthOfATapAndNotOnItsLead) {
  TestMachine machine = machine_for_cycles();
  std::vector<std::string> taps;
  for (const std::string& line :
       stream(run(machine, "G51 X0 Y0 Z0 P2\nS100 G95 F1.25 G99 G84 Z-5 R1\nG80\nM30\n")))
    if (line.rfind("tap", 0) == 0) taps.push_back(line);
  EXPECT_EQ(taps, (std::vector<std::string>{"tap Z-10 lead1.25", "tap Z2 lead1.25"}));
}

// A right-hand thread lets the tap out when the spindle turns counter-clockwise: the lead along the way is
// negative. Twice the distance with a scale of 2, the same lead.
TEST(Cycles, ATapIsRemovedAgainstTheHandOfItsThread) {
  TestMachine machine = machine_for_cycles();
  EXPECT_EQ(stream(run(machine, "G0 Z-8\nS200 G84.9 Z12 K1.25\nM30\n")),
            (std::vector<std::string>{"rapid Z-8", "S200", "tap Z4 lead-1.25", "end 30"}));
  EXPECT_EQ(stream(run(machine, "G0 Z-8\nS200 G84.9 Z12 K-1.25\nM30\n")),
            (std::vector<std::string>{"rapid Z-8", "S200", "tap Z4 lead1.25", "end 30"}));
  EXPECT_EQ(stream(run(machine, "G51 X0 Y0 Z0 P2\nG20\nS200 G84.9 Z1 K.05\nM30\n")),
            (std::vector<std::string>{"S200", "tap Z50.8 lead-1.27", "end 30"}));
  // Along X the tool may come from either side.
  EXPECT_EQ(stream(run(machine, "S200 G84.9 X-12 K1.25\nM30\n")),
            (std::vector<std::string>{"S200", "tap X-12 lead-1.25", "end 30"}));
  // So it may along an axis beside them.
  EXPECT_EQ(stream(run(machine, "G0 U1\nS200 G84.9 U-12 K1.25\nM30\n")),
            (std::vector<std::string>{"rapid U1", "S200", "tap U-11 lead-1.25", "end 30"}));
}

// Where the holes of a program are: the ends of its feed moves.
std::vector<std::array<double, 2>> holes(TestMachine& machine, const std::string& text) {
  const Interpretation result = run(machine, text);
  EXPECT_EQ(result.last, Step::end) << result.alarm.text.data();
  std::vector<std::array<double, 2>> places;
  for (const Command& command : result.commands) {
    if (command.kind == CommandKind::line) places.push_back({command.target[X], command.target[Y]});
  }
  return places;
}

void expect_places(const std::vector<std::array<double, 2>>& places,
                   const std::vector<std::array<double, 2>>& expected) {
  ASSERT_EQ(places.size(), expected.size());
  for (std::size_t i = 0; i < places.size(); ++i) {
    EXPECT_NEAR(places[i][0], expected[i][0], 1e-9) << i;
    EXPECT_NEAR(places[i][1], expected[i][1], 1e-9) << i;
  }
}

TEST(Patterns, CircleArcLineAndGrid) {
  TestMachine machine = machine_for_cycles();
  const std::string cycle = "G99 G81 Z-1 R1 L0 F100\n";
  expect_places(holes(machine, cycle + "G70 X5 Y0 I10 J90 K4\n"), {{5, 10}, {-5, 0}, {5, -10}, {15, 0}});
  expect_places(holes(machine, cycle + "G70 X5 Y0 I10 J90 K-4\n"), {{5, 10}, {15, 0}, {5, -10}, {-5, 0}});
  expect_places(holes(machine, cycle + "G71 X0 Y0 I10 J0 P90 K3\n"), {{10, 0}, {0, 10}, {-10, 0}});
  const double d = 2 * std::sqrt(0.5);
  expect_places(holes(machine, cycle + "G78 X1 Y2 I2 J45 K3\n"),
                {{1, 2}, {1 + d, 2 + d}, {1 + 2 * d, 2 + 2 * d}});
  expect_places(holes(machine, cycle + "G79 X0 Y0 I10 P3 J5 K2\n"),
                {{0, 0}, {10, 0}, {20, 0}, {20, 5}, {10, 5}, {0, 5}});
  // In G91 the centre is counted from the position.
  expect_places(holes(machine, "G0 X100\n" + cycle + "G91 G70 X5 Y0 I10 J0 K2\n"), {{115, 0}, {95, 0}});
  expect_places(holes(machine, "G20\nG99 G81 Z-1 R1 L0 F100\nG79 X0 Y0 I1 P2 J1 K1\n"), {{0, 0}, {25.4, 0}});
  expect_places(holes(machine, "G16\n" + cycle + "X10 Y0\nG91 Y90 L3\nY45\n"),
                {{10, 0}, {0, 10}, {-10, 0}, {0, -10}, {10 * std::sqrt(0.5), -10 * std::sqrt(0.5)}});
  expect_places(holes(machine, "G16\n" + cycle + "G81 X10 Y0 Z-1 R1 F100\nY90\nG91 Y90\n"),
                {{10, 0}, {0, 10}, {-10, 0}});
}

TEST(Patterns, HolesAreCommandsOneByOne) {
  TestMachine machine = machine_for_cycles();
  // A million pecks are not made at once.
  StringSource text("G83 X0 Z-1000 R0 Q0.001 F100\nM30\n");
  Interpreter interpreter(machine);
  interpreter.start(text, {}, {});
  Command command;
  for (int i = 0; i < 1000; ++i) ASSERT_EQ(interpreter.next(command), Step::command);
  EXPECT_EQ(command.line, 1u);
  EXPECT_EQ(command.sequence, 1000u);
}

TEST(Cycles, RestartFindsTheSameCommandInTheMiddleOfAHole) {
  TestMachine machine = machine_for_cycles();
  const std::string text = "G73 X1 Z-5 R2 Q1 F100\nG70 X0 Y0 I10 J0 K5\nM30\n";
  const Interpretation whole = run(machine, text);
  const Interpretation part = run(machine, text, {}, {}, {}, 23);
  ASSERT_EQ(part.commands.size(), 23u);
  EXPECT_EQ(part.commands.back().target, whole.commands[22].target);
  EXPECT_EQ(part.commands.back().sequence, 23u);
}

// R at the depth or below it would be reached in rapid, through the part.
TEST(Cycles, AnRLevelThatIsNotInFrontOfTheDepthIsRefused) {
  for (const char* const text :
       {"G90 G0 Z5\nG81 X1 Y1 Z-5 R-10 F100\n", "G90 G0 Z5\nG91 G81 X1 Z5 R-15 F100\n",
        "G90 G0 Z5\nS100 G84 X1 Z-5 R-10 F100\n", "G90 G0 Z5\nS100 M3\nG87 X1 Z-10 R-5 Q1 F100\n",
        "G90 G0 Z5\nG51.1 Z0\nG81 X1 Z-5 R-2 F100\n", "G90 G0 Z5\nG81 X1 Z-5 R-5 F100\n",
        "G90 G0 Z5\nG83 X1 Z-5 R-5 Q1 F100\n", "G90 G0 Z5\nS100 M3\nG87 X1 Z-5 R-5 Q1 F100\n",
        "G19 G0 X0\nG81 X5 R5 F100\n"}) {
    TestMachine machine = machine_for_cycles();
    const Interpretation result = run(machine, text);
    EXPECT_EQ(result.alarm.number, AlarmNumber::cycle_level_side) << text;
    EXPECT_NE(std::string(result.alarm.text.data()).find("R "), std::string::npos)
        << result.alarm.text.data();
  }
  // A mirrored Z axis exchanges both, an angle head may drill upwards.
  for (const char* const text : {"G19 G0 X0\nG81 X5 R2 F100\n", "G90 G0 Z5\nG51.1 Z0\nG81 X1 Z5 R2 F100\n"}) {
    TestMachine machine = machine_for_cycles();
    EXPECT_EQ(run(machine, text).last, Step::end) << text;
  }
}

}  // namespace
}  // namespace trunnion::language::test
