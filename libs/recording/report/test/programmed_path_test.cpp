// SPDX-License-Identifier: Apache-2.0
#include "report/programmed_path.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "synthetic_run.hpp"

namespace trunnion::report {
namespace {

TEST(ProgrammedPath, KeepsLinesExactlyAndTellsFeedFromRapid) {
  const auto p =
      programmed_path("G54 G90\nG0 X10 Y0 Z0\nG1 X10 Y20 F1000\nG0 Z50\nM30\n", test::ac_table(), {});
  EXPECT_EQ(p.problem, "");
  EXPECT_EQ(p.rapid_lines, (std::set<std::uint32_t>{2, 4}));
  EXPECT_EQ(p.feed_lines, (std::set<std::uint32_t>{3}));
  EXPECT_DOUBLE_EQ(p.feed_length, 20);
  ASSERT_EQ(p.path.pieces().size(), 3u);
  EXPECT_EQ(p.path.pieces()[1].end, Vec3(10, 20, -380));
  EXPECT_EQ(p.zero, Vec3(0, 0, -380));
}

TEST(ProgrammedPath, ChordsOfACircleStayWithinANanometre) {
  const auto p =
      programmed_path("G54 G90 G17\nG0 X50 Y0 Z0\nG2 X50 Y0 I-50 J0 F1000\nM30\n", test::ac_table(), {});
  EXPECT_EQ(p.problem, "");
  EXPECT_NEAR(p.feed_length, 2 * std::numbers::pi * 50, 1e-5);
  for (std::size_t i = 1; i < p.path.pieces().size(); ++i) {
    const Vec3 a = p.path.begin_of(i), b = p.path.pieces()[i].end, middle = (a + b) / 2;
    EXPECT_NEAR(std::hypot(b.x(), b.y()), 50, 1e-9);
    EXPECT_GE(std::hypot(middle.x(), middle.y()), 50 - 1.01e-6);
  }
}

// A C axis that turns under a tool at rest draws a circle on the workpiece: radius 30 mm, half a turn.
TEST(ProgrammedPath, ATurningTableDrawsACircleOnTheWorkpiece) {
  const auto p = programmed_path("G54 G90\nG0 X30 Y0 Z0\nG1 C180 F1000\nM30\n", test::ac_table(), {});
  EXPECT_EQ(p.problem, "");
  EXPECT_NEAR(p.feed_length, std::numbers::pi * 30, 1e-5);
  for (const auto& piece : p.path.pieces())
    if (!piece.rapid) {
      EXPECT_NEAR(std::hypot(piece.end.x(), piece.end.y()), 30, 1e-9);
    }
}

TEST(ProgrammedPath, ASkipMoveEndsAtItsEndAndTheProgramGoesOn) {
  const auto p = programmed_path("G54 G90\nG31 X10 F1000\nG1 X[#5061+20]\nM30\n", test::ac_table(), {});
  EXPECT_EQ(p.problem, "");
  EXPECT_NEAR(p.feed_length, 30, 1e-9);
}

TEST(ProgrammedPath, OfAProgramThatRepeatsEndsAtItsReturn) {
  const auto once = programmed_path("G54 G90\nG1 X10 F1000\nX0\nM99\n", test::ac_table(), {});
  EXPECT_EQ(once.problem, "");
  EXPECT_NEAR(once.feed_length, 20, 1e-9);
  const auto endless = programmed_path("G54 G90\nN1 G1 X10 F1000\nX0\nGOTO 1\n", test::ac_table(), {});
  EXPECT_EQ(endless.problem, "");
  EXPECT_EQ(endless.feed_lines, (std::set<std::uint32_t>{2, 3}));
}

TEST(ProgrammedPath, AnAlarmIsNamedWithItsPlace) {
  const auto p = programmed_path("G54 G90\nG1 X10 M13\nM30\n", test::ac_table(), {});
  EXPECT_EQ(p.problem.substr(0, 2), "2:") << p.problem;
}

}  // namespace
}  // namespace trunnion::report
