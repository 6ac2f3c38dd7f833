// Canned cycles and hole patterns.
#include <gtest/gtest.h>

#include "golden.hpp"

namespace trunnion::language::test {
namespace {

TestMachine machine_for_cycles() {
  TestMachine machine;
  machine.cycles = {.retract = 0.5, .clearance = 1, .shift_axis = 1};
  return machine;
}

TEST(Cycles, Drilling) {
  TestMachine machine = machine_for_cycles();
  const Golden goldens[] = {
      {"drilling, back to the level before",
       "G0 Z10\nG81 X1 Y2 Z-5 R2 F100\nX3\nG80\nX4\n",
       {"rapid Z10", "rapid X1 Y2 Z10", "rapid X1 Y2 Z2", "line X1 Y2 Z-5 F100", "rapid X1 Y2 Z10",
        "rapid X3 Y2 Z10", "rapid X3 Y2 Z2", "line X3 Y2 Z-5 F100", "rapid X3 Y2 Z10", "rapid X4 Y2 Z10",
        "end 0"}},
      {"G99 stays at R",
       "G0 Z10\nG99 G81 X1 Z-5 R2 F100\nX3\nG98 X4\n",
       {"rapid Z10", "rapid X1 Z10", "rapid X1 Z2", "line X1 Z-5 F100", "rapid X1 Z2", "rapid X3 Z2",
        "line X3 Z-5 F100", "rapid X3 Z2", "rapid X4 Z2", "line X4 Z-5 F100", "rapid X4 Z10", "end 0"}},
      {"dwell at the bottom",
       "G82 X0 Z-5 R2 P500 F100\n",
       {"rapid Z2", "line Z-5 F100", "dwell 0.5", "rapid", "end 0"}},
      // Depths 2 - 3 = -1, -4, then the rest to -5; back by 0.5 between.
      {"chip breaking",
       "G99 G73 X0 Z-5 R2 Q3 F100\n",
       {"rapid Z2", "line Z-1 F100", "rapid Z-0.5", "line Z-4 F100", "rapid Z-3.5", "line Z-5 F100",
        "rapid Z2", "end 0"}},
      // Out to R after every peck, down again to 1 above the last depth.
      {"deep drilling",
       "G99 G83 X0 Z-5 R2 Q3 F100\n",
       {"rapid Z2", "line Z-1 F100", "rapid Z2", "rapid", "line Z-4 F100", "rapid Z2", "rapid Z-3",
        "line Z-5 F100", "rapid Z2", "end 0"}},
      {"a peck that fits makes no rest",
       "G99 G83 X0 Z-4 R2 Q3 F100\n",
       {"rapid Z2", "line Z-1 F100", "rapid Z2", "rapid", "line Z-4 F100", "rapid Z2", "end 0"}},
      // 0.3 - 3 * 0.1 is 5.6e-17 above 0 in binary numbers: no fourth peck.
      {"rounding makes no peck",
       "G99 G73 X0 Z0 R0.3 Q0.1 F100\n",
       {"rapid Z0.3", "line Z0.2 F100", "rapid Z0.3", "line Z0.1 F100", "rapid Z0.3", "line F100",
        "rapid Z0.3", "end 0"}},
      {"a peck deeper than the hole",
       "G99 G83 X0 Z-4 R2 Q30 F100\n",
       {"rapid Z2", "line Z-4 F100", "rapid Z2", "end 0"}},
      {"incremental words: R from the level, Z from R, holes on a line by L",
       "G0 Z10\nG91 G99 G81 X5 Y1 Z-8 R-7 L3 F100\n",
       // R at 10 - 7 = 3, Z at 3 - 8 = -5.
       {"rapid Z10", "rapid X5 Y1 Z10", "rapid X5 Y1 Z3", "line X5 Y1 Z-5 F100", "rapid X5 Y1 Z3",
        "rapid X10 Y2 Z3", "line X10 Y2 Z-5 F100", "rapid X10 Y2 Z3", "rapid X15 Y3 Z3",
        "line X15 Y3 Z-5 F100", "rapid X15 Y3 Z3", "end 0"}},
      {"repetitions by K at one place in G90",
       "G99 G81 X1 Z-1 R1 K2 F100\n",
       {"rapid X1", "rapid X1 Z1", "line X1 Z-1 F100", "rapid X1 Z1", "line X1 Z-1 F100", "rapid X1 Z1",
        "end 0"}},
      {"K0 keeps the words and drills nothing",
       "G81 X9 Z-1 R1 K0 F100\nX1\n",
       {"rapid X1", "rapid X1 Z1", "line X1 Z-1 F100", "rapid X1", "end 0"}},
      {"blocks without a place drill nothing",
       "G81 X1 Z-1 R1 F100\nF200\nM8\n",
       {"rapid X1", "rapid X1 Z1", "line X1 Z-1 F100", "rapid X1", "M8", "end 0"}},
      {"a motion code ends the cycle",
       "G81 X1 Z-1 R1 F100\nG1 X2\n",
       {"rapid X1", "rapid X1 Z1", "line X1 Z-1 F100", "rapid X1", "line X2 F100", "end 0"}},
      {"M codes act after the whole hole",
       "G99 G81 X1 Z-1 R1 F100 M9 M30\n",
       {"rapid X1", "rapid X1 Z1", "line X1 Z-1 F100", "rapid X1 Z1", "M9", "end 30"}},
      {"a table turns with the first positioning",
       "G99 G81 X1 B90 Z-1 R1 F100\n",
       {"rapid X1 B90", "rapid X1 Z1 B90", "line X1 Z-1 B90 F100", "rapid X1 Z1 B90", "end 0"}},
      {"drilling along Y in ZX",
       "G18 G0 Y10\nG99 G81 Z1 X2 Y-5 R2 F100\n",
       {"rapid Y10", "rapid X2 Y10 Z1", "rapid X2 Y2 Z1", "line X2 Y-5 Z1 F100", "rapid X2 Y2 Z1", "end 0"}},
      {"drilling along X in YZ, upwards",
       "G19 G99 G83 Y1 X7 R2 Q3 F100\n",
       {"rapid Y1", "rapid X2 Y1", "line X5 Y1 F100", "rapid X2 Y1", "rapid X4 Y1", "line X7 Y1 F100",
        "rapid X2 Y1", "end 0"}},
      {"cycles go through the frames",
       "G68 X0 Y0 R90\nG51.1 X0\nG52 Z100\nG99 G81 X10 Y0 Z-1 R1 F100\n",
       // Mirrored to X-10, turned to Y-10.
       {"rapid Y-10", "rapid Y-10 Z101", "line Y-10 Z99 F100", "rapid Y-10 Z101", "end 0"}},
      {"inches",
       "G20 G99 G83 X0 Z-0.2 R0 Q0.1 F10\n",
       // R 0, pecks of 2.54 mm to -5.08, clearance 1 mm.
       {"line Z-2.54 F254", "rapid", "rapid Z-1.54", "line Z-5.08 F254", "rapid", "end 0"}},
  };
  expect_streams(machine, goldens);
}

TEST(Cycles, TheSpindleOfATappingCycleIsNoAxisOfTheChannel) {
  TestMachine machine = machine_for_cycles();
  machine.axis_mask = 0b111;
  EXPECT_EQ(run(machine, "S100 G95 F1 G84 Z-5 R0 J3\n").last, Step::end);
  machine.axis_mask |= 1u << C;
  EXPECT_EQ(run(machine, "S100 G95 F1 G84 Z-5 R0 J3\n").alarm.number, AlarmNumber::value_range);
}

TEST(Cycles, TappingAndBoring) {
  TestMachine machine = machine_for_cycles();
  machine.axis_mask = static_cast<std::uint16_t>(machine.axis_mask & ~(1u << W));
  const Golden goldens[] = {
      // 500 mm/min at 400 1/min: 1.25 mm a turn.
      {"rigid tapping: the spindle stands before it is coupled, and turns again when the cycle ends",
       "S400 M3 F500 G99 G84 X1 Z-5 R2 P100\nX2\nG80\n",
       {"S400", "M3", "rapid X1", "M5", "rapid X1 Z2", "tap X1 Z-5 lead1.25", "dwell 0.1",
        "tap X1 Z2 lead1.25", "dwell 0.1", "rapid X2 Z2", "tap X2 Z-5 lead1.25", "dwell 0.1",
        "tap X2 Z2 lead1.25", "dwell 0.1", "M3", "end 0"}},
      {"M5 with the cycle keeps the spindle off",
       "S400 M4\nF500 G99 G84 X0 Z-5 R0 M5\nG0 Z1\n",
       {"S400", "M4", "M5", "tap Z-5 lead1.25", "tap lead1.25", "M5", "rapid Z1", "end 0"}},
      {"M4 behind the cycle takes the place of the spindle's return",
       "S400 M3 F500 G99 G84 X0 Z-5 R0\nM4 G80\n",
       {"S400", "M3", "M5", "tap Z-5 lead1.25", "tap lead1.25", "M4", "end 0"}},
      {"left-hand thread with the lead as feed",
       "G95 S400 F1.5 G74 X0 Z-5 R2\n",
       {"S400", "rapid Z2", "tap Z-5 lead-1.5", "tap Z2 lead-1.5", "rapid", "end 0"}},
      {"tapping in pecks, with the spindle as W axis",
       "S100 G95 F1 G99 G84 X0 Z-5 R0 Q3 J6\n",
       {"S100", "tap Z-3 lead1 axis6", "tap Z-2.5 lead1 axis6", "tap Z-5 lead1 axis6", "tap lead1 axis6",
        "end 0"}},
      {"boring, out at feed",
       "G99 G85 X0 Z-5 R2 F100\n",
       {"rapid Z2", "line Z-5 F100", "line Z2 F100", "end 0"}},
      {"boring, out at feed with dwell",
       "G89 X0 Z-5 R2 P250 F100\n",
       {"rapid Z2", "line Z-5 F100", "dwell 0.25", "line Z2 F100", "rapid", "end 0"}},
      {"boring, spindle stop",
       "M4 G86 X0 Z-5 R2 F100\n",
       {"M4", "rapid Z2", "line Z-5 F100", "M5", "rapid", "M4", "end 0"}},
      {"boring, out by hand",
       "G88 X0 Z-5 R2 P100 F100\n",
       {"rapid Z2", "line Z-5 F100", "dwell 0.1", "M5", "M0", "rapid", "M3", "end 0"}},
      {"fine boring",
       "G99 G76 X1 Y1 Z-5 R2 Q0.5 F100\n",
       {"rapid X1 Y1", "rapid X1 Y1 Z2", "line X1 Y1 Z-5 F100", "M19", "rapid X1.5 Y1 Z-5",
        "rapid X1.5 Y1 Z2", "rapid X1 Y1 Z2", "M3", "end 0"}},
      {"shift by I and J",
       "G99 G76 X0 Z-5 R2 I0.3 J-0.4 F100\n",
       {"rapid Z2", "line Z-5 F100", "M19", "rapid X0.3 Y-0.4 Z-5", "rapid X0.3 Y-0.4 Z2", "rapid Z2", "M3",
        "end 0"}},
      {"back boring",
       "G0 Z10\nM3 G87 X0 Z-5 R-20 Q0.5 F100\n",
       {"rapid Z10", "M3", "M19", "rapid X0.5 Z10", "rapid X0.5 Z-20", "rapid Z-20", "M3", "line Z-5 F100",
        "M19", "rapid X0.5 Z-5", "rapid X0.5 Z10", "rapid Z10", "M3", "end 0"}},
  };
  expect_streams(machine, goldens);
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

TEST(Cycles, WordsOfOtherCodesAreNotTheirs) {
  TestMachine machine = machine_for_cycles();
  machine.programs["O0200"] = std::make_unique<StringSource>("X1\nM99\n");
  const Golden goldens[] = {
      {"P and Q of modal codes in a block that drills",
       "G99 G82 Z-1 R0 P100 L0 F100\nG64 P0.5 X1\nG5.1 Q1 X2\n",
       {"rapid X1", "line X1 Z-1 F100", "dwell 0.1", "rapid X1", "rapid X2", "line X2 Z-1 F100", "dwell 0.1",
        "rapid X2", "end 0"}},
      {"P and L of a call while a cycle is on",
       "G99 G81 Z-1 R0 L0 F100\nM98 P200 L2\n",
       {"rapid X1", "line X1 Z-1 F100", "rapid X1", "line X1 Z-1 F100", "rapid X1", "end 0"}},
  };
  expect_streams(machine, goldens);
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

}  // namespace
}  // namespace trunnion::language::test
