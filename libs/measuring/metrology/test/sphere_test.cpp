// SPDX-License-Identifier: Apache-2.0
#include "metrology/sphere.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "geometry/random_source.hpp"
#include "metrology/student.hpp"

namespace trunnion::metrology {
namespace {

const std::vector<Vec3> equator_and_pole{Vec3::UnitX(), Vec3::UnitY(), -Vec3::UnitX(), -Vec3::UnitY(),
                                         Vec3::UnitZ()};

std::vector<Vec3> touches(const Vec3& centre, double radius, const std::vector<Vec3>& directions) {
  std::vector<Vec3> tips;
  for (const auto& direction : directions) tips.emplace_back(centre + radius * direction.normalized());
  return tips;
}

TEST(Sphere, FourTouchesGiveCentreAndRadiusExactly) {
  const Vec3 centre(-200.3605, -190.1897, -516.0118);
  // The manual of HNC-8 touches near the apex and three times on the equator, 90 degrees apart.
  const auto fit = std::get<SphereFit>(
      fit_sphere(touches(centre, 15.5, {{0.1, 0.05, 1}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}})));
  EXPECT_LT((fit.centre - centre).norm(), 1e-10);
  EXPECT_NEAR(fit.radius, 15.5, 1e-10);
  EXPECT_EQ(fit.freedom, 0u);
}

TEST(Sphere, WithAKnownRadiusFourTouchesHaveOneMoreThanTheyNeed) {
  const Vec3 centre(10, 20, 30);
  const auto fit = std::get<SphereFit>(fit_sphere(touches(centre, 15.5, equator_and_pole), 15.5));
  EXPECT_LT((fit.centre - centre).norm(), 1e-11);
  EXPECT_EQ(fit.freedom, 2u);
  EXPECT_EQ(fit.radius_cofactor, 0);
}

TEST(Sphere, TheCofactorsOfEquatorAndPoleAreThoseOfTheirNormals) {
  // Two touches see X, two see Y, one sees Z: 1/2, 1/2, 1. With an unknown radius the four of the equator
  // give it to 1/4, and Z has the variance of the pole and of the radius: 5/4.
  const auto known = std::get<SphereFit>(fit_sphere(touches({0, 0, 0}, 10, equator_and_pole), 10));
  EXPECT_LT((known.cofactor - Vec3(0.5, 0.5, 1).asDiagonal().toDenseMatrix()).norm(), 1e-12);
  const auto free = std::get<SphereFit>(fit_sphere(touches({0, 0, 0}, 10, equator_and_pole)));
  EXPECT_NEAR(free.cofactor(2, 2), 1.25, 1e-12);
  EXPECT_NEAR(free.radius_cofactor, 0.25, 1e-12);
}

TEST(Sphere, TheSpreadOfNoisyCentresIsTheCofactor) {
  geometry::RandomSource random(11);
  constexpr double noise = 0.002;
  constexpr int runs = 2000;
  Vec3 squares = Vec3::Zero();
  for (int i = 0; i < runs; ++i) {
    auto tips = touches({5, -7, 9}, 15.5, equator_and_pole);
    for (auto& tip : tips) tip += noise * random.normal() * (tip - Vec3(5, -7, 9)).normalized();
    squares += (std::get<SphereFit>(fit_sphere(tips, 15.5)).centre - Vec3(5, -7, 9)).cwiseAbs2() / runs;
  }
  // A variance from 2000 values has a relative standard deviation of sqrt(2 / 2000) = 3 %; four of them.
  EXPECT_NEAR(squares.x(), 0.5 * noise * noise, 0.13 * 0.5 * noise * noise);
  EXPECT_NEAR(squares.z(), 1.0 * noise * noise, 0.13 * noise * noise);
}

TEST(Sphere, AConstantPreTravelChangesTheRadiusAndNotTheCentre) {
  const auto fit = std::get<SphereFit>(fit_sphere(touches({1, 2, 3}, 15.5 - 0.012, equator_and_pole)));
  EXPECT_LT((fit.centre - Vec3(1, 2, 3)).norm(), 1e-11);
  EXPECT_NEAR(2 * (fit.radius - 3), 24.976, 1e-10) << "measured diameter of a sphere of 25 mm, ball of 6 mm";
}

TEST(Sphere, RefusesTouchesThatGiveNone) {
  EXPECT_EQ(std::get<SphereError>(fit_sphere({{1, 0, 0}, {0, 1, 0}, {0, 0, 1}})), SphereError::too_few);
  EXPECT_EQ(std::get<SphereError>(
                fit_sphere(touches({0, 0, 0}, 10, {{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}}))),
            SphereError::one_plane);
  EXPECT_EQ(std::get<SphereError>(fit_sphere({{1, 1, 1}, {1, 1, 1}, {1, 1, 1}, {1, 1, 1}})),
            SphereError::one_plane);
  auto tips = touches({0, 0, 0}, 10, equator_and_pole);
  tips[2].y() = std::nan("");
  EXPECT_EQ(std::get<SphereError>(fit_sphere(tips)), SphereError::not_finite);
  EXPECT_EQ(std::get<SphereError>(fit_sphere(touches({0, 0, 0}, 10, equator_and_pole), -1)),
            SphereError::not_finite);
}

TEST(Student, CoverageFactorsAreThoseOfTheClosedFormsAndOfTheGum) {
  // The probability of -t .. t: with one degree of freedom (Cauchy) 2/pi atan t, with two t / sqrt(2 + t^2).
  EXPECT_NEAR(coverage_factor(0.5, 1, 1), 1, 1e-12);
  EXPECT_NEAR(coverage_factor(3 / std::sqrt(11.0), 1, 2), 3, 1e-12);
  // GUM table G.2: 95 %.
  EXPECT_NEAR(coverage_factor(0.95, 1, 3), 3.18, 0.005);
  EXPECT_NEAR(coverage_factor(0.95, 1, 10), 2.23, 0.005);
  EXPECT_NEAR(coverage_factor(0.95, 1, 0), 1.95996, 1e-5);
  // Ten values: each with 99.5 %, GUM table G.2 has 2.576 for 99 %: 2.807 for 99.5 % of the normal
  // distribution.
  EXPECT_NEAR(coverage_factor(0.95, 10, 0), 2.8070, 1e-4);
}

}  // namespace
}  // namespace trunnion::metrology
