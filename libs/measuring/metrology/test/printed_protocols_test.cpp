// SPDX-License-Identifier: Apache-2.0
// The four protocols that the manual of CYCLE9960 (A650) prints, recomputed from their residuals. The place
// of the sphere is not printed; its direction from the axis (a multiple of 90 degrees) and its distance are
// those with which all digits agree. A correction is the negative shift of the circle, across the axis.
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "geometry/angle.hpp"
#include "metrology/axis_of_rotation.hpp"
#include "metrology/chain_vectors.hpp"

namespace trunnion::metrology {
namespace {

struct Row {
  double angle;
  Vec3 difference;
};

// The correction across the axis for a sphere at `arm` from it.
Vec3 correction(const Vec3& direction, const Vec3& arm, const std::vector<Row>& rows) {
  std::vector<TurnedCentre> centres;
  for (const auto& row : rows)
    centres.push_back(
        {row.angle,
         Eigen::AngleAxisd(row.angle * geometry::radians_per_degree, direction.normalized()) * arm +
             row.difference});
  const Vec3 shift = std::get<AxisFit>(fit_axis(centres)).centre;
  return -(shift - direction.normalized() * direction.normalized().dot(shift));
}

// Residuals are printed to 1e-5 mm and a circle's centre is at most 1.15 times their change: 2e-5 mm.
constexpr double printed = 2.1e-5;

void expect_near(const Vec3& value, const Vec3& expected, double tolerance) {
  EXPECT_LT((value - expected).cwiseAbs().maxCoeff(), tolerance) << value.transpose();
}

TEST(PrintedProtocol, MixedKinematicsWithAnInclinedHeadAxis) {
  const Vec3 active(0, 0, 15);
  const Vec3 across = correction(
      {0, 1, 1}, {0, 150, -150},
      {{0, {0, 0, 0}}, {90, {-0.36203, -0.25174, -0.21111}}, {180, {-0.00002, -0.28886, 0.05073}}});
  expect_near(*normalized(active + across, {0, 1, 1}, {6, 0}, active), {0.24197, 0.16979, 15}, printed);
  expect_near(
      correction(
          {0, 0, -1}, {-100, 0, 0},
          {{0, {0, 0, 0}}, {120, {0.00940, -0.01503, -0.28885}}, {240, {-0.01505, 0.00945, -0.28886}}}),
      {0.00808, -0.00427, 0}, printed);
}

TEST(PrintedProtocol, TableKinematics) {
  // The residuals at -90 and -45 are the same; they are large for a circle of 55 mm, so second order counts.
  const Vec3 a =
      correction({-1, 0, 0}, {0, 0, -55},
                 {{0, {0, 0, 0}}, {-90, {0.00887, 0.01775, -0.29568}}, {-45, {0.00887, 0.01775, -0.29568}}});
  expect_near(a, {0, -0.51895, 0.50309}, 2.5e-4);
  const Vec3 c = correction(
      {0, 0, -1}, {-200, 0, 0},
      {{0, {0, 0, 0}}, {120, {0.03119, -0.02522, -0.29567}}, {240, {-0.02522, 0.03118, -0.29568}}});
  expect_near(c, {0.01534, -0.01928, 0}, printed);
  // From the root: A first, C from A; the component along each axis is kept.
  const Vec3 printed_a(0, -0.51895, 0.50309);
  expect_near(*normalized(c - printed_a, {0, 0, -1}, {6, 0}, Vec3::Zero()), {0.01534, 0.49967, 0}, printed);
}

TEST(PrintedProtocol, HeadKinematics) {
  const Vec3 spindle =
      correction({1, 0, 0}, {0, 0, -300},
                 {{0, {0, 0, 0}}, {-90, {0.00049, -0.45370, 0.10699}}, {90, {-0.02832, 0.58650, 0.07916}}});
  expect_near(spindle, {0, -0.06642, -0.52038}, 3e-5);
  // C turned with A at 90: the circle moved by the negative sum of both corrections, and it became larger by
  // the sum of what C carries: C to A, and A to the spindle, turned by A.
  const std::vector<Row> rows{{0, {-0.02830, 0.58650, 0.07917}},
                              {120, {-0.79923, -0.58230, 0.06834}},
                              {240, {0.93802, -0.34191, -0.14093}}};
  const Vec3 both = correction({0, 0, 1}, {0, 300, 0}, rows);
  // X (-0.01408 printed) does not follow from the residuals: half of the residual of A at 90 in X is there
  // instead, which a turn of C does not have.
  EXPECT_NEAR((both - spindle).y(), 0.33105, 5e-5);
  std::vector<TurnedCentre> centres;
  for (const auto& row : rows)
    centres.push_back({row.angle, Eigen::AngleAxisd(row.angle * geometry::radians_per_degree, Vec3::UnitZ()) *
                                          Vec3(0, 300, 0) +
                                      row.difference});
  EXPECT_NEAR(std::get<AxisFit>(fit_axis(centres)).radius - 300, 0.851, 1e-3);
}

TEST(PrintedProtocol, OneRotaryAxis) {
  // 270 and 90 degrees: Y is half of the sum of both. The printed Z (-0.44553) does not follow from the
  // residuals; the call has 6 points, the protocol 3.
  const Vec3 a =
      correction({-1, 0, 0}, {0, 0, -200},
                 {{0, {0, 0, 0}}, {270, {-0.00105, 0.03140, -0.29567}}, {90, {-0.00368, 0.03398, -0.29567}}});
  EXPECT_NEAR(a.y(), -0.03266, 5e-5);
  EXPECT_NEAR(std::abs(a.z()), 0.0013, 5e-4) << "not 0.44553";
}

}  // namespace
}  // namespace trunnion::metrology
