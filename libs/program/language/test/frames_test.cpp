// SPDX-License-Identifier: Apache-2.0
// Frames can be undone, and their properties.
#include <gtest/gtest.h>

#include <map>
#include <random>

#include "language/program_frame.hpp"
#include "test_machine.hpp"

namespace trunnion::language::test {
namespace {

TestMachine offsets() {
  TestMachine machine;
  machine.offsets[1] = {100, 200, 300, 10, 0, 20, 0, 0, 0};  // G55
  machine.more_offsets[48] = {7, 8, 9, 0, 0, 0, 0, 0, 0};
  machine.tools[1] = {50, 0.5, 4, 0.1};
  return machine;
}

AxisValues random_point(std::mt19937_64& random) {
  std::uniform_real_distribution<double> value(-500, 500);
  AxisValues p{};
  for (double& component : p) component = value(random);
  return p;
}

TEST(Frames, EveryFrameCanBeUndone) {
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> value(-100, 100);
  std::uniform_real_distribution<double> size(0.2, 5);
  for (int i = 0; i < 2000; ++i) {
    ProgramFrame frame;
    frame.set_work_offset(random_point(random));
    frame.set_local(X, value(random));
    frame.set_shift(B, value(random));
    if (random() % 2 == 0)
      frame.set_mirror(static_cast<std::uint8_t>(random() % axis_count), true, value(random));
    if (random() % 2 == 0) {
      frame.set_scaling({value(random), value(random), value(random)},
                        {size(random), -size(random), size(random)});
    }
    if (random() % 2 == 0) {
      frame.set_rotation(static_cast<Plane>(random() % 3), {value(random), value(random), value(random)},
                         4 * value(random));
    }
    if (random() % 2 == 0) {
      // A turn about (1, 1, 1) by 120 degrees exchanges the axes.
      frame.set_tilt({true, {value(random), value(random), value(random)}, {0, 0, 1, 1, 0, 0, 0, 1, 0}});
    }
    const AxisValues p = random_point(random);
    const AxisValues back = frame.program_from_contour(
        frame.contour_from_command(frame.command_from_contour(frame.contour_from_program(p))));
    // Numbers up to 5000 times factors up to 5 lose at most some 1e-11.
    for (std::size_t axis = 0; axis < axis_count; ++axis) ASSERT_NEAR(back[axis], p[axis], 1e-9);
  }
}

// Every move goes to X N, N the number of its line, in a frame of its own; the compensation holds moves back
// until the frame has changed again.
TEST(Frames, FrameOfACommandIsThatOfItsBlockAndNotOfThoseReadAhead) {
  TestMachine machine = offsets();
  std::string text;
  for (unsigned line = 1; line <= 400; line += 4) {
    const std::string n = std::to_string(line);
    text += "G52 X" + n + "\nG68 X1 Y2 R" + n + "\nG51.1 X" + n + "\nG0 X" + std::to_string(line + 3) + "\n";
  }
  text += "G69 G50.1\nG52 X0 Y0\nG41 D1 G1 F1 X403\nG68 X1 Y2 R30\nX405\nG68 X1 Y2 R50\nX407\nG40 X408\n";
  StringSource source(text);
  Interpreter interpreter(machine);
  interpreter.start(source, {}, {});
  Command command;
  int held = 0, moves = 0;
  while (interpreter.next(command) == Step::command && command.kind != CommandKind::end) {
    const ProgramFrame& frame = interpreter.frame_of(command);
    if (command.line <= 400) {
      EXPECT_NEAR(frame.program_from_command(command.target)[X], command.line, 1e-9);
      ++moves;
    } else {
      const std::map<std::uint32_t, double> degrees{{403, 0}, {405, 30}, {407, 50}, {408, 50}};
      ASSERT_TRUE(degrees.contains(command.line));
      EXPECT_EQ(frame.rotation(), degrees.at(command.line)) << command.line;
      held += frame.revision() != interpreter.executor().frame().revision() ? 1 : 0;
    }
  }
  EXPECT_EQ(command.kind, CommandKind::end);
  EXPECT_EQ(moves, 100);
  EXPECT_GT(held, 0);
}

TEST(Frames, PositionsForMacrosAreThoseOfTheFrames) {
  TestMachine machine = offsets();
  StringSource text("G55 G52 X1\nG43 H1\nG68 X0 Y0 R90\nG0 X10 Y0 Z5\n");
  Interpreter interpreter(machine);
  interpreter.start(text, {}, {});
  Command command;
  while (interpreter.next(command) == Step::command && command.kind != CommandKind::end) {
  }
  const BlockExecutor& executor = interpreter.executor();
  EXPECT_NEAR(executor.program_position()[X], 10, 1e-12);
  // Turned to (0, 10), with G52 on top of G55: machine (100 + 1, 200 + 10, 300 + 5 + 50.5).
  EXPECT_NEAR(executor.workpiece_position()[X], 0, 1e-12);
  EXPECT_NEAR(executor.workpiece_position()[Y], 10, 1e-12);
  EXPECT_NEAR(executor.machine_position()[X], 101, 1e-12);
  EXPECT_NEAR(executor.machine_position()[Y], 210, 1e-12);
  EXPECT_NEAR(executor.machine_position()[Z], 355.5, 1e-12);
  // And back, as after a skip move.
  interpreter.set_position({101, 220, 355.5, 0, 0, 0, 0, 0, 0});
  EXPECT_NEAR(executor.program_position()[X], 20, 1e-12);
  EXPECT_NEAR(executor.program_position()[Z], 5, 1e-12);
}

// A random pocket of lines and arcs in whole hundredths, as program text.
std::string random_pocket(std::mt19937_64& random) {
  std::string text = "G90 G1 F500\n";
  for (int i = 0; i < 40; ++i) {
    char line[120];
    const double x = static_cast<double>(random() % 20001) / 100 - 100;
    const double y = static_cast<double>(random() % 20001) / 100 - 100;
    const double radius = 200 + static_cast<double>(random() % 1000) / 100;
    if (random() % 3 == 0) {
      std::snprintf(line, sizeof line, "G%d X%.2f Y%.2f R%.2f\n", random() % 2 == 0 ? 2 : 3, x, y, radius);
    } else {
      std::snprintf(line, sizeof line, "G1 X%.2f Y%.2f Z%.2f\n", x, y, -radius / 10);
    }
    text += line;
  }
  return text;
}

void expect_same_path(const Interpretation& a, const Interpretation& b, double tolerance,
                      AxisValues (*map)(AxisValues) = nullptr, bool turned_round = false) {
  ASSERT_EQ(a.last, Step::end) << a.alarm.text.data();
  ASSERT_EQ(b.last, Step::end) << b.alarm.text.data();
  ASSERT_EQ(a.commands.size(), b.commands.size());
  for (std::size_t i = 0; i < a.commands.size(); ++i) {
    const Command& expected = a.commands[i];
    const Command& command = b.commands[i];
    ASSERT_EQ(expected.kind, command.kind) << i;
    const AxisValues target = map != nullptr ? map(expected.target) : expected.target;
    for (std::size_t axis = 0; axis < axis_count; ++axis)
      ASSERT_NEAR(command.target[axis], target[axis], tolerance) << i;
    if (command.kind != CommandKind::arc) continue;
    const Vector3& c = expected.arc.centre;
    const AxisValues centre = map != nullptr ? map({c[0], c[1], c[2]}) : AxisValues{c[0], c[1], c[2]};
    for (std::size_t axis = 0; axis < 3; ++axis)
      ASSERT_NEAR(command.arc.centre[axis], centre[axis], tolerance);
    ASSERT_EQ(command.arc.clockwise, expected.arc.clockwise != turned_round);
    ASSERT_NEAR(command.arc.sweep, expected.arc.sweep, 1e-6);
  }
}

TEST(FrameProperty, RotationByAFullTurnIsTheIdentity) {
  std::mt19937_64 random(21);
  for (int i = 0; i < 100; ++i) {
    const std::string pocket = random_pocket(random);
    TestMachine machine;
    expect_same_path(run(machine, pocket), run(machine, "G68 X3.5 Y-20 R360\n" + pocket), 1e-9);
    // Twelve times 30 degrees, angle by angle.
    std::string steps = "G68 X0 Y0 R30\nG91\n";
    for (int k = 0; k < 11; ++k) steps += "G68 X0 Y0 R30\n";
    expect_same_path(run(machine, pocket), run(machine, steps + pocket), 1e-9);
  }
}

TEST(FrameProperty, MirroredPocketHasTheMirroredPath) {
  std::mt19937_64 random(22);
  const auto mirror = [](AxisValues p) {
    p[X] = 2 * 12.5 - p[X];
    return p;
  };
  for (int i = 0; i < 100; ++i) {
    const std::string pocket = random_pocket(random);
    TestMachine machine;
    // From X25 the mirrored one begins at X0, as the plain one would at X25.
    const Interpretation plain = run(machine, pocket, {25});
    expect_same_path(plain, run(machine, "G51.1 X12.5\n" + pocket), 1e-9, mirror, true);
    expect_same_path(plain, run(machine, "G51 X12.5 Y0 Z0 I-1\n" + pocket), 1e-9, mirror, true);
  }
}

TEST(FrameProperty, OffsetsOnlyTranslate) {
  std::mt19937_64 random(23);
  const auto shift = [](AxisValues p) {
    p[X] += 100 + 1;
    p[Y] += 200;
    p[Z] += 300 - 4;
    return p;
  };
  for (int i = 0; i < 100; ++i) {
    const std::string pocket = random_pocket(random);
    TestMachine machine = offsets();
    machine.offsets[1] = {100, 200, 300};
    expect_same_path(run(machine, pocket), run(machine, "G55 G52 X1 Z-4\n" + pocket, {101, 200, 296}), 1e-9,
                     shift);
  }
}

TEST(FrameProperty, PolarWordsEqualCartesianOnes) {
  std::mt19937_64 random(24);
  for (int i = 0; i < 200; ++i) {
    std::string polar = "G16 G90 G1 F100\n";
    std::string cartesian = "G90 G1 F100\n";
    for (int k = 0; k < 20; ++k) {
      const double radius = static_cast<double>(random() % 10000 + 1) / 100;
      const double angle = static_cast<double>(random() % 72000) / 100 - 360;
      char line[120];
      std::snprintf(line, sizeof line, "X%.2f Y%.2f\n", radius, angle);
      polar += line;
      const double a = angle * std::numbers::pi / 180;
      std::snprintf(line, sizeof line, "X%.12f Y%.12f\n", radius * std::cos(a), radius * std::sin(a));
      cartesian += line;
    }
    TestMachine machine;
    expect_same_path(run(machine, cartesian), run(machine, polar), 1e-9);
  }
}

// The mirror image of a part that is turned by 90 degrees: (10,0) turns to (0,10), which the mirror of X
// keeps. The order in which both are switched on does not matter.
TEST(Frames, AMirrorTurnsTheSenseOfARotationRound) {
  for (const char* const text :
       {"G51.1 X0\nG68 X0 Y0 R90\nG0 X10 Y0\n", "G68 X0 Y0 R90\nG51.1 X0\nG0 X10 Y0\n",
        "G51 X0 Y0 I-1 J1\nG68 X0 Y0 R90\nG0 X10 Y0\n"}) {
    TestMachine machine;
    const Interpretation result = run(machine, text);
    ASSERT_EQ(result.last, Step::end) << result.alarm.text.data();
    ASSERT_FALSE(result.commands.empty());
    EXPECT_NEAR(result.commands.back().target[X], 0, 1e-12) << text;
    EXPECT_NEAR(result.commands.back().target[Y], 10, 1e-12) << text;
  }
}

// A random part behind a mirror is the mirror image of the part, its rotations included.
TEST(Frames, AMirroredPartWithRotationsIsItsMirrorImage) {
  std::mt19937_64 random(41);
  for (int i = 0; i < 100; ++i) {
    std::string part;
    for (int k = 0; k < 6; ++k) {
      char line[120];
      std::snprintf(line, sizeof line, "G68 X%d Y%d R%d\nG1 X%d Y%d F100\nG69\n",
                    static_cast<int>(random() % 40), static_cast<int>(random() % 40),
                    static_cast<int>(random() % 360), static_cast<int>(random() % 90),
                    static_cast<int>(random() % 90));
      part += line;
    }
    TestMachine machine;
    const Interpretation plain = run(machine, part), mirrored = run(machine, "G51.1 X7\n" + part);
    ASSERT_EQ(plain.commands.size(), mirrored.commands.size()) << part;
    for (std::size_t k = 0; k < plain.commands.size(); ++k) {
      EXPECT_NEAR(mirrored.commands[k].target[X], 14 - plain.commands[k].target[X], 1e-9) << part;
      EXPECT_NEAR(mirrored.commands[k].target[Y], plain.commands[k].target[Y], 1e-9) << part;
    }
  }
}

TEST(Frames, TheFactorsOfAScalingHaveTheUnitOfTheParameter) {
  TestMachine machine;
  machine.factor_unit = 0.001;
  const Interpretation result = run(machine, "G51 X0 Y0 P2000\nG0 X10\n");
  ASSERT_EQ(result.last, Step::end) << result.alarm.text.data();
  EXPECT_NEAR(result.commands.back().target[X], 20, 1e-12);
  machine.factor_unit = 1;
  EXPECT_EQ(run(machine, "G51 X0 Y0 P2000\nG0 X10\n").alarm.number, AlarmNumber::factor_range);
}

TEST(Frames, G921EndsG52AndG92OfTheAxesThatItNames) {
  TestMachine machine;
  // G92 X0 at machine X10 shifts X by 10, G52 adds 1 and 2.
  EXPECT_THAT(stream(run(machine, "G0 X10\nG92 X0\nG52 X1 Y2\nG92.1 X0\nG0 X3 Y0\nG92.1\nY0\n")),
              testing::ElementsAre("rapid X10", "rapid X3 Y2", "rapid X3", "end 0"));
}

}  // namespace
}  // namespace trunnion::language::test
