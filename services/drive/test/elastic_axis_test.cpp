// SPDX-License-Identifier: Apache-2.0
// Axes whose mechanics and encoders truth.yaml describes.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "circular_tests/ballbar_causes.hpp"
#include "simulated_hardware.hpp"
#include "snapshot/fields.hpp"
#include "truth/ballbar.hpp"
#include "two_axes.hpp"

namespace trunnion::drive::elastic_axis_test {
namespace {

// An axis with the feed-forward that the executor gives it.
struct Axis : SimulatedAxis {
  explicit Axis(const truth::DriveTruth* truth, double at = 0, const ServoParameters& parameters = {}) {
    configure(parameters, truth);
    place(at);
    setpoint.position = command();
  }
  void to(double position) {
    const double velocity = (position - setpoint.position) / 0.001;
    setpoint = {position, velocity, (velocity - setpoint.velocity) / 0.001};
    step(setpoint, 0.001);
  }
  void by(double distance, double speed) {
    const double from = setpoint.position;
    const int periods = static_cast<int>(std::round(std::abs(distance) / speed * 1000));
    for (int i = 1; i <= periods; ++i) to(from + distance * i / periods);
    for (int i = 0; i < 500; ++i) to(from + distance);
  }
  AxisSetpoint setpoint;
};

truth::DriveTruth elastic() {
  truth::DriveTruth truth;
  truth.mechanics.emplace();
  truth.mechanics->locked_frequency = 120;
  truth.mechanics->damping_ratio = 0.1;
  truth.mechanics->coulomb = truth.mechanics->breakaway = 0.03;
  return truth;
}

ServoParameters full_closed() {
  ServoParameters p;
  p.full_closed_loop = true;
  return p;
}

TEST(ElasticAxis, WithTheMotorsEncoderTheLoadIsBackByTheBacklash) {
  auto truth = elastic();
  truth.mechanics->backlash = 0.02;
  Axis axis(&truth);
  double x = 0;
  const auto move = [&](double speed) {
    for (int i = 0; i < 500; ++i) axis.to(x += speed * 0.001);
    return axis.load() - axis.encoder();
  };
  // In motion, when friction has brought the load to its flank. In the spring it leaves
  // 2 * 0.03 * 4500 / (0.5 * (2 pi 120)^2) = 0.00095 mm.
  const double up = move(20);
  EXPECT_NEAR(move(-20) - up, 0.02 + 0.00095, 5e-5);
}

TEST(ElasticAxis, WithAScaleTheLoadArrivesInSpiteOfScrewErrorAndWeight) {
  auto truth = elastic();
  truth.mechanics->coulomb = truth.mechanics->breakaway = 0;
  truth.mechanics->screw.terms.polynomials.push_back({0, 1000, {0, 0.5}});
  truth.mechanics->gravity = 0.2;
  truth.load.emplace();
  Axis semi(&truth);
  Axis full(&truth, 0, full_closed());
  semi.by(100, 50);
  full.by(100, 50);
  EXPECT_NEAR(full.load(), 100, 2e-4);
  // 0.5 mm/m over 0.1 m, and the spring under the weight: 0.2 * 4500 / (0.5 * (2 pi 120)^2) = 0.00317 mm.
  const double deflection = 0.2 * 4500 / (0.5 * std::pow(240 * std::numbers::pi, 2));
  EXPECT_NEAR(semi.load() - 100, 0.05 - deflection, 2e-4);
}

TEST(ElasticAxis, AScaleMountedTheWrongWayRoundRunsAway) {
  auto truth = elastic();
  truth.load.emplace();
  truth.load->inverted = true;
  Axis axis(&truth, 1, full_closed());
  EXPECT_NEAR(axis.encoder(), -1, 1e-4);
  for (int i = 0; i < 300; ++i) axis.to(-1.01);
  EXPECT_GT(std::abs(axis.encoder() + 1.01), 0.1) << "the position loop drives away from its setpoint";
}

TEST(ElasticAxis, AnIncrementalEncoderHasNoReferenceUntilItIsGivenOne) {
  auto truth = elastic();
  truth.motor.kind = truth::EncoderKind::incremental;
  Axis axis(&truth, 30);
  EXPECT_FALSE(axis.homed());
  EXPECT_EQ(axis.encoder(), 0);
  axis.set_reference(30);
  EXPECT_TRUE(axis.homed());
  EXPECT_EQ(axis.encoder(), 30);
  EXPECT_EQ(axis.command(), 30);
  EXPECT_NEAR(axis.load(), 30, 1e-9) << "the axis itself has not moved";
}

// A circle of both axes at constant speed after a run-up, seen by a ballbar.
circular_tests::BallbarCauses ballbar(SimulatedAxis& x, SimulatedAxis& y, double radius, double speed) {
  truth::BallbarPath path;
  path.centre = {-radius, 0, 0};
  path.radius = radius;
  std::vector<circular_tests::RadialReading> circles[2];
  const double turn = 2 * std::numbers::pi * radius / speed;  // s
  path.points = static_cast<std::size_t>(std::round(turn * 1000));
  AxisSetpoint sx, sy;
  for (const int sense : {1, -1}) {
    x.place(0), y.place(0);
    sx = sy = {};
    for (std::size_t n = 1; n <= 2 * path.points; ++n) {
      const double t = static_cast<double>(n) * 0.001;
      // The angular speed rises over half a turn's time.
      const double rise = turn / 2,
                   angle = sense * speed / radius * (t < rise ? t * t / rise / 2 : t - rise / 2);
      const auto to = [](SimulatedAxis& axis, AxisSetpoint& s, double position) {
        const double velocity = (position - s.position) / 0.001;
        s = {position, velocity, (velocity - s.velocity) / 0.001};
        axis.step(s, 0.001);
      };
      to(x, sx, radius * (std::cos(angle) - 1));
      to(y, sy, radius * std::sin(angle));
      if (n <= path.points) continue;
      circles[sense < 0].push_back(
          {angle * 180 / std::numbers::pi, truth::ballbar_deviation(path, {x.load(), y.load(), 0})});
    }
  }
  return circular_tests::ballbar_causes(circles[0], circles[1], path.radius);
}

TEST(Ballbar, SeesTheMismatchOfTheGainsOfTwoServoAxes) {
  ServoParameters px, py;
  px.velocity_feedforward = py.velocity_feedforward = 0;
  px.acceleration_feedforward = py.acceleration_feedforward = 0;
  px.position_gain = 50, py.position_gain = 40;
  SimulatedAxis x, y;
  x.configure(px), y.configure(py);
  // 20 mm/s on a radius of 100 mm: 20 * (1/50 - 1/40) = -0.1 mm. The lag of w / Kv = 0.5 % leaves a part of
  // second order.
  const auto found = ballbar(x, y, 100, 20);
  EXPECT_NEAR(found.lag_mismatch, -0.1, 0.02 * 0.1);
  EXPECT_NEAR(found.squareness, 0, 1e-6);
}

TEST(Ballbar, SeesTheBacklashOfAnAxisWithTwoMasses) {
  auto truth = elastic();
  truth.mechanics->backlash = 0.02;
  SimulatedAxis x, y;
  x.configure({}, &truth), y.configure({});
  const auto found = ballbar(x, y, 100, 20);
  // With the 0.00095 mm that friction leaves in the spring; 2 % of it, and the load that crosses the gap a
  // little later.
  EXPECT_NEAR(found.reversal_first, 0.02 + 0.00095, 0.02 * 0.021);
  EXPECT_NEAR(found.reversal_second, 0, 1e-3);
}

struct NoRows : EncoderRowSink {
  void skip_edge(std::uint64_t, const idl::stream::SkipEdge&) override {}
  void encoder_row(const EncoderRow&) override {}
};

std::vector<machine::AxisInfo> axes() {
  const auto parameters = two_axes();
  return machine::drive_axes(parameters);
}

void periods(SimulatedHardware& hardware, std::uint64_t from, std::uint64_t to, DriveStatus& status) {
  NoRows rows;
  SetpointRow row;
  row.enable = row.controlled = true;
  row.axes.resize(2);
  for (row.number = from; row.number < to; ++row.number) {
    const double t = static_cast<double>(row.number) * 0.001;
    row.axes[0] = {5 * std::sin(3 * t), 15 * std::cos(3 * t), -45 * std::sin(3 * t)};
    row.axes[1] = {2 * t, 2, 0};
    hardware.exchange(row, status, rows);
  }
}

SimulatedHardware made(bool with_truth) {
  auto truth = elastic();
  truth.mechanics->backlash = 0.01;
  truth.mechanics->breakaway = 0.05;
  truth.load.emplace();
  truth.load->kind = truth::EncoderKind::distance_coded;
  truth.load->first_mark = -300;
  SimulatedHardware hardware(with_truth ? std::map<std::string, truth::DriveTruth>{{"X", truth}}
                                        : std::map<std::string, truth::DriveTruth>{});
  hardware.configure(two_axes(), axes(), {}, 0.001);
  return hardware;
}

TEST(ElasticAxis, ItsStateContinuesToTheBit) {
  auto whole = made(true), first = made(true), second = made(true);
  DriveStatus expected, status;
  periods(whole, 1, 2000, expected);
  periods(first, 1, 777, status);
  second.continue_from(first.explicit_state());
  periods(second, 777, 2000, status);
  EXPECT_EQ(second.explicit_state(), whole.explicit_state());
  EXPECT_EQ(status.axes[0].position, expected.axes[0].position);
}

TEST(ElasticAxis, TheOtherAxesKeepTheirBitsAndTheirState) {
  auto with = made(true), without = made(false);
  DriveStatus a, b;
  periods(with, 1, 1500, a);
  periods(without, 1, 1500, b);
  EXPECT_EQ(with.explicit_state()["servos"][1], without.explicit_state()["servos"][1]);
  EXPECT_FALSE(with.explicit_state()["servos"][0].contains("integral"));
  EXPECT_EQ(without.explicit_state()["servos"][0].size(), 7u) << "no state that recordings do not have";
}

}  // namespace
}  // namespace trunnion::drive::elastic_axis_test
