// Frames: offsets, mirror, scaling, rotation, polar words, diameters, and the order they act in.
#include <gtest/gtest.h>

#include <random>

#include "golden.hpp"
#include "language/program_frame.hpp"

namespace trunnion::language::test {
namespace {

TestMachine offsets() {
  TestMachine machine;
  machine.offsets[1] = {100, 200, 300, 10, 0, 20, 0, 0, 0};  // G55
  machine.more_offsets[48] = {7, 8, 9, 0, 0, 0, 0, 0, 0};
  machine.tools[1] = {50, 0.5, 4, 0.1};
  return machine;
}

TEST(Frames, Offsets) {
  TestMachine machine = offsets();
  const Golden goldens[] = {
      {"additional offset", "G54.1 P48 G0 X1 Z1\n", {"rapid X8 Z10", "end 0"}},
      {"local offset adds to every work offset",
       "G52 X10 Y20\nG0 X1 Y1\nG55 X1\nG52 X0 Y0\nX1\n",
       // G54: 10 + 1, 20 + 1. G55: 100 + 10 + 1; Y stays at the machine's 21.
       {"rapid X11 Y21", "rapid X111 Y21", "rapid X101 Y21", "end 0"}},
      {"an incremental local offset moves on", "G52 X10\nG91 G52 X5\nG90 G0 X0\n", {"rapid X15", "end 0"}},
      {"G92 gives the position its name, in every work offset",
       // At machine X10: X0 is 10 from then on; in G55 it is 100 + 10.
       "G0 X10\nG92 X0\nG0 X1\nG55 X1\nG92.1\nX1\n",
       {"rapid X10", "rapid X11", "rapid X111", "rapid X101", "end 0"}},
      {"G92 counts the tool length", "G43 H1\nG92 Z5\nG0 Z6\n", {"frame none L50.5", "rapid Z1", "end 0"}},
      {"table offset changes at once and is passed on",
       "G10 L2 P1 X5 Y6\nG0 X1\nG91 G10 L2 P1 X2\nG90 X1\nG10 L20 P2 Z4\nG54.1 P2 Z0\n",
       {"table1 0 X5 Y6", "rapid X6", "table1 0 X7 Y6", "rapid X8", "table1 7 Z4", "rapid X8 Z4", "end 0"}},
      {"offset of another number moves nothing",
       "G10 L2 P3 X5\nG0 X1\n",
       {"table1 2 X5", "rapid X1", "end 0"}},
      {"tool length and wear by the program",
       // 50 + 0.5, then 40 + 0.5, then 40 + 0.5 + 0.25
       "G43 H1 G0 Z0\nG10 L10 P1 R40\nG43 H1 Z0\nG91 G10 L11 P1 R0.25\nG90 G43 H1 Z0\n",
       {"frame none L50.5", "rapid Z50.5", "table2 1 40", "frame none L40.5 Z50.5", "rapid Z40.5",
        "table3 1 0.75", "frame none L40.75 Z40.5", "rapid Z40.75", "end 0"}},
      {"radius and its wear", "G20 G10 L12 P1 R1\nG10 L13 P1 R0\n", {"table4 1 25.4", "table5 1 0", "end 0"}},
      {"length and radius in one block, T selects nothing",
       "G10 P9 Z128 R6 T01\nG43 H9 G0 Z0\n",
       {"table2 9 128", "table4 9 6", "frame none L128", "rapid Z128", "end 0"}},
      {"parameters",
       "G10 L50\nN10010 R3\nN100 P1 R2.5\nG11\nG10 L50 P40030 R500\n",
       {"table6 10010 3", "table6 1100 2.5", "table6 40030 500", "end 0"}},
      {"G44 subtracts", "G44 H1 G0 Z100\n", {"frame none L-50.5", "rapid Z49.5", "end 0"}},
      {"H alone exchanges the length, H0 takes it away",
       "H0 G0 Z1\nG43 H1\nZ1\nH0 Z1\n",
       {"rapid Z1", "frame none L50.5 Z1", "rapid Z51.5", "frame none L0 Z51.5", "rapid Z1", "end 0"}},
  };
  expect_streams(machine, goldens);
}

TEST(Frames, Shapes) {
  TestMachine machine = offsets();
  const Golden goldens[] = {
      {"scaling about a point", "G51 X10 Y0 Z0 P2\nG0 X11 Y1\n", {"rapid X12 Y2", "end 0"}},
      {"scaling per axis, off again goes on from the position",
       "G51 X0 Y0 Z0 I2 J3\nG0 X1 Y1 Z1\nG50\nG91 X1\n",
       {"rapid X2 Y3 Z1", "rapid X3 Y3 Z1", "end 0"}},
      {"scaling without a point is about the position",
       "G0 X10\nG51 P2\nG0 X11\n",
       {"rapid X10", "rapid X12", "end 0"}},
      {"incremental words are scaled too", "G51 X5 Y5 Z5 P0.5\nG91 G0 X4\n", {"rapid X2", "end 0"}},
      {"a negative factor mirrors, and a circle turns round",
       "G51 X0 Y0 Z0 I-1\nG0 X10\nG3 X0 Y10 I-10 F100\n",
       {"rapid X-10", "arc Y10 cw 0 0 0 90deg F100", "end 0"}},
      {"equal factors scale circles",
       "G51 X0 Y0 Z0 P2\nG0 X10\nG3 X0 Y10 R10 F100\n",
       {"rapid X20", "arc Y20 ccw 0 0 0 90deg F100", "end 0"}},
      {"mirror about a coordinate, per axis and off",
       "G51.1 X10\nG0 X11 Y1\nG24 Y0\nX11 Y1\nG50.1 X0\nX11 Y1\nG25\nX11 Y1\n",
       {"rapid X9 Y1", "rapid X9 Y-1", "rapid X11 Y-1", "rapid X11 Y1", "end 0"}},
      {"two mirrors leave the sense of a circle",
       "G51.1 X0 Y0\nG0 X10\nG3 X0 Y10 I-10 F100\n",
       {"rapid X-10", "arc Y-10 ccw 0 0 0 90deg F100", "end 0"}},
      {"a mirrored rotary axis", "G51.1 A0\nG0 A30\n", {"rapid A-30", "end 0"}},
      // (10, 0) turned by 90 degrees about (5, 0) is (5, 5).
      {"rotation about a point", "G68 X5 Y0 R90\nG0 X10 Y0\n", {"rapid X5 Y5", "end 0"}},
      {"rotation turns the centre of a circle",
       "G68 X0 Y0 P90\nG0 X10\nG3 X0 Y10 I-10 F100\n",
       {"rapid Y10", "arc X-10 ccw 0 0 0 90deg F100", "end 0"}},
      {"rotation in ZX", "G18 G68 X0 Z0 R90\nG0 Z10\n", {"rapid X10", "end 0"}},
      {"incremental angles add", "G68 X0 Y0 R30\nG91 G68 X0 Y0 R60\nG90 G0 X10\n", {"rapid Y10", "end 0"}},
      {"G69 goes on from the position",
       "G68 X0 Y0 R90\nG0 X10\nG69\nG0 X1\n",
       {"rapid Y10", "rapid X1 Y10", "end 0"}},
      // mirror: X 1 -> -1; scaling by 2: -2, Y 0; rotation by 90 about 0: (0, -2); G52 X100: (100, -2).
      {"mirror, then scaling, then rotation, then offsets, whatever the order they were called in",
       "G68 X0 Y0 R90\nG51 X0 Y0 Z0 P2\nG51.1 X0\nG52 X100\nG0 X1 Y0\n",
       {"rapid X100 Y-2", "end 0"}},
      // The centre (10, 0) is scaled to (20, 0) and the point (11, 0) to (22, 0): 2 beside it, so 2 above it.
      {"the centre of rotation is scaled with the drawing",
       "G51 X0 Y0 Z0 P2\nG68 X10 Y0 R90\nG0 X11 Y0\n",
       {"rapid X20 Y2", "end 0"}},
      {"a frame moves nothing by itself",
       "G0 X3 Y4\nG68 X0 Y0 R90\nG51 P2\nG51.1 X7\nG0 A1\n",
       {"rapid X3 Y4", "rapid X3 Y4 A1", "end 0"}},
      {"polar words",
       "G16 G0 X10 Y90\nY180\nX20\nG91 Y90\nG90 G15 X1\n",
       // radius 10 at 90, 180 degrees; radius 20 at 180; 90 degrees on: 270.
       {"rapid Y10", "rapid X-10", "rapid X-20", "rapid Y-20", "rapid X1 Y-20", "end 0"}},
      {"an incremental polar radius is about the position",
       "G0 X5\nG16 G91 X10 Y90\n",
       {"rapid X5", "rapid X5 Y10", "end 0"}},
  };
  expect_streams(machine, goldens);
}

TEST(Frames, DiameterProgrammingHalvesXWords) {
  TestMachine machine;
  machine.diameter = true;
  const Golden goldens[] = {
      {"absolute and incremental, but not I and R",
       "G18 G0 X20 Z0\nG91 X10\nG90 G2 X10 Z0 I-5 F100\n",
       {"rapid X10", "rapid X15", "arc X5 cw 10 0 0 180deg F100", "end 0"}},
      {"offsets of the program are diameters, those of the table are not",
       "G52 X20\nG0 X0\nG10 L2 P1 X20\nX0\n",
       {"rapid X10", "table1 0 X20", "rapid X30", "end 0"}},
  };
  expect_streams(machine, goldens);
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

}  // namespace
}  // namespace trunnion::language::test
