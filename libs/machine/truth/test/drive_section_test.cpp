// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

#include "outline.hpp"
#include "truth/truth_file.hpp"

namespace trunnion::truth {
namespace {

machine::MachineOutline machine() {
  auto m = outline(geometry::ac_table());
  m.drives = {"X", "Y2", "C"};
  m.turning = {"C"};
  m.spindles = {"S"};
  return m;
}

TEST(DriveSection, AFaultHasItsKindAndPlaceAndABeamItsFrequency) {
  const auto truth = parse_truth(
      "drives: {Y2: {fault: {kind: overcurrent, at_mm: 300}}, C: {fault: {kind: overload, at_deg: -5}}}\n"
      "beam: {axis: Y, slave_foot_mm: [900, 0, 0], racking_frequency_Hz: 20, racking_damping_ratio: 0.1}\n",
      "truth.yaml", machine());
  EXPECT_EQ(truth.drives.at("Y2").fault->kind, DriveFaultKind::overcurrent);
  EXPECT_EQ(truth.drives.at("Y2").fault->at, 300);
  EXPECT_TRUE(is_emergency(truth.drives.at("Y2").fault->kind));
  EXPECT_FALSE(is_emergency(truth.drives.at("C").fault->kind));
  EXPECT_EQ(truth.geometry.beam->racking_frequency, 20);
  EXPECT_EQ(truth.geometry.beam->racking_damping, 0.1);
}

TEST(DriveSection, EveryValueHasItsUnit) {
  const auto drives = parse_truth(R"(
drives:
  X:
    mechanics: {load_share: 0.6, locked_frequency_Hz: 80, damping_ratio: 0.05, coulomb: 0.05, breakaway: 0.08,
                stribeck_speed_mm_per_s: 2, viscous_per_mm_per_s: 1e-4, backlash_um: 12, gravity: 0.2, cogging: 0.01,
                cogging_period_mm: 8, screw_error: [{harmonic_um: 2, period_mm: 10}]}
    motor_encoder: {kind: incremental, resolution_um: 0.1, mark_spacing_mm: 10}
    load_encoder: {kind: distance_coded, resolution_um: 0.05, inverted: true, signal_period_um: 20, sine_offset: 0.01,
                   mark_spacing_mm: 20, mark_increment_mm: 0.02, first_mark_mm: -500, lost_at_mm: 30, lost_counts: 2}
  C: {mechanics: {backlash_urad: 100}, motor_encoder: {resolution_urad: 10}}
)",
                                  "truth.yaml", machine())
                          .drives;
  ASSERT_EQ(drives.size(), 2u);
  const auto& x = drives.at("X");
  EXPECT_DOUBLE_EQ(x.mechanics->backlash, 0.012);
  EXPECT_DOUBLE_EQ(x.mechanics->screw.value(2.5, 0), 0.002);
  EXPECT_EQ(x.mechanics->gravity, 0.2);
  EXPECT_EQ(x.motor.kind, EncoderKind::incremental);
  EXPECT_DOUBLE_EQ(x.load->signal_period, 0.02);
  EXPECT_TRUE(x.load->inverted);
  EXPECT_EQ(x.load->lost_counts, 2);
  const double degrees = 180 / std::numbers::pi;
  EXPECT_DOUBLE_EQ(drives.at("C").mechanics->backlash, 100e-6 * degrees);
  EXPECT_DOUBLE_EQ(drives.at("C").motor.resolution, 10e-6 * degrees);
}

TEST(DriveSection, ASpindleHasTheTorqueOfItsCurveAtEverySpeed) {
  const auto spindles =
      parse_truth("spindle_drives: {S: {inertia_kg_m2: 0.05, torque_Nm: [[0, 80], [1500, 80], [6000, 20]]}}",
                  "truth.yaml", machine())
          .spindle_drives;
  const auto& s = spindles.at("S");
  EXPECT_EQ(s.inertia, 0.05);
  EXPECT_EQ(s.torque_at(-700), 80);
  // Half way from 1500 to 6000 1/min: the mean of 80 and 20 Nm.
  EXPECT_DOUBLE_EQ(s.torque_at(3750), 50);
  EXPECT_DOUBLE_EQ(s.torque_at(-3750), 50);
  EXPECT_EQ(s.torque_at(9000), 20);
}

TEST(DriveSection, ASpindleHasItsSpeedErrorDisturbanceLoadGearsAndMark) {
  const auto s = parse_truth(
                     "spindle_drives: {S: {inertia_kg_m2: 0.05, torque_Nm: [[0, 10], [1000, 10], [2000, 5]],"
                     " speed_error: -0.001, disturbance: {share: 0.02, hz: 5}, load_torque_Nm: 3,"
                     " gears: [{ratio: 4}, {ratio: 1}], mark_deg: 120}}",
                     "truth.yaml", machine())
                     .spindle_drives.at("S");
  EXPECT_EQ(s.speed_error, -0.001);
  EXPECT_EQ(s.ripple, 0.02);
  EXPECT_EQ(s.ripple_frequency, 5);
  EXPECT_EQ(s.load_torque, 3);
  EXPECT_EQ(s.mark, 120);
  EXPECT_TRUE(s.has_motor());
  // Gear 1 turns the motor four times: 40 Nm at rest, at 500 1/min 4 times the 5 Nm of 2000 1/min.
  EXPECT_EQ(s.torque_at(0, 1), 40);
  EXPECT_EQ(s.torque_at(-500, 1), 20);
  EXPECT_EQ(s.torque_at(500, 2), 10);
  EXPECT_EQ(s.torque_at(500, 3), 10) << "no such gear";
  const auto ideal =
      parse_truth("spindle_drives: {S: {speed_error: 0.01}}", "truth.yaml", machine()).spindle_drives.at("S");
  EXPECT_FALSE(ideal.has_motor());
  EXPECT_FALSE(ideal.mark);
  EXPECT_EQ(ideal.ripple, 0);
}

TEST(DriveSection, ASeededMachineHasDrawnDrivesOnDemandAndItsOwnEntriesReplaceThem) {
  const std::string geometry = "random: {grade: worn_trunnion, seed: 7";
  EXPECT_TRUE(parse_truth(geometry + "}", "truth.yaml", machine()).drives.empty());
  EXPECT_TRUE(parse_truth(geometry + ", drives: false}", "truth.yaml", machine()).drives.empty());
  const auto drawn = parse_truth(geometry + ", drives: true}", "truth.yaml", machine());
  ASSERT_EQ(drawn.drives.size(), 3u);
  EXPECT_FALSE(drawn.geometry.beam) << "the machine has no slave";
  // Backlash of C in deg: 6 um at a radius of 100 mm are 60 urad, within a factor of 0.4 .. 1.6.
  const double backlash = drawn.drives.at("C").mechanics->backlash * std::numbers::pi / 180 * 1e6;
  EXPECT_GT(backlash, 0.4 * 60);
  EXPECT_LT(backlash, 1.6 * 60);
  EXPECT_NE(drawn.drives.at("X").mechanics->load_share, drawn.drives.at("Y2").mechanics->load_share);
  EXPECT_EQ(drawn.drives.at("X").mechanics->load_share,
            parse_truth(geometry + ", drives: true}", "truth.yaml", machine())
                .drives.at("X")
                .mechanics->load_share);
  const auto replaced =
      parse_truth("drives: {X: {mechanics: {load_share: 0.6}}}\n" + geometry + ", drives: true}",
                  "truth.yaml", machine());
  EXPECT_EQ(replaced.drives.at("X").mechanics->load_share, 0.6);
  EXPECT_EQ(replaced.drives.at("X").mechanics->coulomb, 0) << "the whole entry, not a part of it";
  EXPECT_EQ(replaced.drives.at("Y2").mechanics->coulomb, drawn.drives.at("Y2").mechanics->coulomb);
}

TEST(DriveSection, ASeededGantryHasADrawnBeamBetweenTheEndsOfItsOtherAxis) {
  auto m = machine();
  m.gantry = 1;
  const auto beam = [&](int seed, const char* more = "") {
    return *parse_truth(
                "random: {grade: new_gantry, drives: true, seed: " + std::to_string(seed) + "}\n" + more,
                "truth.yaml", m)
                .geometry.beam;
  };
  EXPECT_EQ(beam(1).axis, 1u);
  EXPECT_EQ(beam(1).master_foot, Vec3(-400, 0, 0));
  EXPECT_EQ(beam(1).slave_foot, Vec3(400, 0, 0));
  double squares = 0;
  for (int seed = 1; seed <= 400; ++seed) squares += std::pow(beam(seed).misalignment * 1e3, 2);
  // The deviation of new_gantry is 40 um; of 400 squares the mean is known to 7 %.
  EXPECT_NEAR(squares / 400, 40 * 40, 0.25 * 40 * 40);
  EXPECT_EQ(beam(1, "beam: {axis: Y, slave_foot_mm: [900, 0, 0], misalignment_um: 7}").misalignment, 0.007);
  EXPECT_FALSE(parse_truth("random: {grade: new_gantry}", "truth.yaml", m).geometry.beam);
}

TEST(DriveSection, EveryFaultIsOneLineWithItsPlace) {
  const std::vector<std::pair<std::string, std::string>> faults{
      {"drives: {Y: {}}", "1:10: error: unknown key 'Y'; the keys are X, Y2, C"},
      {"drives: {X: {feedback: load}}", "1:14: error: unknown key 'feedback'"},
      {"spindle_drives: {X: {}}", "1:18: error: unknown key 'X'; the keys are S"},
      {"spindle_drives: {S: {inertia_kg_m2: 1}}", "1:21: error: 'torque_Nm' is missing"},
      {"spindle_drives: {S: {inertia_kg_m2: 0, torque_Nm: [[0, 1]]}}",
       "1:37: error: 0 is not within 1e-06 .. 10000"},
      {"spindle_drives: {S: {inertia_kg_m2: 1, torque_Nm: [[0, 1], [0, 2]]}}",
       "1:60: error: the speeds of the torque curve must rise"},
      {"spindle_drives: {S: {inertia_kg_m2: 1, torque_Nm: [5]}}",
       "1:52: error: expected a point [1/min, Nm]"},
      {"spindle_drives: {S: {load_torque_Nm: 5}}", "1:21: error: 'inertia_kg_m2' is missing"},
      {"spindle_drives: {S: {speed_error: 0.6}}", "1:35: error: 0.6 is not within -0.5 .. 0.5"},
      {"spindle_drives: {S: {disturbance: {hz: 5}}}", "1:35: error: 'share' is missing"},
      {"spindle_drives: {S: {gears: []}}", "1:29: error: expected 1 to 5 gears"},
      {"spindle_drives: {S: {gears: [{}]}}", "1:30: error: 'ratio' is missing"},
      {"spindle_drives: {S: {mark_deg: -1}}", "1:32: error: -1 is not within 0 .. 360"},
      {"random: {grade: new_machine, drives: some}", "1:38: error: 'some' is none of false, true"},
      {"drives: {X: {mechanics: {load_share: 1}}}", "1:38: error: 1 is not within 0.02 .. 0.98"},
      {"drives: {X: {mechanics: {locked_frequency_Hz: 400}}}", "1:25: error: the resonance"},
      {"drives: {X: {mechanics: {coulomb: 0.1, breakaway: 0.05}}}",
       "1:51: error: breakaway is less than coulomb"},
      {"drives: {X: {mechanics: {backlash_urad: 3}}}", "1:26: error: unknown key 'backlash_urad'"},
      {"drives: {X: {motor_encoder: {kind: optical}}}",
       "1:36: error: 'optical' is none of absolute, distance_coded, incremental"},
      {"drives: {X: {fault: {kind: fire, at_mm: 1}}}", "1:28: error: 'fire' is none of bus"},
      {"drives: {X: {fault: {kind: bus}}}", "1:21: error: 'at_mm' is missing"},
      {"drives: {X: {fault: {at_mm: 3}}}", "1:21: error: 'kind' is missing"},
      {"drives: {C: {fault: {kind: bus, at_mm: 3}}}", "1:33: error: unknown key 'at_mm'"},
      {"beam: {axis: Y, slave_foot_mm: [9, 0, 0], racking_frequency_Hz: 301}",
       "1:65: error: 301 is not within 1 .. 300"},
      {"beam: {axis: Y, slave_foot_mm: [9, 0, 0], racking_damping_ratio: 2}",
       "1:66: error: 2 is not within 0 .. 1"}};
  for (const auto& [text, expected] : faults) {
    try {
      parse_truth(text, "truth.yaml", machine());
      ADD_FAILURE() << text;
    } catch (const std::runtime_error& e) {
      EXPECT_THAT(e.what(), testing::StartsWith("truth.yaml:" + expected)) << text;
    }
  }
}

}  // namespace
}  // namespace trunnion::truth
