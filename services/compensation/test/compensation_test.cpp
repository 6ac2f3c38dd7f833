// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "compensation_core.hpp"

namespace trunnion::compensation {
namespace {

machine::Parameters one_axis() {
  machine::Parameters p;
  p.values[40001] = {0, ""};
  return p;
}

std::vector<double> run(CompensationCore& core, const std::vector<double>& x) {
  idl::stream::AxisBatch in, out;
  in.axes = {0};
  in.count = static_cast<std::uint32_t>(x.size());
  in.setpoints = x;
  core.process(in, {}, out);
  return out.setpoints;
}

TEST(Compensation, NothingConfiguredChangesNothing) {
  CompensationCore core;
  core.configure(one_axis(), 0);
  EXPECT_EQ(run(core, {1, 2, 1.5}), (std::vector<double>{1, 2, 1.5}));
}

TEST(Compensation, BacklashIsTakenUpAtTheReversalStepByStep) {
  auto p = one_axis();
  p.values[300000] = {1, ""}, p.values[300001] = {0.02, ""}, p.values[300002] = {0.01, ""};
  CompensationCore core;
  core.configure(p, 0);
  // Up: nothing. Down: 0.01 in each cycle until 0.02 is reached. Standing still keeps it. Up: it is given
  // back.
  const auto y = run(core, {0, 1, 2, 1, 0.5, 0.25, 0.25, 1, 2});
  const std::vector<double> want{0, 1, 2, 0.99, 0.48, 0.23, 0.23, 0.99, 2};
  for (std::size_t i = 0; i < want.size(); ++i) EXPECT_NEAR(y[i], want[i], 1e-12) << i;
}

// Both rotary axes turning, a linear axis that is to stay at rest has the rounding of the transformation,
// 1e-13 here. A slow move is one: 2e-9 in each cycle are 0.12 um a minute.
TEST(Compensation, RoundingIsNoReversalAndASlowMoveIs) {
  auto p = one_axis();
  p.values[300000] = {1, ""}, p.values[300001] = {0.02, ""}, p.values[300002] = {0.02, ""};
  CompensationCore core;
  core.configure(p, 0);
  for (const double y : run(core, {10, 10 - 1e-13, 10 + 1e-13, 10 - 1e-13})) EXPECT_NEAR(y, 10, 1e-12);
  double x = 10, y = 10;
  for (int i = 0; i < 10; ++i) y = run(core, {x -= 0.4e-9}).back();
  EXPECT_NEAR(y, x - 0.02, 1e-12) << "4e-9 in all";
}

TEST(Compensation, PitchIsInterpolatedAndKeepsItsBoundaryValueOutside) {
  auto p = one_axis();
  // Table 0.00 0.01 0.03 at -10, 0, 10, doubled by the override.
  p.values[300020] = {1, ""}, p.values[300021] = {-10, ""}, p.values[300022] = {3, ""},
  p.values[300023] = {10, ""};
  p.values[300025] = {2, ""}, p.values[700001] = {0.01, ""}, p.values[700002] = {0.03, ""};
  CompensationCore core;
  core.configure(p, 0);
  const auto y = run(core, {-20, -5, 0, 5, 10, 50});
  const std::vector<double> want{-20, -5 + 2 * 0.005, 0.02, 5 + 2 * 0.02, 10.06, 50.06};
  for (std::size_t i = 0; i < want.size(); ++i) EXPECT_NEAR(y[i], want[i], 1e-12) << i;
}

TEST(Compensation, ABidirectionalTableUsesItsSecondHalfGoingDown) {
  auto p = one_axis();
  p.values[300020] = {2, ""}, p.values[300022] = {2, ""}, p.values[300023] = {10, ""};
  p.values[700000] = {0.01, ""}, p.values[700001] = {0.01, ""}, p.values[700002] = {-0.01, ""},
  p.values[700003] = {-0.01, ""};
  CompensationCore core;
  core.configure(p, 0);
  const auto y = run(core, {5, 6, 5});
  EXPECT_NEAR(y[1], 6.01, 1e-12);
  EXPECT_NEAR(y[2], 4.99, 1e-12);
}

TEST(Compensation, AModuloTableRepeats) {
  ErrorTable table{true, false, true, 0, 90, 1, {0, 0.01, 0, -0.01}, {}};
  EXPECT_NEAR(table.at(90, true), 0.01, 1e-15);
  EXPECT_NEAR(table.at(450, true), 0.01, 1e-15);
  EXPECT_NEAR(table.at(315, true), -0.005, 1e-15) << "half way from -0.01 at 270 to 0 at 360";
}

TEST(Compensation, AFreshProcessWithTheSavedStateGoesOnWithTheSameBits) {
  auto p = one_axis();
  p.values[300000] = {1, ""}, p.values[300001] = {0.02, ""}, p.values[300002] = {0.003, ""};
  CompensationCore whole, first, second;
  for (auto* core : {&whole, &first, &second}) core->configure(p, 0);
  std::vector<double> x;
  for (int i = 0; i < 200; ++i) x.push_back(10 * ((i % 40) < 20 ? i % 40 : 40 - i % 40) / 7.0);
  const auto all = run(whole, x);
  const std::size_t cut = 27;
  run(first, {x.begin(), x.begin() + cut});
  stream::StateValues state;
  first.save(state);
  second.load(state);
  const auto rest = run(second, {x.begin() + cut, x.end()});
  for (std::size_t i = 0; i < rest.size(); ++i) EXPECT_EQ(rest[i], all[cut + i]) << i;
}

// Axis 1 is the master, axis 2 its mirrored slave, 100 mm away.
machine::Parameters gantry() {
  machine::Parameters p;
  p.values[40001] = {0, ""}, p.values[40002] = {1, ""};
  p.values[100000] = {0, "X"}, p.values[101000] = {0, "Y1"}, p.values[102000] = {0, "Y2"};
  p.values[10050] = {1, ""}, p.values[10051] = {2, ""};
  p.values[102100] = {1, ""}, p.values[102101] = {1, ""}, p.values[102127] = {1, ""};
  p.values[102129] = {100, ""};
  return p;
}

idl::stream::AxisBatch run_gantry(const machine::Parameters& p, const std::vector<double>& setpoints) {
  CompensationCore core;
  core.configure(p, 0);
  idl::stream::AxisBatch in, out;
  in.axes = {0, 1};
  in.count = static_cast<std::uint32_t>(setpoints.size() / 2);
  in.setpoints = setpoints;
  core.process(in, {}, out);
  return out;
}

TEST(Compensation, AGantryWithoutTablesHasNoColumnForItsSlave) {
  EXPECT_EQ(run_gantry(gantry(), {1, 2}).axes, (std::vector<std::uint16_t>{0, 1}));
}

TEST(Compensation, TheSlaveOfAGantryHasItsOwnTableAndBacklashOnItsOwnPosition) {
  auto p = gantry();
  // Slave: 0.00 0.01 0.03 at 80, 90, 100; backlash 0.5.
  p.values[302020] = {1, ""}, p.values[302021] = {80, ""}, p.values[302022] = {3, ""},
  p.values[302023] = {10, ""};
  p.values[302026] = {700000, ""}, p.values[700001] = {0.01, ""}, p.values[700002] = {0.03, ""};
  p.values[302000] = {1, ""}, p.values[302001] = {0.5, ""}, p.values[302002] = {1, ""};
  const auto out = run_gantry(p, {0, 5, 0, 10});
  EXPECT_EQ(out.axes, (std::vector<std::uint16_t>{0, 1, 2}));
  // The master at 5 and 10 has the slave at 95 and 90, so it moves in negative direction: the backlash comes
  // off.
  const std::vector<double> expected{0, 5, 95 + 0.02, 0, 10, 90 + 0.01 - 0.5};
  ASSERT_EQ(out.setpoints.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_NEAR(out.setpoints[i], expected[i], 1e-12) << i;
}

TEST(Compensation, TheMastersTableIsNotTheSlaves) {
  auto p = gantry();
  p.values[301020] = {1, ""}, p.values[301022] = {2, ""}, p.values[301023] = {10, ""};
  p.values[301026] = {700000, ""}, p.values[700000] = {0.01, ""}, p.values[700001] = {0.01, ""};
  const auto out = run_gantry(p, {0, 5});
  const std::vector<double> expected{0, 5.01, 95};
  ASSERT_EQ(out.setpoints.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_NEAR(out.setpoints[i], expected[i], 1e-12) << i;
}

}  // namespace
}  // namespace trunnion::compensation
