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
  idl::stream::AxisFrame in, out;
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
  PitchTable table{true, false, true, 0, 90, 1, {0, 0.01, 0, -0.01}, {}};
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

}  // namespace
}  // namespace trunnion::compensation
