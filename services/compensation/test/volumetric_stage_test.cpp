// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>

#include "machine/kinematics.hpp"
#include "one_channel.hpp"
#include "testing_support/allocation_count.hpp"

namespace trunnion::compensation {
namespace {

// X has EXX = 10 um at every place after a positive and 30 um after a negative approach.
machine::Parameters reversal_of_20_um() {
  auto p = axes({0, 1, 2});
  Set set{p};
  set(40951, 1), set(40953, 15);
  set(300900, 0), set(300901, 2), set(300902, 100), set(300903, 2), set(300904, 700000);
  for (std::uint32_t i = 0; i < 24; ++i) set(700000 + i, i < 2 ? 0.010 : i < 4 ? 0.030 : 0);
  p.revision = 1;
  return p;
}

std::vector<double> rows_of_x(const std::vector<double>& x) {
  std::vector<double> rows;
  for (const double value : x) rows.insert(rows.end(), {value, 0, 0});
  return rows;
}

// Up and down with 0.05 mm a cycle, 400 cycles each way.
std::vector<double> there_and_back(int cycles) {
  std::vector<double> x;
  for (int i = 0; i < cycles; ++i) x.push_back(10 + 0.05 * std::abs(400 - i % 800));
  return x;
}

TEST(VolumetricStage, TheCorrectionArrivesAfterTheTransition) {
  Channel channel(reversal_of_20_um());
  const auto x = there_and_back(800);
  const auto out = channel.run(rows_of_x(x), 3);
  // After 20 time constants exp(-20) 20^2 / 2 of 20 um is left: below 1e-8 mm.
  EXPECT_NEAR(out[3 * 399] - x[399], -0.030, 1e-7) << "negative approach: 30 um too far";
  EXPECT_NEAR(out[3 * 799] - x[799], -0.010, 1e-7);
}

// A step d through three low passes of time constant T has at most the jerk d / T^3: 0.02 / 0.015^3 = 5926
// mm/s3, the acceleration 0.231 d / T^2 = 20.5 mm/s2 and the speed 0.271 d / T = 0.36 mm/s.
TEST(VolumetricStage, AReversalIsSpreadWithinItsBounds) {
  Channel channel(reversal_of_20_um());
  const auto x = there_and_back(1600);
  const auto out = channel.run(rows_of_x(x), 3);
  const auto c = [&](std::size_t i) { return out[3 * i] - x[i]; };
  double speed = 0, acceleration = 0, jerk = 0;
  for (std::size_t i = 300; i + 3 < x.size(); ++i) {
    speed = std::max(speed, std::abs(c(i + 1) - c(i)) / 1e-3);
    acceleration = std::max(acceleration, std::abs(c(i + 2) - 2 * c(i + 1) + c(i)) / 1e-6);
    jerk = std::max(jerk, std::abs(c(i + 3) - 3 * c(i + 2) + 3 * c(i + 1) - c(i)) / 1e-9);
  }
  EXPECT_LE(speed, 0.271 * 0.02 / 0.015);
  EXPECT_LE(acceleration, 0.231 * 0.02 / (0.015 * 0.015));
  EXPECT_LE(jerk, 0.02 / std::pow(0.015, 3));
  EXPECT_GT(jerk, 1000) << "the reversal was seen";
}

// From the state after any cycle a new process computes the same bits.
TEST(VolumetricStage, AFreshProcessWithTheSavedStateContinuesWithTheSameBits) {
  auto p = reversal_of_20_um();
  Set set{p};
  set(300000, 2), set(300001, 0.01), set(300003, 0.02);
  set(300005, 1), set(300008, 1), set(300009, 1), set(300010, 0), set(300011, 700100), set(700100, 0.03);
  set(300110, 1), set(300111, 0.004);
  const auto rows = rows_of_x(there_and_back(1000));
  Channel whole(p);
  const auto all = whole.run(rows, 3);
  for (const std::size_t cut : {1u, 37u, 401u, 410u, 999u}) {
    Channel first(p), second(p);
    first.run({rows.begin(), rows.begin() + static_cast<long>(3 * cut)}, 3);
    stream::StateValues state;
    first.core.save(state);
    EXPECT_LE(state.size(), 512u);
    second.core.load(state);
    const auto rest = second.run({rows.begin() + static_cast<long>(3 * cut), rows.end()}, 3);
    for (std::size_t i = 0; i < rest.size(); ++i) ASSERT_EQ(rest[i], all[3 * cut + i]) << cut << " " << i;
  }
}

// New parameters (a new revision) and a new epoch, whose setpoints begin where the machine is, make no step.
TEST(VolumetricStage, OtherParametersAndANewEpochMakeNoStep) {
  auto p = reversal_of_20_um();
  Channel channel(p);
  auto last = channel.run(rows_of_x(there_and_back(300)), 3);
  const double corrected = last[last.size() - 3];
  const double at = there_and_back(300).back();
  for (std::uint32_t i = 0; i < 4; ++i) p.values[700000 + i] = {0.100, ""};
  p.revision = 2;
  stream::StateValues state;
  channel.core.save(state);
  channel.core.configure(p, 0);
  channel.core.load(state);
  EXPECT_NEAR(channel.run({at, 0, 0}, 3)[0], corrected, 1e-4) << "not by 70 um at once";
  EXPECT_NEAR(channel.run(rows_of_x(std::vector<double>(600, at)), 3)[3 * 599], at - 0.1, 1e-7);
  // Off: it goes back to nothing as slowly.
  p.values[40951] = {0, ""};
  p.revision = 3;
  channel.core.save(state);
  channel.core.configure(p, 0);
  channel.core.load(state);
  EXPECT_NEAR(channel.run({at, 0, 0}, 3)[0], at - 0.1, 1e-4);
  EXPECT_NEAR(channel.run(rows_of_x(std::vector<double>(600, at)), 3)[3 * 599], at, 1e-7);
  p = reversal_of_20_um();
  Channel other(p);
  other.run(rows_of_x(there_and_back(300)), 3);
  other.in.epoch = 7;
  EXPECT_NEAR(other.run({at, 0, 0}, 3)[0], at, 1e-4);
}

TEST(VolumetricStage, TheToolLengthOfTheBatchIsUsed) {
  auto p = axes({0, 1, 2});
  Set set{p};
  // EAZ = 0.01 deg at every place: 100 mm of tool are 100 * sin(0.01 deg) = 0.0174533 mm of Y.
  set(40951, 1), set(302900, 0), set(302901, 1), set(700003, 0.01), p.revision = 1;
  Channel channel(p);
  channel.in.snapshot.tool_length = 100;
  EXPECT_NEAR(channel.run(rows_of_x(std::vector<double>(800, 0)), 3)[3 * 799 + 1], -0.0174533, 1e-7);
  channel.in.snapshot.tool_length = 200;
  const auto out = channel.run(rows_of_x(std::vector<double>(800, 0)), 3);
  EXPECT_NEAR(out[1], -0.0174533, 1e-5);
  EXPECT_NEAR(out[3 * 799 + 1], -2 * 0.0174533, 1e-7);
}

// X with a slave (logical axis 6) that has a backlash of its own, so that it is a column of this stage; the
// coordinates of the slave count the opposite way in the second machine.
TEST(VolumetricStage, TheSlaveOfAGantryIsCorrectedWithItsMaster) {
  for (const double mirrored : {0.0, 1.0}) {
    auto p = reversal_of_20_um();
    Set set{p};
    p.values[100000] = {0, "X"}, p.values[101000] = {0, "Y"}, p.values[102000] = {0, "Z"};
    p.values[106000] = {0, "X2"};
    set(10050, 1), set(10051, 6);
    set(106100, 1), set(106101, 0), set(106127, mirrored), set(106129, 100);
    set(306000, 1), set(306001, 0.004), set(306002, 1);
    CompensationCore core;
    core.configure(p, 0);
    idl::stream::AxisBatch in, out;
    in.axes = {0, 1, 2};
    const auto x = there_and_back(800);
    in.setpoints = rows_of_x(x);
    in.count = static_cast<std::uint32_t>(x.size());
    core.process(in, {}, out);
    ASSERT_EQ(out.axes, (std::vector<std::uint16_t>{0, 1, 2, 6}));
    const double sign = mirrored == 1 ? -1 : 1;
    for (const std::size_t row : {399u, 799u}) {
      // The true X is 30 um too far after a negative approach, 10 um after a positive one.
      const double correction = row == 399 ? -0.030 : -0.010;
      EXPECT_NEAR(out.setpoints[4 * row] - x[row], correction, 1e-7);
      // The backlash adds to the slave where it moves in its own positive direction: with its master, or
      // against it.
      const bool up = (row == 799) != (mirrored == 1);
      EXPECT_NEAR(out.setpoints[4 * row + 3], sign * (x[row] + correction) + 100 + (up ? 0 : -0.004), 1e-7)
          << mirrored << ", row " << row;
    }
  }
}

TEST(VolumetricStage, ACycleAllocatesNothing) {
  auto p = reversal_of_20_um();
  Set set{p};
  set(300000, 2), set(300001, 0.01), set(301030, 1), set(301031, 0), set(301033, 0.01);
  set(302050, 0), set(302051, 2), set(302053, 2), set(302054, 50), set(302080, 1), set(302081, 0);
  set(302083, 1), set(302085, 2), set(302086, 50), set(300110, 1), set(300111, 0.004);
  Channel channel(p);
  stream::StateValues state;
  channel.in.axes = {0, 1, 2};
  channel.in.setpoints = rows_of_x(there_and_back(16));
  channel.in.count = 16;
  const auto batch = [&] {
    channel.core.process(channel.in, {}, channel.out);
    channel.core.save(state);
  };
  batch();  // the first one reserves what it needs
  const auto before = testing_support::allocations;
  for (int i = 0; i < 10; ++i) batch();
  EXPECT_EQ(testing_support::allocations, before);
}

TEST(VolumetricStage, ItsValuesCountAgainstTheMaximum) {
  auto p = reversal_of_20_um();
  p.values[910] = {23, ""};
  CompensationCore core;
  EXPECT_THROW(core.configure(p, 0), machine::KinematicsError);
  p.values[910] = {24, ""};
  core.configure(p, 0);
}

}  // namespace
}  // namespace trunnion::compensation
