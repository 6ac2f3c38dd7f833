// SPDX-License-Identifier: Apache-2.0
// Travel is checked over the whole of a move before any of it: where the extreme lies inside, too.
#include <gtest/gtest.h>

#include "reading.hpp"

namespace trunnion::channel_setup {
namespace {

using test::read;
using test::setup_of;

struct Case {
  const char* name;
  const char* machine;
  std::string lines;  // behind the head; the last one is refused, unless `alarm` is 0
  unsigned alarm;
  std::string text;  // part of the alarm's text
};

void PrintTo(const Case& c, std::ostream* out) { *out << c.name; }

class TravelOfAMove : public testing::TestWithParam<Case> {};

TEST_P(TravelOfAMove, IsKnownBeforeItStarts) {
  auto setup = setup_of(GetParam().machine);
  const std::string program = "G21 G17 G90 G54 G94 F1000\n" + GetParam().lines + "\n";
  const auto result = read(setup, program);
  EXPECT_EQ(result.alarm, GetParam().alarm) << result.text;
  EXPECT_NE(result.text.find(GetParam().text), std::string::npos) << result.text;
  if (GetParam().alarm == 0) return;
  EXPECT_EQ(result.line, static_cast<unsigned>(std::count(program.begin(), program.end(), '\n')));
  for (const auto& c : result.commands)
    EXPECT_TRUE(c.line < result.line || c.kind == language::CommandKind::transformation);
}

// On the AC table C takes the point (390, 150) to X = r cos(t - f), Y = -r sin(t - f) with r^2 = 390^2 +
// 150^2, r = 417.8516, and tan f = 150 / 390, f = 21.0375: from C0 (X390) to C42 (X390.2) the way leads over
// X417.8516 at C21.04, beyond the travel of 400. The plane I42 J30 K0 is the one of A30 C42; A turns about X
// and does not change it. The point
// (373.339, 143.592) has r = 400.0008, (373.338, 143.592) has 399.9999. Of many turns at r = 310 the travel
// of Y, 300, is left by 10.
INSTANTIATE_TEST_SUITE_P(
    Moves, TravelOfAMove,
    testing::Values(
        Case{"feed_of_c", "ac-table", "G43.4 H1\nG0 X390 Y150 Z0\nG1 C42", 140, "4: X would go to 417.8516"},
        Case{"rapid_of_c", "ac-table", "G43.4 H1\nG0 X390 Y150 Z0\nG0 C42", 140, "X would go to 417.8516"},
        Case{"line_with_both", "ac-table", "G43.4 H1\nG0 X390 Y150 Z0\nG1 X390.0001 C42", 140,
             "X would go to 417.851"},
        Case{"many_turns", "ac-table", "G43.4 H1\nG0 X310 Y0 Z0\nG91 G1 C35999.9", 140, "310.0000"},
        Case{"barely_beyond", "ac-table", "G43.4 H1\nG0 X373.339 Y143.592 Z0\nG1 C42", 140,
             "X would go to 400.0008"},
        Case{"barely_within", "ac-table", "G43.4 H1\nG0 X373.338 Y143.592 Z0\nG1 C42", 0, ""},
        Case{"swing_holding_the_tip", "ac-table",
             "G43.4 H1\nG0 X390 Y150 Z0\nG68.2 X0 Y0 Z0 I42 J30 K0\nG53.2", 140, "X would go to 417.8516"},
        Case{"swing_of_the_rotary_axes", "ac-table",
             "G43.4 H1\nG0 X390 Y150 Z0\nG68.2 X0 Y0 Z0 I42 J30 K0\nG53.1", 0, ""},
        Case{"swing_beyond_a", "ac-table", "G43.4 H1\nG68.2 X0 Y0 Z0 I0 J115 K0\nG53.1", 1122,
             "beyond the travel of a rotary axis"},
        Case{"swing_out_of_reach", "four-axis", "G43.4 H1\nG68.2 X0 Y0 Z0 I90 J30 K0\nG53.2", 1116,
             "nearest I0.000000 J0.000000 K1.000000"},
        // The tool stands with the axes at zero; 450 along it is Z-380 + 100 + 450 for the spindle face.
        Case{"move_along_the_tool", "ac-table", "G43.4 H1\nG0 X0 Y0 Z0\nG53.3 L450", 140,
             "Z would go to 170.0000"},
        Case{"tool_vector_turning_first", "ac-table",
             "G43.5 H1\nG0 X390 Y150 Z0\nG1 I0.33456530 J-0.37157241 K0.86602540", 1123,
             "X would go to 417.8516"},
        // Half circles about (300, 0) of radius 120: X420 half-way.
        Case{"arc", "ac-table", "G0 X300 Y-120\nG3 X300 Y120 J120", 140, "X would go to 420.0000"},
        Case{"arc_of_the_tip", "ac-table", "G43.4 H1\nG0 X300 Y-120\nG3 X300 Y120 J120", 140,
             "X would go to 420.0000"},
        Case{"arc_of_the_tip_with_a_vector", "ac-table",
             "G43.5 H1\nG0 X300 Y-120\nG3 X300 Y120 R120 I0 J-0.1 K1", 1123, "X would go to 420.0000"},
        // C follows the great circle from upright towards (1, 0, 1): 45 degrees, then to (0, 1, -1.5) beyond
        // A110.
        Case{"rotary_axis_on_the_way", "ac-table", "G43.5 H1\nG1 I1 K1\nJ1 K-2", 1123, ""}),
    [](const auto& one) { return one.param.name; });

// G54 is X10 Y20 Z-700, so the tip stands at Z0 of the machine. With a quill for Z in the head, a swing to
// B60 takes X to about 10 + 180 sin 60 / cos 60 = 322, whatever the tool. At B90 no position of X, Y and Z
// holds the tip, and on the way there they have left their travel.
TEST(TravelOfAQuill, EndsWhereItCannotHoldTheTip) {
  auto tables = tool_tables::load_machine_tables(std::string(MACHINES_DIRECTORY) + "/b-head-c-table");
  tables.parameters.values[40907] = {1, ""};
  ChannelSetup setup(std::move(tables));
  const std::string start = "G43.4 H1\nG0 X0 Y0 Z700\n";
  EXPECT_EQ(read(setup, start + "G0 B60\nG0 B-60\n").text, "");
  for (const char* move : {"G0 B90\n", "G1 B100 F1000\n", "G1 B-90.3 F1000\n"}) {
    const auto result = read(setup, start + move);
    EXPECT_EQ(result.alarm, 140u) << move;
    EXPECT_EQ(result.line, 3u) << move;
  }
}

}  // namespace
}  // namespace trunnion::channel_setup
