// SPDX-License-Identifier: Apache-2.0
// Blocks within a curve: lines of 0.1 mm that motion makes one smooth curve of stay blocks for M functions,
// single block and a start from a line.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "channel_fixture.hpp"

namespace trunnion::channel {
namespace {

using testing::Channel;
using testing::CommandKind;

constexpr int chords = 628;                 // of 0.1 mm
constexpr double curve_radius = 10;         // mm
constexpr double contour_tolerance = 0.01;  // parameter 040901

struct DenseRun : Channel {
  static constexpr int head = 3;  // lines before the first chord

  static double rounded(double v) { return std::round(v * 1e4) / 1e4; }
  static std::array<double, 2> end_of(int chord) {
    const double angle = 2 * std::numbers::pi * chord / chords;
    return {rounded(curve_radius * std::cos(angle)), rounded(curve_radius * std::sin(angle))};
  }
  /// Once around; `function` stands on a line of its own behind the chord `after`.
  static std::string circle_with(const std::string& function = "", int after = 0) {
    std::string program = "G21 G90 G94 G54\nF3000\nG0 X10 Y0\n";
    for (int k = 1; k <= chords; ++k) {
      char line[60];
      std::snprintf(line, sizeof line, "G1 X%.4f Y%.4f\n", end_of(k)[0], end_of(k)[1]);
      program += line;
      if (k == after) program += function;
    }
    return program + "M30\n";
  }
  void start(const std::string& program) {
    load(program);
    cycles_per_round = 8;
    ASSERT_TRUE(ask(CommandKind::CYCLE_START).accepted);
  }
  void run_to_line(int line) {
    for (int i = 0; i < 5000 && (drive.lines.empty() || static_cast<int>(drive.lines.back()) < line); ++i)
      round();
    ASSERT_GE(static_cast<int>(drive.lines.back()), line);
  }
  /// Rows of the circle are within the tolerance of it, without a jump; `from`: the first of them.
  void expect_circle(std::size_t from) const {
    // A chord is 0.1^2 / 80 mm below the circle; 50 mm/s are 0.05 mm in a cycle.
    for (std::size_t i = from; i < drive.rows.size(); ++i) {
      ASSERT_NEAR(std::hypot(drive.rows[i][0], drive.rows[i][1]), curve_radius, contour_tolerance + 2e-4)
          << i;
      if (i > from) {
        ASSERT_LT(
            std::hypot(drive.rows[i][0] - drive.rows[i - 1][0], drive.rows[i][1] - drive.rows[i - 1][1]),
            0.051)
            << i;
      }
    }
  }
  std::size_t first_row_on_the_circle() const {
    std::size_t first = 0;
    while (drive.lines[first] <= head) ++first;
    return first;
  }
  void expect_to_stand_at_the_end_of(int chord) const {
    EXPECT_EQ(drive.rows.back()[0], end_of(chord)[0]);
    EXPECT_EQ(drive.rows.back()[1], end_of(chord)[1]);
  }
};

TEST_F(DenseRun, AnMFunctionIsAskedForWhereItsBlockStands) {
  answer_plc = false;
  start(circle_with("M8\n", 300));
  for (int i = 0; i < 5000 && auxiliaries.empty(); ++i) round();
  ASSERT_EQ(auxiliaries.size(), 1u);
  EXPECT_EQ(auxiliaries.back().code, 8u);
  expect_to_stand_at_the_end_of(300);
  for (int i = 0; i < 10; ++i) round();
  expect_to_stand_at_the_end_of(300);
  answer_plc = true;
  core->on_auxiliary_done({0, auxiliaries.back().number, false});
  run();
  EXPECT_EQ(core->run_state(), RunState::IDLE);
  expect_to_stand_at_the_end_of(chords);
  expect_circle(first_row_on_the_circle());
}

TEST_F(DenseRun, SingleBlockStopsAtTheEndsOfBlocks) {
  ASSERT_TRUE(ask(CommandKind::SINGLE_BLOCK, "", 1).accepted);
  start(circle_with());
  run();
  for (int i = 0; i < 20 && drive.lines.back() <= head; ++i) {
    ASSERT_EQ(core->run_state(), RunState::HELD);
    ASSERT_TRUE(ask(CommandKind::CYCLE_START).accepted);
    run();
  }
  const int first = static_cast<int>(drive.lines.back()) - head;
  ASSERT_EQ(first, 1);
  for (int k = 0; k < 12; ++k) {
    ASSERT_EQ(core->run_state(), RunState::HELD);
    expect_to_stand_at_the_end_of(first + k);
    ASSERT_TRUE(ask(CommandKind::CYCLE_START).accepted);
    run();
  }
  ASSERT_TRUE(ask(CommandKind::SINGLE_BLOCK, "", 0).accepted);
  ASSERT_TRUE(ask(CommandKind::CYCLE_START).accepted);
  run();
  EXPECT_EQ(core->run_state(), RunState::IDLE);
  expect_to_stand_at_the_end_of(chords);
  expect_circle(first_row_on_the_circle());
}

TEST_F(DenseRun, AStartFromALineWithinTheCurveBeginsAtTheEndOfTheLineBefore) {
  load(circle_with());
  ASSERT_TRUE(ask(CommandKind::START_FROM_LINE, "", head + 301).accepted);
  run();
  ASSERT_EQ(core->run_state(), RunState::HELD);
  ASSERT_TRUE(ask(CommandKind::CYCLE_START).accepted);
  run();
  EXPECT_EQ(core->run_state(), RunState::IDLE);
  // The approach ends there; behind it everything is on the circle.
  const auto there = [&](const auto& row) {
    return std::hypot(row[0] - end_of(300)[0], row[1] - end_of(300)[1]) < 1e-9;
  };
  const auto found = std::find_if(drive.rows.begin(), drive.rows.end(), there);
  ASSERT_NE(found, drive.rows.end());
  const auto first = static_cast<std::size_t>(found - drive.rows.begin());
  expect_to_stand_at_the_end_of(chords);
  expect_circle(first);
}

}  // namespace
}  // namespace trunnion::channel
