// SPDX-License-Identifier: Apache-2.0
#include "stream/gantry_report.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "testing_support/refusal.hpp"

namespace trunnion::stream::gantry_report_test {
namespace {

// Axis 1 is the master, axis 2 its slave at 0.5 mm more.
machine::Parameters gantry() {
  machine::Parameters p;
  p.values[40001] = {0, ""}, p.values[40002] = {1, ""};
  p.values[100000] = {0, "X"}, p.values[101000] = {0, "Y1"}, p.values[102000] = {0, "Y2"};
  p.values[10050] = {1, ""}, p.values[10051] = {2, ""};
  p.values[102100] = {1, ""}, p.values[102101] = {1, ""};
  p.values[102129] = {0.5, ""};
  return p;
}

// The slave is 0.25 mm ahead of where it belongs.
idl::stream::Feedback feedback() {
  idl::stream::Feedback f;
  f.axis_count = 3;
  f.mode = idl::stream::DriveMode::FOLLOWING;
  f.position = {0, 100, 100.75}, f.velocity = {0, 0, 0}, f.torque = {0, 0, 0}, f.enabled = {1, 1, 1};
  return f;
}

TEST(GantryReports, HaveBothSidesAndTheProposal) {
  const auto reports = gantry_reports(gantry(), feedback());
  ASSERT_EQ(reports.size(), 1u);
  const auto& report = reports.front();
  EXPECT_EQ(report.master_name, "Y1");
  EXPECT_EQ(report.slave_name, "Y2");
  EXPECT_EQ(report.state, "coupled");
  EXPECT_EQ(report.master_position, 100);
  EXPECT_EQ(report.slave_position, 100.75);
  EXPECT_NEAR(report.difference.position, 0.25, 1e-9);
  EXPECT_NEAR(std::abs(report.offset.proposal - report.offset.now), 0.25, 1e-9);
  EXPECT_TRUE(report.proposes());
}

TEST(GantryReports, LeaveOutWhatTheCompensationAccountsFor) {
  auto f = feedback();
  idl::stream::StageState state;
  state.stage = idl::stream::Stage::GANTRY;
  state.values = {0.25};
  f.channels.resize(1);
  f.channels[0].states.push_back(state);
  const auto reports = gantry_reports(gantry(), f);
  ASSERT_EQ(reports.size(), 1u);
  EXPECT_NEAR(reports[0].difference.position, 0, 1e-9);
  EXPECT_FALSE(reports[0].proposes());
}

TEST(GantryReports, SayWhatTheSlaveDoes) {
  auto f = feedback();
  f.enabled[2] = 3;
  EXPECT_EQ(gantry_reports(gantry(), f).at(0).state, "slave taken off");
  f.enabled[2] = 0;
  EXPECT_EQ(gantry_reports(gantry(), f).at(0).state, "drives off");
  f.position.resize(2);
  EXPECT_EQ(testing_support::refusal_of([&] { gantry_reports(gantry(), f); }),
            "the drive does not report axis 2");
}

TEST(GantryReports, WaitForRest) {
  auto f = feedback();
  EXPECT_FALSE(axes_move(f));
  f.channels.resize(1);
  f.channels[0].active = true;
  EXPECT_TRUE(axes_move(f));
}

}  // namespace
}  // namespace trunnion::stream::gantry_report_test
