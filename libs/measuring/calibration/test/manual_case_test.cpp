// SPDX-License-Identifier: Apache-2.0
// The worked case of the HNC-8 manual, 2.3: an AC table is measured with 8 + 8 points; then a dial on the
// table reads a ball in the spindle.
#include <gtest/gtest.h>

#include "calibration/manual_calibration.hpp"
#include "geometry/angle.hpp"
#include "true_machine.hpp"

namespace trunnion::calibration {
namespace {

constexpr double probe_length = 236.608;

ChainParameters designed() {
  ChainParameters p;
  p.table_1 = geometry::RotaryAxis{{-1, 0, 0}, {0, 0, 0}, 0};
  p.table_2 = geometry::RotaryAxis{{0, 0, -1}, {-200, -190, -516}, 2};
  return p;
}

MeasurementInputs teaching_points() {
  MeasurementInputs in;
  in.sphere = {-120, -130, -420};
  in.probe_length = probe_length;
  in.touches = 8;
  AxisRange a, c;
  a.angle = 0, a.start = -25, a.end = 80, a.points = 8;  // every 15 degrees
  c.angle = 2, c.start = 0, c.end = 315, c.points = 8;   // every 45 degrees
  in.axes = {c, a};
  in.write_directions = true;
  return in;
}

TEST(ManualCase, AutomaticCalibrationFindsTheVectorsOfTheMachine) {
  auto real = designed();
  real.table_1->direction = Vec3(-1, 0, 0.000093);
  real.table_2->direction = Vec3(0.0002, 0.00001, -1.000007);  // printed so; its length is not 1
  real.table_1->offset = Vec3(0, 0.1028, 0);
  real.table_2->offset = Vec3(-200.3605, -190.1897, -516.0118);
  const TrueMachine machine(real, designed());
  const auto result = machine.measure(teaching_points(), {}, Vec3(-120.2, -129.7, -420.1));
  ASSERT_EQ(result.poses.size(), 16u) << "the initial pose is that of C0";
  for (const auto slot : {metrology::Slot::table_1, metrology::Slot::table_2}) {
    const auto& found = *axis_at(result.after, slot);
    const auto& truth = *axis_at(real, slot);
    // The touch of the virtual probe is found to 1e-9 mm.
    EXPECT_LT((found.offset - truth.offset).cwiseAbs().maxCoeff(), 1e-6);
    EXPECT_LT((found.direction - truth.direction.normalized()).norm(), 1e-8);
  }
  EXPECT_LT((result.sphere - Vec3(-120.2, -129.7, -420.1)).norm(), 1e-6);
}

// Errors of C and A that move the ball along the dial as the printed series, um.
constexpr std::array c_series{0, -2, -10, -18, -20, -12, -14, 4, -3};
constexpr std::array a_angles{-25, -10, 0, 5, 20, 35, 50, 65, 80};
constexpr std::array a_series{-8, 8, 0, 14, 22, 20, 22, 24, 20};

TEST(ManualCase, TheDialSeriesOfCIsReadOnAMachineWithThatError) {
  // A dial on the minus side, pressed positive, reads the negative displacement along X of the table. The
  // table turns by -C about Z: there the error (x, 0) of the machine's frame is (x cos C, x sin C).
  std::string exc = "[", eyc = "[", positions = "[";
  for (std::size_t i = 0; i < c_series.size(); ++i) {
    const auto t = geometry::sine_cosine(45.0 * static_cast<double>(i));
    // Displacement (-reading, 0) in the frame of the table, turned into that of the machine.
    exc += std::to_string(-c_series[i] * t.cosine) + ", ";
    eyc += std::to_string(c_series[i] * t.sine) + ", ";
    positions += std::to_string(45 * i) + ", ";
  }
  const auto list = [](std::string text) { return text.substr(0, text.size() - 2) + "]"; };
  const TrueMachine machine(designed(), designed(),
                            "axes: {C: {EXC: [{table_um: " + list(exc) +
                                ", positions_deg: " + list(positions) + "}], EYC: [{table_um: " + list(eyc) +
                                ", positions_deg: " + list(positions) + "}]}}");
  std::vector<Angles> poses;
  for (int i = 0; i < 9; ++i) poses.push_back({0, 0, 45.0 * i});
  const auto displaced =
      sphere_displacements(machine.report, machine.measured.model, {-120, -130, -420}, probe_length, poses);
  std::vector<double> readings;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    readings.push_back(-displaced[i].x());
    EXPECT_NEAR(1e3 * readings[i], c_series[i], 1e-3) << "C" << 45 * i;  // the text has 1e-6 um
  }
  EXPECT_NEAR(largest_deviation(readings), 0.020, 1e-6);
  EXPECT_LE(largest_deviation(readings), 0.020 + 1e-6) << "accepted: within 20 um";
}

// The dial on the minus side of Y. The table turns by -A about X: there the error (y, 0) in the machine's Y
// and Z is (y cos A, y sin A).
TEST(ManualCase, TheDialSeriesOfAIsReadOnAMachineWithThatErrorAndBreaksTheManualsOwnLimit) {
  std::string eya, eza, positions;
  for (std::size_t i = 0; i < a_series.size(); ++i) {
    const auto t = geometry::sine_cosine(a_angles[i]);
    const auto add = [&](std::string& list, double value) {
      list += (list.empty() ? "[" : ", ") + std::to_string(value);
    };
    add(eya, -a_series[i] * t.cosine), add(eza, a_series[i] * t.sine), add(positions, a_angles[i]);
  }
  const auto table = [&](const std::string& values) {
    return "[{table_um: " + values + "], positions_deg: " + positions + "]}]";
  };
  const TrueMachine machine(designed(), designed(),
                            "axes: {A: {EYA: " + table(eya) + ", EZA: " + table(eza) + "}}");
  std::vector<Angles> poses{{0, 0, 0}};
  for (const double angle : a_angles) poses.push_back({angle, 0, 0});
  const auto displaced =
      sphere_displacements(machine.report, machine.measured.model, {-120, -130, -420}, probe_length, poses);
  std::vector<double> readings;
  for (std::size_t i = 0; i < a_angles.size(); ++i) {
    readings.push_back(-displaced[i + 1].y());
    EXPECT_NEAR(1e3 * readings.back(), a_series[i], 1e-3) << "A" << a_angles[i];  // the text has 1e-6 um
  }
  // From the reading at 0 the series goes to 24 um: beyond the 20 um of the manual.
  EXPECT_NEAR(largest_deviation(readings), 0.024 + 0.008, 1e-6);
  EXPECT_GT(largest_deviation(readings), 0.020);
}

}  // namespace
}  // namespace trunnion::calibration
