// SPDX-License-Identifier: Apache-2.0
#include "core/manual_calibration_document.hpp"

#include <gmock/gmock.h>

#include "core/measurement_requests.hpp"

namespace trunnion::gateway {
namespace {

using bus::Json;
using calibration::GuideLanguage;
using calibration::ManualKind;

calibration::ChainParameters ac_table() {
  calibration::ChainParameters chain;
  chain.table_1 = geometry::RotaryAxis{{-1, 0, 0}, {0, 0, 0}, 0};
  chain.table_2 = geometry::RotaryAxis{{0, 0, -1}, {-200, -190, -516}, 2};
  return chain;
}

Json readings() {
  return {{"x1", -250.3},  {"x2", -150.42}, {"y1", -240},    {"y2", -140.4},    {"offy_z1", 0.2},
          {"zc_z1", -100}, {"zc_y1", -40},  {"zc_z2", -380}, {"tool_radius", 5}};
}

std::string refused(const Json& body) {
  try {
    evaluate_manual(body, ManualKind::ac_table, ac_table(), 0);
  } catch (const BadRequest& bad) {
    return bad.field + ": " + bad.what();
  }
  return "";
}

TEST(ManualCalibrationDocument, GivesTheStepsInTheLanguageOfTheQuery) {
  const auto english = guide_document(ManualKind::ac_table, guide_language(""), 30, ac_table());
  const auto german = guide_document(ManualKind::ac_table, guide_language("de"), 30, ac_table());
  EXPECT_EQ(english["kind"], "ac-table");
  EXPECT_EQ(english["steps"][0]["readings"][0]["name"], "x1");
  EXPECT_EQ(german["steps"][0]["readings"][0]["name"], "x1");
  EXPECT_NE(german["steps"][0]["do"], english["steps"][0]["do"]);
  ASSERT_EQ(english["poses"].size(), 9u);
  EXPECT_EQ(english["poses"][1], "A0 C90");
  EXPECT_EQ(english["poses"][5], "A30 C0");
  EXPECT_EQ(english["vectors"][0]["axis"], "C");
  EXPECT_THROW(guide_language("fr"), BadRequest);
}

TEST(ManualCalibrationDocument, ReadingsGiveTheVectorsOfTheManualsFormulas) {
  const auto result = evaluate_manual({{"readings", readings()}}, ManualKind::ac_table, ac_table(), 0);
  // C: the middle of the bore, (-250.3 - 150.42) / 2 and (-240 - 140.4) / 2. A: half of 0.2, as A90 is the
  // angle. Z: -100 + (-40 - 0.1 + 5) - 380, by the two touches, the radius and the length.
  const auto& c = result.document["after"][0]["offset_mm"];
  EXPECT_NEAR(c[0].get<double>(), -200.36, 1e-9);
  EXPECT_NEAR(c[1].get<double>(), -190.2, 1e-9);
  EXPECT_NEAR(c[2].get<double>(), -515.1, 1e-9);
  EXPECT_NEAR(result.document["after"][1]["offset_mm"][1].get<double>(), 0.1, 1e-9);
  EXPECT_EQ(result.document["changes"].size(), 4u);
  EXPECT_EQ(result.values.size(), 4u);
  EXPECT_FALSE(result.document.contains("accepted"));
  const auto request = calibration_request(result.values, "ann");
  EXPECT_EQ(request.who, "ann calibrate");
  EXPECT_EQ(request.operation, idl::parameters::Operation::IMPORT);
  EXPECT_EQ(request.values.size(), 4u);
}

TEST(ManualCalibrationDocument, DisplacementsWithinTheirLimitsChangeNothing) {
  Json small = Json::array(), large = Json::array();
  for (int i = 0; i < 9; ++i) small.push_back({0.001, -0.002, 0});
  large = small;
  large[2] = {0.101, -0.002, 0};  // C180: the ball is 0.1 mm beside its place at C0
  auto result = evaluate_manual({{"displacements", small}}, ManualKind::ac_table, ac_table(), 0);
  EXPECT_EQ(result.document["accepted"], true);
  EXPECT_EQ(result.document["acceptance"].size(), 8u);
  EXPECT_TRUE(result.values.empty());
  result = evaluate_manual({{"displacements", large}, {"alpha", 30}}, ManualKind::ac_table, ac_table(), 0);
  EXPECT_EQ(result.document["accepted"], false);
  // The axis of C is half of that beside where it was: X of its vector.
  EXPECT_NEAR(result.document["after"][0]["offset_mm"][0].get<double>(), -199.95, 1e-9);
}

TEST(ManualCalibrationDocument, WhatCannotBeMeantIsRefusedWithItsField) {
  EXPECT_EQ(refused(Json::object()), "readings: give readings or displacements");
  EXPECT_EQ(refused({{"readings", readings()}, {"displacements", Json::array()}}),
            "readings: give readings or displacements");
  auto wrong = readings();
  wrong.erase("zc_z2");
  EXPECT_THAT(refused({{"readings", wrong}}), testing::HasSubstr("zc_z2 is missing"));
  wrong = readings();
  wrong["x1"] = "5";
  EXPECT_EQ(refused({{"readings", wrong}}), "readings: reading x1 must be a number");
  wrong["x1"] = 1e9;
  EXPECT_THAT(refused({{"readings", wrong}}), testing::HasSubstr("100000"));
  EXPECT_EQ(refused({{"displacements", {1, 2}}}),
            "displacements: displacements must be nine of [x, y, z] in mm");
  Json rows = Json::array();
  for (int i = 0; i < 9; ++i) rows.push_back({0, 0, i == 8 ? 200 : 0});
  EXPECT_THAT(refused({{"displacements", rows}}), testing::StartsWith("displacements: "));
  EXPECT_THAT(refused({{"displacements", rows}, {"alpha", 4}}), testing::StartsWith("alpha: "));
  EXPECT_THAT(refused({{"reading", 1}}), testing::HasSubstr("reading"));
}

}  // namespace
}  // namespace trunnion::gateway
