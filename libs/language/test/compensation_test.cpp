// Cutter radius compensation: golden streams of its corners, and the tool at its radius from the contour.
#include <gtest/gtest.h>

#include <random>

#include "golden.hpp"
#include "language/planar_piece.hpp"

namespace trunnion::language::test {
namespace {

TestMachine machine_with_cutters() {
  TestMachine machine;
  machine.tools[1] = {0, 0, 5, 0};
  machine.tools[2] = {0, 0, 5, -1};
  machine.tools[3] = {0, 0, 2, 0};
  return machine;
}

TEST(Compensation, Corners) {
  TestMachine machine = machine_with_cutters();
  const Golden goldens[] = {
      // Walking up from (0,0) with the tool left: x = -5. Right turn at (0,20): a quarter about it,
      // clockwise.
      // The walk to the right runs at y = 25 and ends square beside (20,20); the way out is straight.
      {"outside corner of lines, lead in and lead out",
       "G0 X0 Y-20\nG41 D1 G1 Y0 F100\nY20\nX20\nG40 X40 Y40\n",
       {"rapid Y-20", "line X-5 F100", "line X-5 Y20 F100", "arc Y25 cw 0 20 0 90deg F100",
        "line X20 Y25 F100", "line X40 Y40 F100", "end 0"}},
      // Walking right with the tool left: y = 5; left turn at (30,0): the offsets meet at (25,5).
      {"inside corner of lines",
       "G41 D1 G1 X10 F100\nX30\nY20\nG40 X0\n",
       {"line X10 Y5 F100", "line X25 Y5 F100", "line X25 Y20 F100", "line Y20 F100", "end 0"}},
      {"on the right everything is mirrored",
       "G42 D1 G1 X10 F100\nX30\nY-20\nG40 X0\n",
       {"line X10 Y-5 F100", "line X25 Y-5 F100", "line X25 Y-20 F100", "line Y-20 F100", "end 0"}},
      {"a negative radius is the other side",
       "G10 L12 P1 R-5\nG41 D1 G1 X10 F100\nX30\nG40 X50\n",
       {"table4 1 -5", "line X10 Y-5 F100", "line X30 Y-5 F100", "line X50 F100", "end 0"}},
      {"wear is added: 5 - 1",
       "G41 D2 G1 X10 F100\nX30\nG40 X50\n",
       {"line X10 Y4 F100", "line X30 Y4 F100", "line X50 F100", "end 0"}},
      {"D0 is the contour itself",
       "G41 D0 G1 X10 F100\nX30\nY10\nG40 X50\n",
       {"line X10 F100", "line X30 F100", "line X30 Y10 F100", "line X50 Y10 F100", "end 0"}},
      {"blocks that do not move in the plane act at the end of the move before",
       "G41 D1 G1 X10 F100\nZ-5\nX30\nM8\nG4 P100\nZ-6\nY20\nG40 X0\n",
       {"line X10 Y5 F100", "line X10 Y5 Z-5 F100", "line X25 Y5 Z-5 F100", "M8", "dwell 0.1",
        "line X25 Y5 Z-6 F100", "line X25 Y20 Z-6 F100", "line Y20 Z-6 F100", "end 0"}},
      // From inside, anticlockwise on a circle of radius 20 about (30,0): the tool is on 15. F holds at the
      // contour: 100 * 15 / 20.
      {"tangent line to arc, inside: smaller radius, smaller feed",
       "G41 D1 G1 X10 Y-20 F100\nX30\nG3 X50 Y0 J20\nG1 Y10\nG40 X0\n",
       {"line X10 Y-15 F100", "line X30 Y-15 F100", "arc X45 ccw 30 0 0 90deg F75", "line X45 Y10 F100",
        "line Y10 F100", "end 0"}},
      {"outside of an arc: larger radius, larger feed",
       "G42 D1 G1 X10 Y-20 F100\nX30\nG3 X50 Y0 J20\nG1 Y10\nG40 X0\n",
       {"line X10 Y-25 F100", "line X30 Y-25 F100", "arc X55 ccw 30 0 0 90deg F125", "line X55 Y10 F100",
        "line Y10 F100", "end 0"}},
      // A half circle of radius 10 about (30,0) below the line's end, tool outside: from (20,0) straight up
      // into the line would be tangent; here the line comes along X and turns right into it by 90 degrees.
      {"outside corner from line to arc and from arc to line",
       "G41 D1 G1 X10 F100\nX20\nG3 X40 I10\nG1 X60\nG40 X80\n",
       // Left of the line y = 5. At (20,0) the walk turns down: right turn, outside, arc from (20,5) to
       // (25,0)
       // about (20,0). Inside the half circle the radius is 5. At (40,0) it goes up and turns right again.
       {"line X10 Y5 F100", "line X20 Y5 F100", "arc X25 cw 20 0 0 90deg F100",
        "arc X35 ccw 30 0 0 180deg F50", "arc X40 Y5 cw 40 0 0 90deg F100", "line X60 Y5 F100",
        "line X80 F100", "end 0"}},
      // Tool right, above is the material's other side: the line y = -5 meets the circle of 15 about (30,0)
      // at x = 30 - sqrt(15^2 - 5^2) = 30 - 14.142 = 15.858, and again behind at 44.142. The arc then has
      // 180 - 2 * asin(5/15) = 180 - 38.942 = 141.058 degrees; feed 100 * 15 / 10.
      {"inside corner from line to arc and from arc to line",
       "G42 D1 G1 X-10 F100\nX20\nG3 X40 I10\nG1 X60\nG40 X80\n",
       {"line X-10 Y-5 F100", "line X15.85786438 Y-5 F100",
        "arc X44.14213562 Y-5 ccw 30 0 0 141.0575587deg F150", "line X60 Y-5 F100", "line X80 F100",
        "end 0"}},
      {"change of side: straight across",
       "G41 D1 G1 X10 F100\nX30\nG42 X50\nG40 X60\n",
       {"line X10 Y5 F100", "line X30 Y5 F100", "line X30 Y-5 F100", "line X50 Y-5 F100", "line X60 F100",
        "end 0"}},
      {"change of radius at an outside corner: straight, at an inside corner: where the offsets meet",
       "G41 D1 G1 X10 F100\nX30\nD3 Y-20\nG40 Y-30\n",
       {"line X10 Y5 F100", "line X30 Y5 F100", "line X32 F100", "line X32 Y-20 F100", "line X30 Y-30 F100",
        "end 0"}},
      {"back on the same way: half a circle around the end",
       "G41 D1 G1 X10 F100\nX30\nX10\nG40 X0\n",
       {"line X10 Y5 F100", "line X30 Y5 F100", "arc X30 Y-5 cw 30 0 0 180deg F100", "line X10 Y-5 F100",
        "line F100", "end 0"}},
      // The polygon around a quarter in rapid has one corner: (30 + 5, 5).
      {"outside corner in rapid",
       "G41 D1 G0 X10\nX30\nY-20\nG40 Y-30\n",
       {"rapid X10 Y5", "rapid X30 Y5", "rapid X35 Y5", "rapid X35", "rapid X35 Y-20", "rapid X30 Y-30",
        "end 0"}},
      {"helix: the height is the programmed one",
       "G41 D1 G1 X10 Y-20 F100\nX30\nG3 X50 Y0 Z-4 J20\nG1 Y10\nG40 X0\n",
       {"line X10 Y-15 F100", "line X30 Y-15 F100", "arc X45 Z-4 ccw 30 0 0 90deg F75",
        "line X45 Y10 Z-4 F100", "line Y10 Z-4 F100", "end 0"}},
      {"full circle inside a bore",
       "G41 D1 G1 X20 F100\nG3 I-20\nG40 G1 X0\n",
       // Square beside (20,0), walking up: x = 15.
       {"line X15 F100", "arc X15 ccw 0 0 0 360deg F75", "line F100", "end 0"}},
      {"ZX plane",
       "G18 G41 D1 G1 Z10 F100\nZ30\nX20\nG40 Z0\n",
       {"line X5 Z10 F100", "line X5 Z25 F100", "line X20 Z25 F100", "line X20 F100", "end 0"}},
      {"end of the program ends square",
       "G41 D1 G1 X10 F100\nX30\nM30\n",
       {"line X10 Y5 F100", "line X30 Y5 F100", "end 30"}},
      {"off without a move: the next straight one leads out",
       "G41 D1 G1 X10 F100\nX30\nG40\nM8\nX50\n",
       {"line X10 Y5 F100", "line X30 Y5 F100", "M8", "line X50 F100", "end 0"}},
      {"on without a move: the next straight one leads in",
       "G41 D1\nM8\nG1 X10 F100\nX30\nG40 X50\n",
       {"M8", "line X10 Y5 F100", "line X30 Y5 F100", "line X50 F100", "end 0"}},
      {"work offsets and tool length come behind it",
       "G52 X100 Z1\nG10 L10 P9 R7\nG43 H9\nG41 D1 G1 X10 Y0 Z0 F100\nX30\nG40 X50\n",
       {"table2 9 7", "frame none L7", "line X110 Y5 Z8 F100", "line X130 Y5 Z8 F100", "line X150 Z8 F100",
        "end 0"}},
      {"turned by G68",
       "G68 X0 Y0 R90\nG41 D1 G1 X10 F100\nX30\nY20\nG40 X0\n",
       {"line X-5 Y10 F100", "line X-5 Y25 F100", "line X-20 Y25 F100", "line X-20 F100", "end 0"}},
      {"a scaled contour keeps the tool's radius",
       "G51 X0 Y0 Z0 P2\nG41 D1 G1 X10 F100\nX30\nY20\nG40 X0\n",
       {"line X20 Y5 F100", "line X55 Y5 F100", "line X55 Y40 F100", "line Y40 F100", "end 0"}},
      {"a mirror changes the side",
       "G51.1 X0\nG41 D1 G1 X10 F100\nX30\nY20\nG40 X0\n",
       {"line X-10 Y5 F100", "line X-25 Y5 F100", "line X-25 Y20 F100", "line Y20 F100", "end 0"}},
  };
  expect_streams(machine, goldens);
}

}  // namespace
}  // namespace trunnion::language::test
