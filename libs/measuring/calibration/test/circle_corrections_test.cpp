// SPDX-License-Identifier: Apache-2.0
// The corrections that the manual of CYCLE9960 (A650) prints, from the differences that it prints. It says
// nothing of the place of the sphere: the machines here have the distances with which all digits agree.
#include "calibration/circle_corrections.hpp"

#include <gmock/gmock.h>

#include "calibration/protocol.hpp"
#include "geometry/test/machines.hpp"
#include "true_machine.hpp"

namespace trunnion::calibration {
namespace {

constexpr std::size_t a = 0, b = 1, c = 2;
// Differences are printed to 1e-5 mm and a circle's centre is at most 1.15 times their change: 2e-5 mm.
constexpr double printed = 2.1e-5;

struct Row {
  double angle;
  Vec3 difference;
};

std::vector<CircleCentre> on_circle(std::size_t axis, const Angles& others, const std::vector<Row>& rows) {
  std::vector<CircleCentre> centres;
  for (const auto& row : rows) {
    auto& centre = centres.emplace_back();
    centre.angles = others;
    centre.angles[axis] = row.angle;
    centre.difference = row.difference;
  }
  return centres;
}

AxisRange kept(std::size_t axis, int normalization) {
  AxisRange range;
  range.angle = axis;
  range.normalization = normalization;
  return range;
}

std::vector<ChainCorrection> corrections(const ChainParameters& model, const Vec3& sphere,
                                         double probe_length, const std::vector<AxisRange>& axes,
                                         const std::map<std::size_t, std::vector<CircleCentre>>& centres) {
  MeasurementInputs in;
  in.probe_length = probe_length;
  in.axes = axes;
  return circle_corrections(model, in, geometry::make(model).machine_from_tip(sphere, {}, probe_length),
                            centres);
}

void expect(const ChainCorrection& found, const std::string& name, const Vec3& value, double tolerance) {
  EXPECT_EQ(found.name, name);
  EXPECT_LT((found.circles - value).cwiseAbs().maxCoeff(), tolerance)
      << name << ": " << found.circles.transpose();
}

TEST(CircleCorrections, PrintedProtocolOfMixedKinematics) {
  ChainParameters model;
  // Across B the ball is where 300 mm along the tool would put it; the sphere is 100 mm from C.
  model.head_2 = geometry::RotaryAxis{Vec3(0, 1, 1), Vec3(0, -60, 145), b, Vec3(0, 0, -15)};
  model.table_2 = geometry::RotaryAxis{Vec3(0, 0, -1), Vec3(10, 20, 0), c};
  const auto found = corrections(
      model, {-90, 20, -330}, 110, {kept(b, 6), kept(c, 6)},
      {{b, on_circle(
               b, {},
               {{0, {0, 0, 0}}, {90, {-0.36203, -0.25174, -0.21111}}, {180, {-0.00002, -0.28886, 0.05073}}})},
       {c,
        on_circle(
            c, {},
            {{0, {0, 0, 0}}, {120, {0.00940, -0.01503, -0.28885}}, {240, {-0.01505, 0.00945, -0.28886}}})}});
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0].before, Vec3(0, 0, 15));
  expect(found[0], "CORR_SP1_OFFSET", {0.24197, 0.16979, 15}, printed);
  expect(found[1], "CORR_C_OFFSET", {0.00808, -0.00427, 0}, printed);
}

TEST(CircleCorrections, PrintedProtocolOfTableKinematics) {
  ChainParameters model;
  model.table_1 = geometry::RotaryAxis{Vec3(-1, 0, 0), Vec3::Zero(), a};
  model.table_2 = geometry::RotaryAxis{Vec3(0, 0, -1), Vec3(0, 0, -400), c};
  const auto found = corrections(
      model, {-200, 0, -455}, 150, {kept(a, 4), kept(c, 6)},
      {{a, on_circle(
               a, {},
               {{0, {0, 0, 0}}, {-90, {0.00887, 0.01775, -0.29568}}, {-45, {0.00887, 0.01775, -0.29568}}})},
       {c,
        on_circle(
            c, {},
            {{0, {0, 0, 0}}, {120, {0.03119, -0.02522, -0.29567}}, {240, {-0.02522, 0.03118, -0.29568}}})}});
  ASSERT_EQ(found.size(), 2u);
  // The differences of A are large for a circle of 55 mm: the second order, which depends on the place of the
  // sphere, is up to 0.3^2 / 55 = 1.6e-3 mm.
  expect(found[0], "CORR_A_OFFSET", {0, -0.51895, 0.50309}, 2.5e-4);
  expect(found[1], "CORR_C_OFFSET", {0.01534, 0.49967, 0}, 2.5e-4);
}

TEST(CircleCorrections, PrintedProtocolOfHeadKinematics) {
  ChainParameters model;
  model.head_1 = geometry::RotaryAxis{Vec3(0, 0, 1), Vec3::Zero(), c};
  model.head_2 = geometry::RotaryAxis{Vec3(1, 0, 0), Vec3(0, 0, 150), a};
  Angles swung{};
  swung[a] = 90;
  const auto found = corrections(
      model, {200, 0, -250}, 150, {kept(c, 6), kept(a, 4)},
      {{c, on_circle(c, swung,
                     {{0, {-0.02830, 0.58650, 0.07917}},
                      {120, {-0.79923, -0.58230, 0.06834}},
                      {240, {0.93802, -0.34191, -0.14093}}})},
       {a, on_circle(
               a, {},
               {{0, {0, 0, 0}}, {-90, {0.00049, -0.45370, 0.10699}}, {90, {-0.02832, 0.58650, 0.07916}}})}});
  ASSERT_EQ(found.size(), 2u);
  // X of CORR_A_OFFSET (-0.01408 printed) does not follow from the differences.
  EXPECT_EQ(found[0].name, "CORR_A_OFFSET");
  EXPECT_NEAR(found[0].circles.y(), 0.33105, 5e-5);
  EXPECT_NEAR(found[0].circles.z(), 0, 1e-9);
  expect(found[1], "CORR_SP1_OFFSET", {0, -0.06642, -0.52038}, 3e-5);
}

TEST(CircleCorrections, CentresOnALineGiveNone) {
  const auto model = geometry::a_table();
  EXPECT_THAT(corrections(model, {-200, 0, -455}, 150, {kept(a, 4)}, {}), testing::IsEmpty());
  EXPECT_THAT(corrections(model, {0, 5, -300}, 150, {kept(a, 4)},
                          {{a, on_circle(a, {}, {{0, {0, 0, 0}}, {90, {0, 1, 0}}, {180, {0, 2, 0}}})}}),
              testing::IsEmpty())
      << "the sphere is on the axis";
}

// Without noise and with ideal directions the circles and the fit of all poses find the same vectors,
// wherever the other axis is.
TEST(CircleCorrections, AreThoseOfAllPosesOnAMachineWithIdealDirections) {
  for (const auto& real : {geometry::ac_table(), geometry::cb_head(), geometry::nutating_b_head_c_table()}) {
    auto model = real;
    for (const auto slot : metrology::all_slots)
      if (auto& axis = axis_at(model, slot)) axis->offset += Vec3(0.1, -0.2, 0.15);
    const TrueMachine machine(real, model);
    auto in = default_inputs(machine.measured);
    in.sphere = Vec3(60, 80, -300);
    in.probe_length = 150;
    in.confidence_range = in.measuring_path = 3;
    for (auto& range : in.axes)
      for (const auto& vector : metrology::root_vectors(model)) {
        if (vector.angle != range.angle) continue;
        Eigen::Index component = 0;
        axis_at(model, vector.slot)->direction.cwiseAbs().maxCoeff(&component);
        range.other = 30;
        range.normalization = 4 + static_cast<int>(component);
      }
    const auto result = machine.measure(in, {}, in.sphere);
    ASSERT_EQ(result.corrections.size(), 2u);
    for (const auto& one : result.corrections) {
      EXPECT_GT((one.all_poses - one.before).norm(), 0.1) << one.name << ": the start was wrong";
      EXPECT_LT((one.circles - one.all_poses).norm(), 1e-5) << one.name;
    }
  }
}

TEST(CircleCorrections, TheProtocolCountsTheHeadOfMixedKinematicsFirst) {
  const TrueMachine machine(geometry::b_head_c_table(), geometry::b_head_c_table());
  auto in = default_inputs(machine.measured);
  in.sphere = Vec3(60, 80, -300);
  in.probe_length = 150;
  const auto text = protocol_text({}, in, machine.measured, machine.measure(in, {}, in.sphere));
  for (const char* part : {"Rotary axis 1   : B", "Rotary axis 2   : C", "CORR_SP1_OFFSET circles",
                           "CORR_C_OFFSET all poses", "B90 C0"})
    EXPECT_THAT(text, testing::HasSubstr(part));
}

}  // namespace
}  // namespace trunnion::calibration
