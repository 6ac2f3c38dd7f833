// SPDX-License-Identifier: Apache-2.0
#include "truth/truth_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "outline.hpp"
#include "truth/random_machine.hpp"

namespace trunnion::truth {
namespace {

GeometryTruth parsed(const std::string& text) { return parse_truth(text, "truth.yaml", ac).geometry; }

std::string refusal(const std::string& text) {
  try {
    parse_truth(text, "truth.yaml", ac);
  } catch (const std::runtime_error& e) {
    return e.what();
  }
  return "taken";
}

TEST(TruthFile, AnEmptyOneIsIdeal) {
  EXPECT_TRUE(parsed("").ideal());
  EXPECT_TRUE(parsed("# nothing\n").ideal());
  EXPECT_TRUE(parsed("structure: \"w C' A' b X Y Z (S) t\"\n").ideal());
}

TEST(TruthFile, EveryTermHasItsUnits) {
  const auto truth = parsed(R"(
axes:
  X:
    EXX:
      - {polynomial_um: [1, 10], origin_mm: -400, unit_mm: 1000}
      - {harmonic_um: 2, period_mm: 10, phase_deg: 90}
      - {table_um: [0, 8], positions_mm: [0, 100]}
      - {reversal_um: 6}
      - {polynomial_um: [3], approach: positive}
    EAX:
      - {harmonic_urad: 40, period_deg: 180, position_of: A}
)");
  const auto& errors = truth.axes[0].errors;
  ASSERT_EQ(errors.size(), 2u);
  // At X100 after a positive approach: 1 + 10 * 0.5 + 2 + 8 + 3 + 3 = 22 um.
  EXPECT_NEAR(errors[0].function.value(100, 1), 22e-3, 1e-15);
  EXPECT_EQ(errors[1].source, 3u);
  EXPECT_EQ(errors[1].component, 3u);
  EXPECT_NEAR(errors[1].function.value(45, 0), 40e-6, 1e-18);
}

TEST(TruthFile, LocationErrorsAndHeatHaveTheirUnits) {
  const auto truth = parsed(R"(
axes:
  Y: {C0Y_urad: 20}
  C:
    XOC_um: 12
    B0C_urad: -30
    thermal: {rise_K_per_rpm: 0.6, shift_um_per_K: [0, 0, 3]}
  X: {thermal: {rise_K_per_m_per_min: 0.1, expansion_um_per_m_K: 11}}
spindle: {AOS_urad: 5, thermal: {rise_K_per_1000_rpm: 2, time_constant_s: 900}}
)");
  EXPECT_LE((truth.axes[1].inclination - Vec3(0, 0, 20e-6)).norm(), 1e-18);
  EXPECT_NEAR(truth.axes[5].displacement.x(), 12e-3, 1e-18);
  EXPECT_NEAR(truth.axes[5].inclination.y(), -30e-6, 1e-18);
  EXPECT_NEAR(truth.heat[5].rise_per_speed, 0.1, 1e-15) << "1 1/min is 6 deg/s";
  EXPECT_NEAR(truth.heat[0].rise_per_speed, 0.006, 1e-15) << "1 m/min is 16.7 mm/s";
  EXPECT_NEAR(truth.heat[0].expansion, 11e-6, 1e-18);
  EXPECT_EQ(truth.heat[spindle_source].rise_per_speed, 2e-3);
  EXPECT_EQ(truth.heat[spindle_source].time_constant, 900);
}

TEST(TruthFile, AnExplicitLocationErrorReplacesADrawnOne) {
  const auto drawn = parsed("random: {grade: worn_trunnion, seed: 7}\n");
  const auto both = parsed("axes: {Y: {C0Y_urad: 1}}\nrandom: {grade: worn_trunnion, seed: 7}\n");
  EXPECT_EQ(both.axes[1].inclination.z(), 1e-6);
  EXPECT_EQ(both.axes[2].inclination, drawn.axes[2].inclination);
}

TEST(TruthFile, InstrumentsHaveTheirNoiseAndResolution) {
  const auto instruments = parse_truth(R"(
instruments:
  ballbar: {noise_um: 0.3, resolution_um: 0.1, seed: 5}
  laser_angle: {noise_urad: 0.5}
)",
                                       "truth.yaml", ac)
                               .instruments;
  EXPECT_DOUBLE_EQ(instruments.at("ballbar").noise, 0.3e-3);
  EXPECT_DOUBLE_EQ(instruments.at("ballbar").resolution, 1e-4);
  EXPECT_EQ(instruments.at("ballbar").seed, 5u);
  EXPECT_DOUBLE_EQ(instruments.at("laser_angle").noise, 0.5e-6);
}

TEST(TruthFile, EveryFaultIsOneLineWithItsPlace) {
  const std::vector<std::pair<std::string, std::string>> faults{
      {"axis: {}",
       "1:1: error: unknown key 'axis'; the keys are structure, random, axes, spindle, beam, drives, "
       "spindle_drives, instruments, probe, solids"},
      {"axes: {X: {EXY: []}}",
       "1:12: error: unknown key 'EXY'; the keys are reference_point_mm, thermal, EXX"},
      {"axes: {B: {}}", "1:11: error: the machine has no linear or rotary axis 'B' in its kinematic chain"},
      {"axes: {Y: {C0Y_um: 3}}", "1:12: error: unknown key 'C0Y_um'"},
      {"axes: {X: {C0X_urad: 3}}", "1:12: error: unknown key 'C0X_urad'"},
      {"axes: {Y: {C0Y_urad: 3e6}}", "1:22: error: 3e6 is not within -100000 .. 100000"},
      {"axes: {Y: {C0Y_urad: much}}", "1:22: error: 'much' is not a number"},
      {"axes: {Y: {C0Y_urad: nan}}", "1:22: error: 'nan' is not a number"},
      {"axes: {X: {EXX: [{harmonic_urad: 2}]}}", "1:18: error: a term has one of polynomial_um"},
      {"axes: {X: {EXX: [{harmonic_um: 2}]}}", "1:18: error: 'period_mm' is missing"},
      {"axes: {X: {EXX: [{harmonic_um: 2, period_mm: 0}]}}", "1:46: error: 0 is not within 0.001 .. 100000"},
      {"axes: {X: {EXX: [{table_um: [1, 2], positions_mm: [0]}]}}", "1:29: error: 2 values for 1 positions"},
      {"axes: {X: {EXX: [{table_um: [1, 2], positions_mm: [5, 5]}]}}",
       "1:55: error: the positions must ascend"},
      {"axes: {X: {EXX: [{reversal_um: 2, period_mm: 3}]}}", "1:35: error: unknown key 'period_mm'"},
      {"axes: {X: {EXX: [], EXX: []}}", "1:17: error: expected a list of 1 .. 32 terms"},
      {"structure: w C' A' X Y Z t", "1:12: error: 'X': axes with ' are before b, axes without it after b"},
      {"structure: \"w A' C' b X Y Z (S) t\"",
       "1:12: error: the rotary axes from the workpiece to the tool are C' A', not A' C'"},
      {"random: {grade: perfect, seed: 1}",
       "1:17: error: 'perfect' is none of new_gantry, new_machine, worn_trunnion"},
      {"random: {seed: 1}", "1:9: error: 'grade' is missing"},
      {"beam: {axis: Y, slave_foot_mm: [0, 9, 0]}",
       "1:7: error: the feet of the beam must be 1 mm or more apart"},
      {"axes: {X: [", "truth.yaml:"}};
  for (const auto& [text, expected] : faults) {
    const auto found = refusal(text);
    EXPECT_THAT(found, testing::StartsWith(expected == "truth.yaml:" ? expected : "truth.yaml:" + expected))
        << text;
    EXPECT_EQ(found.find('\n'), std::string::npos) << text;
  }
}

}  // namespace
}  // namespace trunnion::truth
