// SPDX-License-Identifier: Apache-2.0
// Any text as bodies.yaml is taken or refused with its place; a model of what is taken has distances.
#include <cmath>
#include <cstdlib>

#include "collision/bodies_file.hpp"
#include "collision/collision_model.hpp"
#include "geometry/test/machines.hpp"
#include "testing_support/refusal.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace trunnion;
  const std::string text(reinterpret_cast<const char*>(data), size);
  testing_support::taken_or_refused("bodies.yaml", [&] {
    auto bodies = collision::parse_bodies(text, "bodies.yaml", geometry::ac_table());
    const collision::CollisionModel model(std::move(bodies.links), std::move(bodies.set));
    const auto nearest = model.nearest({10, 20, -30, 40, 0, 50});
    if (nearest && !std::isfinite(nearest->distance)) std::abort();
  });
  return 0;
}
