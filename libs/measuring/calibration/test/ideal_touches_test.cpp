// SPDX-License-Identifier: Apache-2.0
#include "calibration/ideal_touches.hpp"

#include <gmock/gmock.h>

#include <functional>

#include "geometry/test/machines.hpp"
#include "true_machine.hpp"

namespace trunnion::calibration {
namespace {

struct Planned {
  MeasuredMachine machine;
  MeasurementInputs inputs;
  MeasurementPlan plan;
};

// The sphere is some 100 mm beside the axis of C of ac_table().
Planned planned(const ChainParameters& model, const std::function<void(MeasurementInputs&)>& change = {}) {
  Planned out{TrueMachine(model, model).measured, {}, {}};
  out.inputs = default_inputs(out.machine);
  out.inputs.sphere = Vec3(-120, -130, -420);
  out.inputs.probe_length = 150;
  if (change) change(out.inputs);
  EXPECT_EQ(fault_of(out.inputs, out.machine), "");
  out.plan = std::get<MeasurementPlan>(plan_measurement(out.inputs, out.machine));
  return out;
}

std::string fault(const Planned& p) { return evaluation_fault(p.inputs, p.machine, p.plan); }

TEST(IdealTouches, LeaveTheVectorsAsTheyAre) {
  for (const auto& model :
       {geometry::ac_table(), geometry::bc_table(), geometry::skewed_ac_table(), geometry::cb_head()}) {
    const auto p = planned(model);
    EXPECT_EQ(fault(p), "");
    const auto touches = ideal_touches(p.inputs, p.machine, p.plan);
    ASSERT_EQ(touches.size(), p.plan.poses.size());
    const auto result = evaluate(p.inputs, p.machine, touches);
    EXPECT_LT(result.largest_change, 1e-6);
    EXPECT_LT((result.sphere - p.inputs.sphere).norm(), 1e-6);
    for (const auto& pose : result.poses) EXPECT_NEAR(pose.diameter, p.inputs.sphere_diameter, 1e-6);
  }
}

TEST(EvaluationFault, IsKnownBeforeTheFirstTouch) {
  using In = MeasurementInputs;
  EXPECT_THAT(fault(planned(geometry::ac_table(), [](In& in) { in.axes[0].normalization = 5; })),
              testing::HasSubstr("the normalizations do not fix the free components"));
  EXPECT_EQ(fault(planned(geometry::ac_table(), [](In& in) { in.axes[0].normalization = 14; })),
            "normalization: the chain is open for all axes or for none");
  // Four points within 180 degrees: no triangle of them has three angles of 60 degrees.
  EXPECT_THAT(fault(planned(geometry::ac_table(),
                            [](In& in) { in.least_triangle_angle = 60, in.axes[0].points = 4; })),
              testing::HasSubstr("least 60 deg"));
  EXPECT_THAT(fault(planned(geometry::cb_head(),
                            [](In& in) {
                              in.reference = Reference::adapt;
                              in.reference_measurement = ReferenceMeasurement{in.sphere, Vec3(0, 0, 1)};
                            })),
              testing::HasSubstr("is not the one of the reference, 0.0000 0.0000 1.0000 mm"));
}

// What a machine with errors and a probe that scatters shows is not a fault of the inputs: a direction that
// is to be written is known exactly by ideal touches.
TEST(EvaluationFault, IsNoneWhereTheTouchesDecide) {
  EXPECT_EQ(fault(planned(geometry::ac_table(),
                          [](MeasurementInputs& in) {
                            in.write_directions = in.calibrate_probe = true;
                            in.vector_tolerance = 0;
                            in.diameter_tolerance = 0.0001, in.confidence_range = 0.001;
                          })),
            "");
}

// On the axis of C no centre moves but for rounding; the true sphere is beside it and has a circle.
TEST(EvaluationFault, IsNoneOfASphereThatIsExpectedOnTheAxisOfATable) {
  const auto model = geometry::ac_table();
  const auto on_axis = planned(model, [&](MeasurementInputs& in) {
    const Vec3 axis = metrology::axis_point(model, metrology::Slot::table_2);
    in.sphere = Vec3(axis.x(), axis.y(), -420);
  });
  const auto centre = [&](const Vec3& beside) {
    const auto touches = ideal_touches(on_axis.inputs, on_axis.machine, on_axis.plan, beside);
    return evaluate(on_axis.inputs, on_axis.machine, touches).sphere;
  };
  const Vec3 beside(0.3, 0, 0);
  EXPECT_LT((centre(beside) - on_axis.inputs.sphere - beside).norm(), 1e-6);
  EXPECT_EQ(fault(on_axis), "");
}

}  // namespace
}  // namespace trunnion::calibration
