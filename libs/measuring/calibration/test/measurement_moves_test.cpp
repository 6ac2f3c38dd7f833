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

// mm between the centres of ball and sphere on a way of the bench, at the nearest.
double nearest_on(const Bench& bench, const Way& way) {
  const auto chain = geometry::make(bench.machine.measured.model);
  double nearest = 1e9;
  for (std::size_t i = 1; i < way.size(); ++i)
    for (int part = 0; part <= 100; ++part) {
      AxisPosition at{};
      for (std::size_t k = 0; k < at.size(); ++k)
        at[k] = way[i - 1][k] + part / 100.0 * (way[i][k] - way[i - 1][k]);
      Angles angles{};
      std::copy(at.begin() + 3, at.end(), angles.begin());
      const Vec3 tip = chain.tip_from_machine(Vec3(at[0], at[1], at[2]), angles, bench.inputs.probe_length);
      nearest = std::min(nearest, (tip - bench.inputs.sphere).norm());
    }
  return nearest;
}
// X, Y and Z with the ball beside the centre of the sphere by this, all rotary axes at zero.
AxisPosition beside_sphere(const Bench& bench, const Vec3& beside) {
  const Vec3 centre = geometry::make(bench.machine.measured.model)
                          .machine_from_tip(bench.inputs.sphere, Angles{}, bench.inputs.probe_length);
  const Vec3 at = centre + beside;
  return {at.x(), at.y(), at.z()};
}

// The sphere may be anywhere in the confidence range: to the next pose the ball keeps that much more away
// from it.
TEST(MeasurementMoves, KeepOutOfTheConfidenceRangeOnTheWay) {
  Bench bench(2);
  bench.inputs.confidence_range = 4;
  const double reach = (bench.inputs.sphere_diameter + bench.inputs.ball_diameter) / 2;
  // From 40 mm beside the sphere to 40 mm on its other side: the straight way passes it by 3 mm.
  const auto way = bench.moves().way(beside_sphere(bench, Vec3(-40, 0, reach + 3)),
                                     beside_sphere(bench, Vec3(40, 0, reach + 3)));
  EXPECT_GT(nearest_on(bench, way), reach + 4);
}

// With a ball of 12 mm the clearance of the bodies is the whole 1 mm by which the ball over the pole is
// outside of the confidence range. The straight way from there to 40 mm beside passes 21.3 mm from the centre
// of the sphere, which is 2.8 mm from its surface.
TEST(MeasurementMoves, KeepOutOfTheConfidenceRangeFromTheApproachPositionOfALargeBallOn) {
  Bench bench(4, 12);
  bench.inputs.confidence_range = 4;
  const double reach = (bench.inputs.sphere_diameter + bench.inputs.ball_diameter) / 2;
  const auto way = bench.moves().way(beside_sphere(bench, Vec3(0, 0, reach + standoff(bench.inputs))),
                                     beside_sphere(bench, Vec3(40, 0, 5)));
  EXPECT_GT(nearest_on(bench, way), reach + 4);
}

}  // namespace
}  // namespace trunnion::calibration
