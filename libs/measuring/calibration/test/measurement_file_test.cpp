// SPDX-License-Identifier: Apache-2.0
#include "calibration/measurement_file.hpp"

#include <gmock/gmock.h>

#include "calibration/touches.hpp"
#include "geometry/test/machines.hpp"
#include "true_machine.hpp"

namespace trunnion::calibration {
namespace {

const TrueMachine machine(geometry::ac_table(), geometry::ac_table());

std::string fault(const std::string& text) {
  try {
    parse_inputs(text, "m.yaml", machine.measured);
  } catch (const std::runtime_error& e) {
    return e.what();
  }
  return "taken";
}

TEST(MeasurementFile, TakesEveryInputOfTheManual) {
  const auto in = parse_inputs(R"(
plane: G17
transformation: TOOL_CARR_KIN
mode: correct
calibrate_probe: true
positioning: paraxial
reference: measure
zero_offset_mm: [200, 0, 150]
sphere: {centre_mm: [-120, -130, -420], diameter_mm: 30, shaft: [0, 0, -1], shaft_diameter_mm: 10}
probe: {length_mm: 150, length_uncertainty_mm: 0.001, ball_diameter_mm: 5}
measuring_path_mm: 3
confidence_range_mm: 2
vector_tolerance_mm: 1
tolerance_alarm: reset
directions: write
axes:
  A: {start_deg: -90, end_deg: 0, points: 3, other_deg: 0, touch_start_deg: 20, normalization: 4}
  C: {start_deg: 0, end_deg: 240, points: 12, other_deg: -20, normalization: 3, normalized_value_mm: 7}
settings: {touches: 8, diameter_tolerance_mm: 0.02, least_triangle_angle_deg: 5, least_swept_angle_deg: 30,
           rotary_feed_deg_per_min: 500, circle_feed_mm_per_min: 800, transformation_active: true}
)",
                               "m.yaml", machine.measured);
  EXPECT_EQ(in.mode, Mode::correct);
  EXPECT_EQ(in.positioning, Positioning::paraxial);
  EXPECT_EQ(in.touches, 8u);
  EXPECT_EQ(in.axes[1].points, 12u);
  EXPECT_EQ(in.axes[1].normalized_value, 7);
  EXPECT_TRUE(in.tolerance_needs_reset && in.write_directions && in.transformation_active);
  EXPECT_EQ(*in.vector_tolerance, 1);
}

TEST(MeasurementFile, KeepsTheLimitsOfTheManual) {
  for (const auto& [text, expected] : std::vector<std::pair<std::string, std::string>>{
           {"axes: {A: {points: 2}, C: {}}", "m.yaml:1:20: error: 2 is not within 3 .. 12"},
           {"axes: {A: {points: 13}, C: {}}", "m.yaml:1:20: error: 13 is not within 3 .. 12"},
           {"axes: {A: {points: 3.5}, C: {}}", "m.yaml:1:20: error: 3.5 is not a whole number"},
           {"axes: {A: {start_deg: 20, end_deg: 20}, C: {}}",
            "m.yaml:1:1: error: axis A: start angle 20 deg is not below end angle 20 deg"},
           {"axes: {A: {start_deg: -121, end_deg: 20}, C: {}}",
            "m.yaml:1:1: error: axis A: start angle -121 deg is not within -120 .. 120 deg"},
           {"axes: {A: {start_deg: 0, end_deg: 9}, C: {}}",
            "m.yaml:1:1: error: axis A: swept angle 9 deg is below the least of 10 deg"},
           {"axes: {A: {}}", "m.yaml:1:1: error: 1 rotary axes are given, the machine has 2"},
           {"axes: {A: {}, B: {}}", "m.yaml:1:1: error: axis B: the transformation has no such rotary axis"},
           {"axes: {A: {}, C: {other_deg: 130}}",
            "m.yaml:1:1: error: axis C: position of A 130 deg is not within -120 .. 120 deg"},
           {"axes: {A: {normalization: 7}, C: {}}",
            "m.yaml:1:27: error: normalization 7 is not within 0 .. 6 or 10 .. 16 (open chain)"},
           {"settings: {least_triangle_angle_deg: 1.9}", "m.yaml:1:38: error: 1.9 is not within 2 .. 60"},
           {"settings: {least_triangle_angle_deg: 61}", "m.yaml:1:38: error: 61 is not within 2 .. 60"},
           {"settings: {least_swept_angle_deg: 9}", "m.yaml:1:35: error: 9 is not within 10 .. 180"},
           {"settings: {touches: 9}", "m.yaml:1:21: error: '9' is none of 10, 8"},
           {"transformation: TRAORI",
            "m.yaml:1:1: error: transformation TRAORI is not known: the channel has TOOL_CARR_KIN"},
           {"plane: G18", "m.yaml:1:1: error: plane G18: the spindle is not perpendicular to it"},
           {"reference: adapt",
            "m.yaml:1:1: error: reference adapt: only a machine whose rotary axes are all in the head has "
            "exchangeable heads"},
           {"sphere: {shaft: [0, 0, 0]}", "m.yaml:1:17: error: the vector has no length"},
           {"mode: guess", "m.yaml:1:7: error: 'guess' is none of correct, measure_only, only_correct"}})
    EXPECT_EQ(fault(text), expected) << text;
}

TEST(MeasurementFile, DefaultsMeasureEveryRotaryAxis) {
  const auto in = default_inputs(machine.measured);
  EXPECT_EQ(fault_of(in, machine.measured), "");
  EXPECT_EQ(in.axes[0].start, -90);
  EXPECT_EQ(in.axes[1].end, 315);
}

TEST(MeasurementFile, RefusesMachinesThatAreNotPerpendicularOrRightHanded) {
  auto skew = machine.measured;
  skew.model.linear_direction(0, 1) = 0.01;
  EXPECT_EQ(fault_of(default_inputs(skew), skew),
            "X, Y and Z are not perpendicular to each other (DIN 66217)");
  auto left = machine.measured;
  left.model.linear_direction(0, 0) = -1;
  EXPECT_EQ(fault_of(default_inputs(left), left), "X, Y and Z are not right-handed (DIN 66217)");
}

TEST(TouchFile, EveryFaultHasItsPlace) {
  const auto refused = [](const std::string& text) {
    try {
      parse_touches(text, "t.txt", machine.measured.model);
    } catch (const std::runtime_error& e) {
      return std::string(e.what());
    }
    return std::string("taken");
  };
  EXPECT_EQ(refused("# a comment\nX1 Y2 Z3 ; touch\n\nA-90 C45 X1 Y+2 Z-3.5e1\r\n"), "taken");
  EXPECT_EQ(refused(""), "t.txt:0:1: error: no touch");
  EXPECT_EQ(refused("X1 Y2\n"), "t.txt:1:1: error: axis Z is missing: a touch has X, Y and Z");
  EXPECT_EQ(refused("X1 Y2 Z3\nB1 X1 Y2 Z3"),
            "t.txt:2:1: error: expected a word of one of the axes XYZAC, for example X10.5");
  EXPECT_EQ(refused("X1 Y2 Z3 X4"), "t.txt:1:10: error: axis X is there twice");
  EXPECT_EQ(refused("X1 Yq Z3"), "t.txt:1:5: error: 'q' is not a number");
  EXPECT_EQ(refused("X1 Y2 Z3e9"), "t.txt:1:8: error: 3e9 is not within -1000000 .. 1000000");
}

}  // namespace
}  // namespace trunnion::calibration
