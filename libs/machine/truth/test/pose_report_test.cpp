// SPDX-License-Identifier: Apache-2.0
#include "truth/pose_report.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "ac_report.hpp"

namespace trunnion::truth {
namespace {

TEST(PoseReport, GivesTipAxisAndTheirDeviations) {
  auto r = report("axes: {Y: {C0Y_urad: 10}}\n");
  r.tool_length = 100;
  // C0Y of 10 urad over 200 mm: 2 um towards -X; second order 200 mm * (1e-5)^2 / 2 = 1e-8 mm.
  EXPECT_EQ(text_of(*r.answer("X10 Y200 Z-5", 1)),
            "9.998000 200.000000 -105.000000 0.000000000 0.000000000 1.000000000 "
            "-2.000 0.000 0.000 0.000 0.000 0.000");
}

TEST(PoseReport, TheApproachIsTheDirectionFromTheLineBefore) {
  auto r = report("axes: {X: {EXX: [{reversal_um: 6}]}}\n");
  EXPECT_NEAR(r.answer("X10", 1)->deviation.tip.x(), 0, 1e-12) << "not known yet";
  EXPECT_NEAR(r.answer("X20", 2)->deviation.tip.x(), 3e-3, 1e-12);
  EXPECT_NEAR(r.answer("Y5 X20", 3)->deviation.tip.x(), 3e-3, 1e-12) << "X has not moved";
  EXPECT_NEAR(r.answer("X10", 4)->deviation.tip.x(), -3e-3, 1e-12);
}

TEST(PoseReport, EmptyLinesAndCommentsAreNoPoses) {
  auto r = report("");
  EXPECT_FALSE(r.answer("", 1));
  EXPECT_FALSE(r.answer(" \t# X10", 2));
  EXPECT_TRUE(r.answer("X10Y-.5 ; start", 3));
}

TEST(PoseReport, AFaultNamesLineAndColumn) {
  auto r = report("");
  const auto refusal = [&](const std::string& line) {
    try {
      r.answer(line, 7);
    } catch (const std::runtime_error& e) {
      return std::string(e.what());
    }
    return std::string("taken");
  };
  EXPECT_EQ(refusal("X10 B5"), "7:5: expected a word of one of the axes XYZAC, for example X10.5");
  EXPECT_EQ(refusal("X10 10"), "7:5: expected a word of one of the axes XYZAC, for example X10.5");
  EXPECT_EQ(refusal("X1 Y2 X3"), "7:7: axis X is there twice");
  EXPECT_EQ(refusal("X1 Y2mm"), "7:5: '2mm' is not a number");
  EXPECT_EQ(refusal("X1 Y"), "7:5: '' is not a number");
  EXPECT_EQ(refusal("X1 Yinf"), "7:5: 'inf' is not a number");
  EXPECT_EQ(refusal("X1e7"), "7:2: 1e7 is not within -1000000 .. 1000000");
}

TEST(PoseReport, TheModelWithTheMeasuredCorrectionLeavesNoDeviation) {
  // The table axis C of the machine is 20 um beside its design, and the control knows it.
  const auto truth = parse_truth("axes: {C: {XOC_um: 20, YOC_um: -10}}\n", "truth.yaml", ac).geometry;
  auto measured = ac.design;
  measured.table_2->correction = Vec3(0.02, -0.01, 0);
  measured.table_1->correction = Vec3(-0.02, 0.01, 0);
  PoseReport before(make_geometry(truth, ac, ""), geometry::make(ac.design), ac);
  PoseReport after(make_geometry(truth, ac, ""), geometry::make(measured), ac);
  EXPECT_GT(before.summary(200, 1).tip.maximum, 0.03);
  EXPECT_LT(after.summary(200, 1).tip.maximum, 1e-10);
}

TEST(PoseReport, TheSummaryIsThatOfTheTravelAndOfItsSeed) {
  auto r = report("axes: {X: {EXX: [{polynomial_um: [0, 10], unit_mm: 400}]}}\n");
  const auto summary = r.summary(20000, 3);
  // |10 um * x / 400 mm| of an even distribution of x in +-400 mm: mean 5, 95 % below 9.5, at most 10 um.
  EXPECT_NEAR(summary.tip.mean, 5e-3, 1e-4);
  EXPECT_NEAR(summary.tip.percentile_95, 9.5e-3, 1e-4);
  EXPECT_LE(summary.tip.maximum, 10e-3 + 1e-12);
  EXPECT_LT(summary.axis.maximum, 1e-12);
  EXPECT_EQ(r.summary(100, 4).tip.mean, r.summary(100, 4).tip.mean);
  EXPECT_NE(r.summary(100, 4).tip.mean, r.summary(100, 5).tip.mean);
}

}  // namespace
}  // namespace trunnion::truth
