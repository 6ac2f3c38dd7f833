// SPDX-License-Identifier: Apache-2.0
#include "channel_setup/axis_box.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "channel_setup/channel_setup.hpp"

namespace trunnion::channel_setup {
namespace {

using language::CommandKind;

const std::string ac_table_directory = MACHINES_DIRECTORY "/ac-table";

language::Command arc_about(double x, double y, double sweep, const AxisValues& target, bool clockwise) {
  language::Command move;
  move.kind = CommandKind::arc;
  move.target = target;
  move.arc.clockwise = clockwise;
  move.arc.centre = {x, y, 0};
  move.arc.sweep = sweep;
  return move;
}

TEST(AxisBox, TheTopOfAnArcCountsThoughBothItsEndsAreLow) {
  const ChannelSetup setup(tool_tables::load_machine_tables(ac_table_directory));
  // Half a circle of radius 300 about the origin from +X over +Y to -X.
  const auto move = arc_about(0, 0, 180, {-300, 0}, false);
  const auto box = extent_of({300, 0}, move, setup.chain());
  EXPECT_NEAR(box.high[1], 300, 1e-4);
  EXPECT_NEAR(box.low[1], 0, 1e-9);
  EXPECT_NEAR(box.low[0], -300, 1e-9);
}

TEST(AxisBox, AnExtremeInTheFirstStepOfAnArcIsFound) {
  const ChannelSetup setup(tool_tables::load_machine_tables(ac_table_directory));
  // From 88 to 93 degrees: the top is 2 degrees behind the start.
  const double r = 200, from = 88 * M_PI / 180, to = 93 * M_PI / 180;
  const auto move = arc_about(0, 0, 5, {r * std::cos(to), r * std::sin(to)}, false);
  const auto box = extent_of({r * std::cos(from), r * std::sin(from)}, move, setup.chain());
  EXPECT_NEAR(box.high[1], r, 1e-4);
}

TEST(AxisBox, ASwingUnderAHeldTipCountsWhereTheLinearAxisIsFarthest) {
  const ChannelSetup setup(tool_tables::load_machine_tables(ac_table_directory));
  // C turns the table about X0 Y0; a tip held on the workpiece at radius 100 goes over the full circle's
  // quarter from 45 degrees on one side of the X axis to 45 degrees on the other: X is farthest in the
  // middle, at the radius, while both ends are at 100 cos 45.
  language::Command move;
  move.kind = CommandKind::line;
  move.modal.transformation = language::Transformation::rtcp;
  const double side = 100 * std::sqrt(0.5);
  const AxisValues from{side, side, -400, 0, 0, 0};
  move.target = {side, side, -400, 0, 0, 90};
  const auto box = extent_of(from, move, setup.chain());
  EXPECT_NEAR(box.high[0], 100, 1e-3);
  EXPECT_NEAR(box.low[0], side, 1e-6);
}

TEST(AxisBox, AnOffsetIsAddedBeforeTheLimitsAreLookedAt) {
  const ChannelSetup setup(tool_tables::load_machine_tables(ac_table_directory));
  const AxisBox box{{-10}, {390}};
  EXPECT_EQ(setup.travel_error(box, {5}, 3), "");
  EXPECT_EQ(setup.travel_error(box, {11}, 3),
            "3: X would go to 401.0000, its travel is -400.0000 .. 400.0000");
}

}  // namespace
}  // namespace trunnion::channel_setup
