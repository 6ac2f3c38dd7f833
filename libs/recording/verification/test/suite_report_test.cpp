// SPDX-License-Identifier: Apache-2.0
#include "verification/suite_report.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace trunnion::verification {
namespace {

using testing::HasSubstr;
using testing::Not;

constexpr const char* different =
    R"({"equal": false, "problem": "", "missing": [], "first": {"topic": "kinematics_batch",
  "series": "channel 0", "cycle": 12, "field": "setpoints[1] <Y>", "around": [{"index": 11, "a": "1.5", "b": "1.5"},
  {"index": 12, "a": "1.6", "b": "1.7"}, {"index": 13, "a": "1.7", "b": ""}]}})";

SuiteResult judged(int status, const std::string& output, const std::string& last_words = "") {
  SuiteResult result{"m/ac-table/recordings/golden.mcap", "kinematics", 0.25, false, "", {}};
  judge(result, status, output, last_words);
  return result;
}

TEST(SuiteReport, JudgesByTheStatusAndTellsTheFirstDifference) {
  EXPECT_TRUE(judged(0, R"({"equal": true})").passed);
  const auto result = judged(1, different);
  EXPECT_FALSE(result.passed);
  EXPECT_EQ(result.problem, "first difference: kinematics_batch, channel 0, cycle 12, setpoints[1] <Y>");
  EXPECT_EQ(judged(1, R"({"equal": true, "problem": "", "missing": ["backlash"]})").problem,
            "required, and not in the recording: backlash");
  EXPECT_EQ(judged(1, R"({"error": "r.mcap: damaged, bytes 7 to 9"})").problem,
            "r.mcap: damaged, bytes 7 to 9");
  // Neither a status without an answer nor an answer of another shape is a success.
  EXPECT_EQ(judged(0, "", "cannot open x").problem, "cannot open x");
  EXPECT_FALSE(judged(0, "[1]").passed);
  EXPECT_FALSE(judged(139, "").problem.empty());
  EXPECT_FALSE(judged(1, R"({"first": {"around": 7}, "missing": 1, "problem": 2})").problem.empty());
}

TEST(SuiteReport, AProblemDoesNotHideTheFirstDifference) {
  const auto result = judged(1, R"({"problem": "the network was interrupted", "first": {"topic": "plc_state",
    "series": "", "cycle": 12, "field": "inputs[1]", "around": []}})");
  EXPECT_THAT(result.problem, HasSubstr("the network was interrupted; first difference: plc_state"));
}

TEST(SuiteReport, SaysWhichSpindleTheFirstDifferenceIsOf) {
  const auto result = judged(1, R"({"problem": "", "first": {"topic": "feedback", "series": "", "cycle": 413,
    "field": "spindle_angle[1]", "meaning": "spindle 2: angle, rev", "around": []}})");
  EXPECT_EQ(result.problem,
            "first difference: feedback, cycle 413, spindle_angle[1] (spindle 2: angle, rev)");
}

constexpr const char* idle = R"({"equal": false, "skipped": "it had nothing to do"})";

TEST(SuiteReport, WhatARecordingHasNothingForIsSkippedWithItsReasonAndIsNoFailure) {
  const auto skipped = judged(1, idle);
  EXPECT_FALSE(skipped.passed);
  EXPECT_FALSE(skipped.failed());
  EXPECT_EQ(skipped.problem, "it had nothing to do");
  const auto passed = judged(0, R"({"equal": true})");
  EXPECT_TRUE(is_passed({passed, skipped}));
  EXPECT_FALSE(is_passed({skipped})) << "nothing was verified";
  EXPECT_FALSE(is_passed({passed, skipped, judged(1, different)}));
  const auto xml = junit_of("t", {passed, skipped});
  EXPECT_THAT(xml, HasSubstr("tests=\"2\" failures=\"0\" skipped=\"1\">"));
  EXPECT_THAT(xml, HasSubstr("<skipped message=\"it had nothing to do\"/>"));
  const auto page = html_of("t", {passed, skipped});
  EXPECT_THAT(page, HasSubstr("all as recorded</span>, 1 skipped"));
  EXPECT_THAT(page, HasSubstr("skipped: it had nothing to do"));
  EXPECT_THAT(html_of("t", {skipped}), HasSubstr("nothing is verified"));
}

TEST(SuiteReport, JunitCountsFailuresByRecordingAndEscapesTexts) {
  const auto xml = junit_of("A & B", {judged(0, R"({"equal": true})"), judged(1, different)});
  EXPECT_THAT(xml, HasSubstr("<testsuites name=\"A &amp; B\" tests=\"2\" failures=\"1\">"));
  EXPECT_THAT(xml,
              HasSubstr("<testsuite name=\"ac-table/golden\" tests=\"2\" failures=\"1\" time=\"0.500\">"));
  EXPECT_THAT(xml, HasSubstr("setpoints[1] &lt;Y&gt;\"/>"));
}

TEST(SuiteReport, ThePagePlotsBothSidesOfTheFirstDifferenceWhenTheyAreNumbers) {
  const auto page = html_of("t", {judged(1, different)});
  EXPECT_THAT(page, HasSubstr("<svg"));
  EXPECT_THAT(page, HasSubstr("<tr class=\"first\"><td>12</td><td>1.6</td><td>1.7</td></tr>"));
  EXPECT_THAT(page, HasSubstr("<td>13</td><td>1.7</td><td>-</td>"));
  auto words = judged(1, different);
  for (auto& row : words.report["first"]["around"]) row["a"] = "RUNNING";
  EXPECT_THAT(html_of("t", {words}), Not(HasSubstr("<svg")));
}

}  // namespace
}  // namespace trunnion::verification
