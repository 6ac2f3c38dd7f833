// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "outline.hpp"
#include "testing_support/refusal.hpp"
#include "truth/truth_file.hpp"

namespace trunnion::truth::probe_section_test {
namespace {

Truth parsed(const std::string& text) { return parse_truth(text, "truth.yaml", ac); }

std::string refusal(const std::string& text) {
  return testing_support::refusal_of([&] { parsed(text); });
}

TEST(ProbeSection, WithoutItThereIsNoProbe) {
  EXPECT_FALSE(parsed("").probe);
  EXPECT_TRUE(parsed("").solids.empty());
}

TEST(ProbeSection, TheProbeHasItsUnits) {
  const auto probe = *parsed(R"(
probe: {ball_radius_mm: 2.5, length_mm: 150, pre_travel_um: 8, lobing_um: 2, lobing_phase_deg: 30,
        repeatability_um: 0.5, delay_ms: 1.5, seed: 9, no_signal_from_touch: 3, early_mm: 2, early_from_touch: 4}
)")
                          .probe;
  EXPECT_EQ(probe.ball_radius, 2.5);
  EXPECT_EQ(probe.length, 150);
  EXPECT_DOUBLE_EQ(probe.pre_travel, 8e-3);
  EXPECT_DOUBLE_EQ(probe.lobing, 2e-3);
  EXPECT_EQ(probe.lobing_phase, 30);
  EXPECT_DOUBLE_EQ(probe.repeatability, 5e-4);
  EXPECT_DOUBLE_EQ(probe.delay, 1.5e-3);
  EXPECT_EQ(probe.seed, 9u);
  EXPECT_EQ(probe.no_signal_from, 3u);
  EXPECT_EQ(probe.early, 2);
  EXPECT_EQ(probe.early_from, 4u);
}

TEST(ProbeSection, SolidsAreWhereTheirPositionAndRotationPutThem) {
  const auto solids = parsed(R"(
solids:
  - {sphere: {diameter_mm: 25, shaft_diameter_mm: 10, shaft_length_mm: 60}, position_mm: [1, 2, 3]}
  - {box: {size_mm: [20, 40, 60]}, rotation_deg: [0, 0, 90]}
  - {ring: {bore_mm: 50, outside_mm: 80, height_mm: 20}, rotation_deg: [0, 90, 0]}
  - {cylinder: {diameter_mm: 30, height_mm: 100}, position_mm: [100, 0, 0], rotation_deg: [90, 0, 0]}
)")
                          .solids;
  ASSERT_EQ(solids.size(), 4u);
  EXPECT_NEAR(signed_distance(solids[0], {1, 2, 20}), 4.5, 1e-12) << "above the sphere";
  EXPECT_NEAR(signed_distance(solids[0], {9, 2, -37}), 3, 1e-12) << "beside the shaft, which points down";
  EXPECT_NEAR(signed_distance(solids[0], {1, 2, -62}), 5, 1e-12) << "below the shaft's end at Z-57";
  // Turned by 90 degrees about Z the edge of 40 is along X.
  EXPECT_NEAR(signed_distance(solids[1], {23, 0, 0}), 3, 1e-12);
  EXPECT_NEAR(signed_distance(solids[1], {0, 13, 0}), 3, 1e-12);
  EXPECT_NEAR(signed_distance(solids[2], {0, 20, 0}), 5, 1e-12) << "its axis is X, the bore has radius 25";
  EXPECT_NEAR(signed_distance(solids[2], {12, 30, 0}), 2, 1e-12);
  EXPECT_NEAR(signed_distance(solids[3], {100, 52, 0}), 2, 1e-12) << "its axis is Y";
}

TEST(ProbeSection, EveryFaultIsOneLineWithItsPlace) {
  const std::vector<std::pair<std::string, std::string>> faults{
      {"probe: {ball_mm: 3}", "1:9: error: unknown key 'ball_mm'; the keys are ball_radius_mm, length_mm"},
      {"probe: {ball_radius_mm: 0}", "1:25: error: 0 is not within 0.001 .. 100"},
      {"probe: {seed: 1.5}", "1:15: error: expected a whole number"},
      {"probe: 3", "1:8: error: expected 'key: value' with the keys ball_radius_mm"},
      {"solids: {sphere: {diameter_mm: 25}}", "1:9: error: expected a list of solids"},
      {"solids: [{position_mm: [0, 0, 0]}]", "1:10: error: a shape is missing"},
      {"solids: [{cone: {}}]", "1:11: error: unknown key 'cone'; the keys are one of sphere, box, ring"},
      {"solids: [{sphere: {}}]", "1:19: error: 'diameter_mm' is missing"},
      {"solids: [{sphere: {diameter_mm: 25, shaft_length_mm: 3}}]", "1:19: error: a shaft has both"},
      {"solids: [{sphere: {diameter_mm: 25, shaft_length_mm: 3, shaft_diameter_mm: 25}}]",
       "1:76: error: the shaft must be thinner than the sphere"},
      {"solids: [{sphere: {diameter_mm: 25}, box: {size_mm: [1, 2, 3]}}]",
       "1:43: error: 'sphere' is there already"},
      {"solids: [{box: {size_mm: [1, 2]}}]", "1:26: error: expected [x, y, z]"},
      {"solids: [{box: {size_mm: [1, 2, 0]}}]", "1:33: error: 0 is not within 0.001 .. 10000"},
      {"solids: [{box: {}}]", "1:16: error: 'size_mm' is missing"},
      {"solids: [{ring: {bore_mm: 50, outside_mm: 50, height_mm: 2}}]",
       "1:43: error: the outside diameter must exceed the bore"},
      {"solids: [{cylinder: {diameter_mm: 50}}]", "1:21: error: 'height_mm' is missing"},
      {"solids: [{box: {size_mm: [1, 2, 3]}, position_mm: [0, 0, 1e6]}]",
       "1:58: error: 1e6 is not within -100000 .. 100000"}};
  for (const auto& [text, expected] : faults) {
    const auto found = refusal(text);
    EXPECT_THAT(found, testing::StartsWith("truth.yaml:" + expected)) << text;
    EXPECT_EQ(found.find('\n'), std::string::npos) << text;
  }
}

}  // namespace
}  // namespace trunnion::truth::probe_section_test
