// SPDX-License-Identifier: Apache-2.0
// Machines of grade "new machine", drawn by a seed: RTCP with a sphere before and after the measurement.
#include <gtest/gtest.h>

#include "calibration/evaluation.hpp"
#include "calibration/sphere_check.hpp"
#include "machine/chain_parameters.hpp"
#include "machine/kinematics.hpp"
#include "machine/machine.hpp"
#include "true_machine.hpp"
#include "truth/random_machine.hpp"
#include "truth/truth_file.hpp"

namespace trunnion::calibration {
namespace {

// A head swings the tool's arm of 300 mm, so X, Y and Z move far and show their own errors, which no vector
// of the chain describes: over more than 45 degrees some seeds have 25 to 33 um.
struct Case {
  const char* machine;
  Vec3 sphere;    // mm
  double swivel;  // deg to either side
};

class NewMachines : public testing::TestWithParam<Case> {};

TEST_P(NewMachines, TheSphereCheckIsWithin20MicrometresAfterIt) {
  machine::Parameters parameters;
  parameters.values = machine::machine_parameters(
      machine::load_machine(std::string(TRUNNION_SOURCE) + "/configs/machines/" + GetParam().machine));
  const auto outline = machine::outline_of(parameters, 0);
  const MeasuredMachine measured{GetParam().machine, machine::chain_parameters(parameters, 0), outline};
  auto in = default_inputs(measured);
  in.sphere = GetParam().sphere;
  in.probe_length = 60;
  in.write_directions = true;
  in.further_poses = 60;
  for (auto& range : in.axes)
    if (range.angle == 2)
      range.other = 30;
    else
      range.start = -GetParam().swivel, range.end = GetParam().swivel;
  const auto& grade = *std::find_if(truth::grades().begin(), truth::grades().end(),
                                    [](const auto& g) { return g.name == "new_machine"; });
  double before_all = 0, after_all = 0, worst = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const truth::PoseReport report(
        truth::make_geometry(truth::draw_machine(grade, seed, outline), outline, "drawn"),
        machine::make_chain(parameters, 0), outline);
    const auto plan = plan_measurement(in, measured);
    ASSERT_TRUE(std::holds_alternative<MeasurementPlan>(plan)) << std::get<std::string>(plan);
    touch_probe::TouchProbeTruth probe;
    probe.repeatability = 0.0005;
    probe.seed = seed;
    const auto result = evaluate(in, measured,
                                 touch_virtually(report, in, measured, std::get<MeasurementPlan>(plan),
                                                 nominal(in, probe), sphere_at(in, in.sphere)));
    const auto poses = random_check_poses(measured, in.axes, in.sphere, in.probe_length, 200, seed);
    ASSERT_EQ(poses.size(), 200u);
    const auto check = [&](const ChainParameters& model) {
      return summary_of(sphere_displacements(report, model, in.sphere, in.probe_length, poses));
    };
    const auto before = check(result.before), after = check(result.after);
    worst = std::max(worst, after.largest.maxCoeff());
    EXPECT_LT(after.largest.maxCoeff(), 0.020)
        << GetParam().machine << ", seed " << seed << ": " << after.largest.transpose();
    before_all += before.root_mean_square, after_all += after.root_mean_square;
  }
  std::printf("%s: root mean square %.1f -> %.1f um, factor %.1f; largest after it %.1f um\n",
              GetParam().machine, 50 * before_all, 50 * after_all, before_all / after_all, 1e3 * worst);
  EXPECT_GT(before_all, 2 * after_all);
}

INSTANTIATE_TEST_SUITE_P(Machines, NewMachines,
                         testing::Values(Case{"ac-table", {60, 40, -360}, 90},
                                         Case{"bc-table", {60, 40, -360}, 90},
                                         Case{"cb-head", {0, 0, -200}, 45}, Case{"ac-head", {0, 0, -200}, 45},
                                         Case{"b-head-c-table", {60, 40, -250}, 60},
                                         Case{"nutating-b-head-c-table", {60, 40, -250}, 60},
                                         Case{"four-axis", {60, 40, -360}, 90}),
                         [](const auto& machine) {
                           std::string name = machine.param.machine;
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

}  // namespace
}  // namespace trunnion::calibration
