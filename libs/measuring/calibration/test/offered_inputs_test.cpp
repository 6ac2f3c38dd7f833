// SPDX-License-Identifier: Apache-2.0
#include "calibration/offered_inputs.hpp"

#include <gmock/gmock.h>

#include "calibration/measurement_file.hpp"
#include "geometry/test/machines.hpp"
#include "machine/machine.hpp"
#include "true_machine.hpp"

namespace trunnion::calibration {
namespace {

const TrueMachine offered_on(geometry::ac_table(), geometry::ac_table());

TEST(OfferedInputs, TheDocumentOfEveryInputIsReadBackAsTheSame) {
  // Every key with another value than the default.
  const std::string text = R"(
plane: G17
mode: correct
calibrate_probe: true
positioning: paraxial
reference: measure
zero_offset_mm: [200, 0, 150]
sphere: {centre_mm: [-120, -130.125, -420], diameter_mm: 30, shaft: [0, 0.5, -1], shaft_diameter_mm: 10}
probe: {length_mm: 150, length_uncertainty_mm: 0.001, ball_diameter_mm: 5, on_m: 50, off_m: 51}
measuring_path_mm: 3
confidence_range_mm: 2
vector_tolerance_mm: 1
tolerance_alarm: reset
directions: write
further_poses: 7
axes:
  A: {start_deg: -90, end_deg: 0, points: 4, other_deg: 1, touch_start_deg: 20, normalization: 4}
  C: {start_deg: 0, end_deg: 240, points: 12, other_deg: -20, normalization: 3, normalized_value_mm: 7}
settings: {touches: 8, diameter_tolerance_mm: 0.02, least_triangle_angle_deg: 5, least_swept_angle_deg: 30,
           rotary_feed_deg_per_min: 500, circle_feed_mm_per_min: 800, positioning_feed_mm_per_min: 900,
           first_touch_feed_mm_per_min: 100, measuring_feed_mm_per_min: 40, repeatability_mm: 0.004,
           transformation_active: true})";
  const auto document = input_document(parse_inputs(text, "inputs", offered_on.measured));
  const auto again = input_document(parse_inputs(document.dump(), "document", offered_on.measured));
  EXPECT_EQ(again, document);
  const auto defaults = input_document(default_inputs(offered_on.measured));
  for (const auto& [key, value] : document.items()) {
    if (!defaults.contains(key)) continue;
    EXPECT_NE(value, defaults[key]) << key << " would not be noticed";
  }
  EXPECT_EQ(document["sphere"]["centre_mm"], (nlohmann::ordered_json{-120, -130.125, -420}));
  EXPECT_EQ(document["axes"]["C"]["normalized_value_mm"], 7);
  EXPECT_EQ(document["settings"]["repeatability_mm"], 0.004);
  EXPECT_EQ(document["vector_tolerance_mm"], 1);
}

TEST(OfferedInputs, OfTheDeliveredTrunnionMachineAreItsSphereAndRangesWithinTheTravel) {
  const auto config = machine::load_machine(std::string(TRUNNION_SOURCE) + "/configs/machines/ac-table");
  machine::Parameters active;
  active.values = machine::machine_parameters(config);
  const auto mill = load_measured_machine(config, active, 0);
  const auto inputs = default_inputs(mill);
  EXPECT_EQ(fault_of(inputs, mill), "");
  const auto document = input_document(inputs), travel = travel_document(inputs, mill);
  for (const char* letter : {"A", "C"}) {
    const auto& range = document["axes"][letter];
    EXPECT_EQ(range["points"], 8);
    if (!travel.contains(letter)) continue;
    EXPECT_GE(range["start_deg"], travel[letter][0]);
    EXPECT_LE(range["end_deg"], travel[letter][1]);
  }
  EXPECT_TRUE(travel.contains("A"));
}

}  // namespace
}  // namespace trunnion::calibration
