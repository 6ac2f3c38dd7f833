// SPDX-License-Identifier: Apache-2.0
#include "calibration/measurement_moves.hpp"

#include <gmock/gmock.h>

#include <algorithm>

#include "geometry/test/machines.hpp"
#include "testing_support/refusal.hpp"
#include "true_machine.hpp"

namespace trunnion::calibration {
namespace {

// The sphere of the inputs among no other bodies.
struct Bench {
  TrueMachine machine{geometry::ac_table(), geometry::ac_table()};
  MeasurementInputs inputs = default_inputs(machine.measured);

  explicit Bench(double measuring_path, double ball = 6) {
    inputs.sphere = Vec3(-120, -130, -420);
    inputs.probe_length = 150;
    inputs.measuring_path = measuring_path;
    inputs.ball_diameter = ball;
  }
  MeasurementMoves moves() const {
    return {
        collision::parse_bodies("", "bodies.yaml", machine.measured.model), {}, {}, inputs, machine.measured};
  }
  PlannedPose first() const {
    return std::get<MeasurementPlan>(plan_measurement(inputs, machine.measured)).poses.front();
  }
};

// The stylus has 0.6 of the ball's radius: 3 - 1.8 = 1.2 mm are left, of which 0.02 mm are margin. A quarter
// of the path behind the surface and another quarter as clearance: 2 x 1.18 = 2.36 mm.
TEST(MeasurementMoves, NameTheLongestMeasuringPathOfTheBall) {
  EXPECT_EQ(
      testing_support::refusal_of([] { Bench(3).moves(); }),
      "measuring_path_mm 3 mm is above 2.36 mm: with a ball of 6 mm the stylus of 3.6 mm would come too "
      "near to the sphere at the end of a touch; shorten the measuring path or use a larger ball");
  EXPECT_THAT(testing_support::refusal_of([] { Bench(2, 4).moves(); }),
              testing::HasSubstr("is above 1.56 mm: with a ball of 4 mm"));
}

TEST(MeasurementMoves, TheLongestMeasuringPathIsFree) {
  for (const auto& [path, ball] : {std::pair{2.355, 6.0}, {1.555, 4.0}}) {
    const Bench bench(path, ball);
    EXPECT_EQ(bench.moves().fault_at(bench.first()), "");
  }
}

// The sphere may be anywhere in the confidence range: to the next pose the ball keeps that much more away
// from it.
TEST(MeasurementMoves, KeepOutOfTheConfidenceRangeOnTheWay) {
  Bench bench(2);
  bench.inputs.confidence_range = 4;
  const auto moves = bench.moves();
  const auto chain = geometry::make(bench.machine.measured.model);
  const double reach = (bench.inputs.sphere_diameter + bench.inputs.ball_diameter) / 2;
  // From 40 mm beside the sphere to 40 mm on its other side: the straight way passes it by 3 mm.
  AxisPosition from{}, to{};
  const Vec3 centre = chain.machine_from_tip(bench.inputs.sphere, {}, bench.inputs.probe_length);
  from[0] = centre.x() - 40, to[0] = centre.x() + 40;
  from[1] = to[1] = centre.y();
  from[2] = to[2] = centre.z() + reach + 3;
  double nearest = 1e9;
  const auto way = moves.way(from, to);
  for (std::size_t i = 1; i < way.size(); ++i)
    for (int part = 0; part <= 100; ++part) {
      Vec3 ball = Vec3::Zero();
      for (std::size_t k = 0; k < 3; ++k)
        ball[static_cast<int>(k)] = way[i - 1][k] + part / 100.0 * (way[i][k] - way[i - 1][k]);
      Angles angles{};
      for (std::size_t k = 0; k < angles.size(); ++k)
        angles[k] = way[i - 1][3 + k] + part / 100.0 * (way[i][3 + k] - way[i - 1][3 + k]);
      const Vec3 tip = chain.tip_from_machine(ball, angles, bench.inputs.probe_length);
      nearest = std::min(nearest, (tip - bench.inputs.sphere).norm());
    }
  EXPECT_GT(nearest, reach + 4);
}

}  // namespace
}  // namespace trunnion::calibration
