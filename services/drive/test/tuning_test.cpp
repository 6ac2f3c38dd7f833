// SPDX-License-Identifier: Apache-2.0
// Automatic tuning on machines that are drawn by a seed: the manual's limits, and no vibration beyond the
// amplitude.
#include <gtest/gtest.h>

#include "geometry/random_source.hpp"
#include "servo_analysis/contour_figures.hpp"
#include "simulated_bench.hpp"
#include "truth/random_drive.hpp"
#include "two_axes.hpp"

namespace trunnion::drive {
namespace {

using servo_analysis::TuningTask;

// Half of the largest of three strokes in a row that are shorter than half a period of 15 Hz, and larger than
// `noise`: a second way to find it, in all samples, after the motion.
double vibration(const std::vector<double>& setpoint, const std::vector<double>& position, double interval,
                 double noise) {
  std::vector<std::pair<std::size_t, double>> turns;  // place and value of the extremes
  double sign = 0;
  for (std::size_t i = 0; i < setpoint.size(); ++i) {
    const double e = setpoint[i] - position[i];
    if (turns.empty()) turns.push_back({i, e});
    auto& last = turns.back();
    if (sign * (e - last.second) >= 0 && sign != 0) {
      last = {i, e};
    } else if (std::abs(e - last.second) > 2 * noise) {
      sign = e > last.second ? 1 : -1;
      turns.push_back({i, e});
    }
  }
  double largest = 0;
  for (std::size_t i = 3; i < turns.size(); ++i) {
    bool fast = true;
    for (std::size_t k = i - 2; k <= i; ++k)
      fast = fast && static_cast<double>(turns[k].first - turns[k - 1].first) * interval < 0.5 / 15;
    if (fast) largest = std::max(largest, std::abs(turns[i].second - turns[i - 1].second) / 2);
  }
  return largest;
}

struct WatchedAxis : BenchAxis {
  using BenchAxis::BenchAxis;
  servo_analysis::MotionResult move(const servo_analysis::ServoSettings& trial,
                                    const servo_analysis::ServoSettings& fallback, double limit,
                                    const servo_analysis::TestMotion& motion) override {
    auto result = BenchAxis::move(trial, fallback, limit, motion);
    const auto& t = result.trace;
    for (const auto* position : {&t.motor, &t.load})
      worst = std::max(worst, vibration(t.setpoint, *position, t.interval, limit / 5));
    return result;
  }
  double worst = 0;
};

struct Drawn {
  machine::Parameters parameters = two_axes();
  std::map<std::string, truth::DriveTruth> truth;
  TuningTask task;
};

// Every second machine has a scale and full closed loop; the gains are bad ones.
Drawn draw(std::uint64_t seed) {
  Drawn d;
  geometry::RandomSource random(seed);
  const auto set = [&](const auto& key, double low, double high) {
    d.parameters.values[key.number(0)] = {low * std::pow(high / low, random.uniform()), ""};
  };
  set(parameter::load_inertia_ratio, 0.3, 3.3);
  set(parameter::current_time_constant, 0.3, 1.5);
  set(parameter::position_gain, 5, 60);
  set(parameter::speed_gain, 50, 800);
  set(parameter::speed_integral_time, 3, 100);
  machine::MachineOutline machine;
  machine.drives = {"X"};
  d.truth = truth::draw_drives(truth::grades()[seed % truth::grades().size()], seed, machine);
  const bool full = seed % 2 == 0;
  if (full) {
    d.parameters.values[parameter::full_closed_loop.number(0)] = {1, ""};
    d.truth["X"].load.emplace().resolution = 1e-4;
  }
  d.task.current = servo_analysis::ServoSettings::from(d.parameters, 0);
  d.task.amplitude = 0.01;
  d.task.acceleration = 4000, d.task.rated_acceleration = 1.5 * 4000, d.task.highest_feed = 60000;
  d.task.current_time_constant = d.parameters.get(parameter::current_time_constant, 0);
  d.task.full_closed_loop = full;
  return d;
}

TEST(Tuning, ReachesEveryLimitOnTwentyOfTwentyMachinesWithinTheAmplitude) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const auto d = draw(seed);
    SimulatedBench bench(d.parameters, d.truth);
    WatchedAxis axis(bench);
    const auto result = servo_analysis::tune_axis(axis, d.task);
    std::string figures;
    for (const auto& f : result.figures)
      figures += f.name + " " + std::to_string(f.value) + " of " + std::to_string(f.limit) + "\n";
    EXPECT_TRUE(result.reached()) << "machine " << seed << "\n" << figures;
    EXPECT_EQ(result.figures.size(), 8u);
    EXPECT_LE(result.largest_vibration, d.task.amplitude) << "machine " << seed;
    EXPECT_LE(axis.worst, d.task.amplitude) << "machine " << seed;
    // What it identified: the inertia of the parameter within 5 %, Coulomb friction within a quarter (the
    // Stribeck part is in it at the speeds of the identification).
    EXPECT_NEAR(result.inertia, (1 + d.parameters.get(parameter::load_inertia_ratio, 0)) / 2,
                0.05 * result.inertia);
    EXPECT_NEAR(result.coulomb, d.truth.at("X").mechanics->coulomb,
                0.25 * d.truth.at("X").mechanics->coulomb);
    RecordProperty("machine " + std::to_string(seed), std::to_string(axis.worst * 1e3) + " um");
    // The parameters of the drive were never touched.
    EXPECT_FALSE(bench.hardware().tester()->running());
  }
}

TEST(Tuning, TheGainsAreFourFifthsOfTheCriticalOnesWhereTheAxisVibrates) {
  // A weak transmission in full closed loop without backlash: its position gain is limited by 2 zeta w.
  auto d = draw(2);
  d.truth["X"].mechanics->backlash = 0;
  SimulatedBench bench(d.parameters, d.truth);
  BenchAxis axis(bench);
  const auto result = servo_analysis::tune_axis(axis, d.task);
  ASSERT_GT(result.critical_position_gain, 0);
  EXPECT_LE(result.settings.position_gain, 0.8 * result.critical_position_gain * (1 + 1e-9));
  EXPECT_TRUE(result.reached());
}

TEST(Tuning, ASecondTuningGivesTheSameValues) {
  auto d = draw(3);
  SimulatedBench first(d.parameters, d.truth);
  BenchAxis axis(first);
  const auto once = servo_analysis::tune_axis(axis, d.task);
  for (const auto& v : once.settings.values(0)) d.parameters.values[v.number] = {v.value, ""};
  d.task.current = once.settings;
  SimulatedBench second(d.parameters, d.truth);
  BenchAxis again(second);
  const auto twice = servo_analysis::tune_axis(again, d.task);
  EXPECT_NEAR(twice.settings.speed_gain, once.settings.speed_gain, 0.01 * once.settings.speed_gain);
  EXPECT_NEAR(twice.settings.position_gain, once.settings.position_gain, 0.01 * once.settings.position_gain);
}

TEST(Tuning, AnAxisThatAlwaysVibratesIsAFault) {
  struct Vibrating : servo_analysis::AxisUnderTest {
    servo_analysis::MotionResult move(const servo_analysis::ServoSettings&,
                                      const servo_analysis::ServoSettings&, double,
                                      const servo_analysis::TestMotion&) override {
      return {true, 0.01, {}};
    }
  } axis;
  EXPECT_THROW(servo_analysis::tune_axis(axis, draw(1).task), std::runtime_error);
  auto task = draw(1).task;
  task.amplitude = 0;
  EXPECT_THROW(servo_analysis::tune_axis(axis, task), std::runtime_error);
}

}  // namespace
}  // namespace trunnion::drive
