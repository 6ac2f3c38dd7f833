// SPDX-License-Identifier: Apache-2.0
// A million poses for every machine: there and back, and from the direction to the angles.
#include <gtest/gtest.h>

#include <cmath>

#include "geometry/orientation.hpp"
#include "machines.hpp"
#include "testing_support/rounds.hpp"

namespace trunnion::geometry {
namespace {

constexpr int poses = testing_support::sanitized ? 20'000 : 1'000'000;

// splitmix64: small, seeded, the same everywhere.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}
  double between(double low, double high) {
    state_ += 0x9e3779b97f4a7c15u;
    std::uint64_t z = state_;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    z ^= z >> 31;
    return low + (high - low) * static_cast<double>(z >> 11) * 0x1p-53;
  }
  // Half of the angles are anything, the others near a multiple of 45 degrees, as near as 1e-14: where poles
  // and the borders of 45 degree heads are.
  double angle() {
    if (between(0, 1) < 0.5) return between(-720, 720);
    const double near = 45 * std::floor(between(-8, 9));
    constexpr std::array<double, 14> sizes{1e-14, 1e-13, 1e-12, 1e-11, 1e-10, 1e-9, 1e-8,
                                           1e-7,  1e-6,  1e-5,  1e-4,  1e-3,  1e-2, 1e-1};
    const double size = sizes[static_cast<std::size_t>(between(0, 14))] * between(1, 10);
    return between(0, 1) < 0.5 ? near - size : near + size;
  }
  Angles angles(const Chain& chain) {
    Angles a{};
    for (std::size_t i = 0; i < chain.rotary_count(); ++i) a[chain.orienting_axis(i).angle] = angle();
    return a;
  }

 private:
  std::uint64_t state_;
};

class EveryMachine : public testing::TestWithParam<Machine> {};

TEST_P(EveryMachine, forward_of_inverse_is_the_tip_within_1e_10_mm_over_a_million_poses) {
  const Chain chain = make(GetParam().parameters);
  Random random(11);
  double worst = 0;
  for (int i = 0; i < poses; ++i) {
    const Vec3 w(random.between(-1000, 1000), random.between(-1000, 1000), random.between(-1000, 1000));
    const Angles a = random.angles(chain);
    const double l = random.between(0, 400);
    worst = std::max(worst, (chain.tip_from_machine(chain.machine_from_tip(w, a, l), a, l) - w).norm());
  }
  EXPECT_LT(worst, 1e-10);
}

TEST_P(EveryMachine, the_angles_of_a_direction_give_it_back_within_1e_12_over_a_million_poses) {
  const Chain chain = make(GetParam().parameters);
  const OrientationSolver solver(chain);
  Random random(12);
  double worst = 0;
  int missed = 0;
  for (int i = 0; i < poses; ++i) {
    OrientationRequest request;
    request.present = random.angles(chain);
    Angles target = request.present;
    for (std::size_t n = 0; n < std::min<std::size_t>(chain.rotary_count(), 2); ++n)
      target[chain.orienting_axis(chain.rotary_count() - 1 - n).angle] = random.angle();
    request.direction = chain.tool_direction_in_workpiece(target);
    request.tolerance = 1e-12;
    const auto answer = solver.best(request);
    if (answer.status != OrientationStatus::found) {
      ++missed;
      continue;
    }
    worst =
        std::max(worst, (chain.tool_direction_in_workpiece(answer.best.angles) - request.direction).norm());
  }
  EXPECT_EQ(missed, 0);
  EXPECT_LT(worst, 1e-12);
}

INSTANTIATE_TEST_SUITE_P(Poses, EveryMachine, testing::ValuesIn(machines()), [](const auto& machine) {
  std::string name = machine.param.name;
  std::replace(name.begin(), name.end(), ' ', '_');
  return name;
});

}  // namespace
}  // namespace trunnion::geometry
