// SPDX-License-Identifier: Apache-2.0
// Any text as truth.yaml: it is taken and gives finite positions, or it is refused with the place in the
// file.
#include <cmath>
#include <cstdlib>

#include "outline.hpp"
#include "testing_support/refusal.hpp"
#include "truth/truth_file.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace trunnion;
  static const auto machine = truth::outline(geometry::ac_table_with_b_head());
  const std::string text(reinterpret_cast<const char*>(data), size);
  testing_support::taken_or_refused("truth.yaml", [&] {
    const auto truth = truth::parse_truth(text, "truth.yaml", machine);
    const auto geometry = truth::make_geometry(truth.geometry, machine, "truth.yaml:1:1");
    truth::MachinePose pose;
    pose.positions = {100, -200, 50, 30, -20, 45, 0, 0, 0};
    pose.approach = {1, -1, 0, 1, -1, 0, 1, -1, 0};
    const auto tool = geometry.pose(pose);
    if (!tool.tip.allFinite()) std::abort();
    touch_probe::TouchProbe probe(truth.probe.value_or(touch_probe::TouchProbeTruth{}), truth.solids);
    probe.place({truth::Vec3(0, 0, 500)});
    for (const auto& to : {tool.tip, truth::Vec3(truth::Vec3::Zero())})
      if (const auto edge = probe.move({to}, 1); edge && !(*edge > 0 && *edge <= 1)) std::abort();
  });
  return 0;
}
