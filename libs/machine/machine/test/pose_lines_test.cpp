// SPDX-License-Identifier: Apache-2.0
#include "machine/pose_lines.hpp"

#include <gtest/gtest.h>

namespace trunnion::machine::pose_lines_test {
namespace {

using Direction = PoseLines::Direction;

Parameters with(std::map<std::uint32_t, double> values) {
  Parameters p;
  for (const auto& [number, value] : values) p.values[number] = {value, ""};
  return p;
}

Parameters ac_table() {
  return with({{40004, 3}, {40006, 4}, {40425, 35}, {40426, -1}, {40431, -1}, {103006, 110}, {103007, -110}});
}

std::string answer(const PoseLines& lines, Direction direction, const std::string& line) {
  return lines.answer(direction, line).text;
}

std::string error(const PoseLines& lines, Direction direction, const std::string& line) {
  try {
    return "no error but " + lines.answer(direction, line).text;
  } catch (const std::runtime_error& e) {
    return e.what();
  }
}

// A90 about -X takes (1, 2, 3) to (1, 3, -2); the spindle face is the tool's 100 above.
TEST(PoseLines, inverse_and_forward_by_hand) {
  const PoseLines lines(ac_table(), 0, 100);
  EXPECT_EQ(answer(lines, Direction::inverse, "1 2 3 90 0"), "1.000000000000 3.000000000000 98.000000000000");
  EXPECT_EQ(answer(lines, Direction::forward, " +1\t3 98 9e1 -0 "),
            "1.000000000000 2.000000000000 3.000000000000 0.000000000000 -1.000000000000 0.000000000000");
  EXPECT_EQ(answer(lines, Direction::inverse, "1 2 3 C0 A90"),
            answer(lines, Direction::inverse, "1 2 3 90 0"));
}

// The tool leans to (0, -sin A, cos A); 3 : 4 : 5.
TEST(PoseLines, orient_lists_every_solution_on_one_line) {
  const PoseLines lines(ac_table(), 0, 0);
  EXPECT_EQ(answer(lines, Direction::orient, "0 -0.6 0.8"),
            "36.869897645844 0.000000000000 -36.869897645844 180.000000000000");
  EXPECT_EQ(answer(lines, Direction::orient, "0 0 -1"), "none");
  EXPECT_EQ(lines.answer(Direction::orient, "0 0 -1").warning, "a rotary axis would leave its travel");
  EXPECT_EQ(lines.answer(Direction::orient, "0 -6 8").warning,
            "the tool direction is 10 long and is normalized");
}

TEST(PoseLines, rotary_positions_stand_in_the_order_of_the_parameters) {
  EXPECT_EQ(PoseLines(ac_table(), 0, 0).letters(), "AC");
  EXPECT_EQ(PoseLines(with({{40410, 54}, {40413, 1}, {40415, 1}}), 0, 0).letters(), "CB");
  EXPECT_EQ(PoseLines(with({{40410, 4}, {40415, 1}, {40425, 5}, {40431, -1}}), 0, 0).letters(), "BC");
}

// Head: C90 after B90 tilts the tool of 10 to +X, then to +Y.
TEST(PoseLines, the_first_position_of_a_cb_head_is_c) {
  const PoseLines lines(with({{40410, 54}, {40413, 1}, {40415, 1}}), 0, 10);
  EXPECT_EQ(answer(lines, Direction::inverse, "0 0 0 90 90"),
            "0.000000000000 10.000000000000 0.000000000000");
  EXPECT_EQ(answer(lines, Direction::inverse, "0 0 0 0 90"), "10.000000000000 0.000000000000 0.000000000000");
}

TEST(PoseLines, a_four_axis_machine_has_one_rotary_position) {
  const PoseLines lines(with({{40004, 3}, {40425, 3}, {40429, -1}}), 0, 0);
  EXPECT_EQ(answer(lines, Direction::inverse, "1 2 3 90"), "1.000000000000 3.000000000000 -2.000000000000");
  EXPECT_EQ(answer(lines, Direction::orient, "0.6 0 0.8"), "none");
  EXPECT_EQ(lines.answer(Direction::orient, "0.6 0 0.8").warning,
            "the machine does not reach this direction; the nearest is 0.000000000 0.000000000 1.000000000");
}

TEST(PoseLines, bad_lines_are_one_clear_message) {
  const PoseLines lines(ac_table(), 0, 0);
  EXPECT_EQ(error(lines, Direction::inverse, "1 2 3 4"), "expected 5 numbers (rotary axes AC), there are 4");
  EXPECT_EQ(error(lines, Direction::inverse, "1 2 3 4 5 6"),
            "expected 5 numbers (rotary axes AC), there are 6");
  EXPECT_EQ(error(lines, Direction::forward, "1 2 x 4 5"), "'x' is not a number");
  EXPECT_EQ(error(lines, Direction::forward, "1 2 nan 4 5"), "'nan' is not a number");
  EXPECT_EQ(error(lines, Direction::forward, "1 2 1e999 4 5"), "'1e999' is not a number");
  EXPECT_EQ(error(lines, Direction::forward, "1 2 3 4 5mm"), "'5mm' is not a number");
  EXPECT_EQ(error(lines, Direction::forward, "1 2 3 A4 A5"), "'A5': the rotary axes are AC, each once");
  EXPECT_EQ(error(lines, Direction::forward, "1 2 3 B4 C5"), "'B4': the rotary axes are AC, each once");
  EXPECT_EQ(error(lines, Direction::forward, "1 2 3 4 -2e9"), "'-2e9' is beyond 1e9");
  EXPECT_EQ(error(lines, Direction::orient, "0 0 0"), "the tool direction is zero");
  EXPECT_EQ(error(lines, Direction::orient, "0 0 1 0"), "expected 3 numbers, there are 4");
}

// A B head that carries Z: at B90 nothing lifts the tool.
TEST(PoseLines, a_pose_without_a_position_is_a_message) {
  const PoseLines quill(with({{40410, 4}, {40415, 1}, {40422, 180}, {40907, 1}}), 0, 0);
  EXPECT_EQ(error(quill, Direction::inverse, "0 0 0 90"),
            "X, Y and Z lie in one plane at these angles: there is no position");
  EXPECT_EQ(answer(quill, Direction::inverse, "1 2 3 0"), "1.000000000000 2.000000000000 3.000000000000");
}

}  // namespace
}  // namespace trunnion::machine::pose_lines_test
