// SPDX-License-Identifier: Apache-2.0
// Machines of every kind as they were built, and as a control believes them to be.
#pragma once

#include <Eigen/Geometry>
#include <cmath>

#include "geometry/random_source.hpp"
#include "geometry/test/machines.hpp"
#include "metrology/kinematic_fit.hpp"

namespace trunnion::metrology {

inline std::vector<geometry::Machine> kinds() {
  return {{"AC table", geometry::ac_table()},
          {"BC table", geometry::bc_table()},
          {"CB head", geometry::cb_head()},
          {"AC head", geometry::ca_head()},
          {"B head C table", geometry::b_head_c_table()},
          {"nutating B head C table", geometry::nutating_b_head_c_table()},
          {"A table", geometry::a_table()}};
}

inline double between(geometry::RandomSource& random, double low, double high) {
  return low + (high - low) * random.uniform();
}

// A machine as it is: its axes are up to 0.3 mrad off.
inline ChainParameters as_built(ChainParameters p, geometry::RandomSource& random) {
  for (const Slot slot : all_slots)
    if (auto& axis = axis_at(p, slot))
      for (double& d : axis->direction) d += between(random, -3e-4, 3e-4);
  return p;
}

// What the control believes: every offset 0.5 mm and every direction 0.1 degrees wrong, but the components
// that slide along an axis, which are a convention.
inline ChainParameters believed(ChainParameters p, geometry::RandomSource& random) {
  std::array<Vec3, slot_count> kept{};
  kept.fill(Vec3::Zero());
  for (const auto& condition : free_components(p))
    for (std::size_t s = 0; s < slot_count; ++s) kept[s] += condition.coefficient[s].cwiseAbs();
  for (const Slot slot : all_slots) {
    auto& axis = axis_at(p, slot);
    if (!axis) continue;
    for (int c = 0; c < 3; ++c)
      if (kept[index_of(slot)][c] == 0) axis->offset[c] += random.uniform() < 0.5 ? -0.5 : 0.5;
    const Vec3 about = axis->direction.normalized().unitOrthogonal();
    axis->direction = Eigen::AngleAxisd(0.1 * M_PI / 180, about) * axis->direction.normalized();
  }
  return p;
}

/// The name of a kind for a test.
inline std::string test_name(const geometry::Machine& machine) {
  std::string name = machine.name;
  std::erase(name, ' ');
  return name;
}

}  // namespace trunnion::metrology
