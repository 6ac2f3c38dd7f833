// SPDX-License-Identifier: Apache-2.0
// The report on runs whose errors, times and gaps are known because the test made them.
#include "report/report.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "synthetic_run.hpp"

namespace trunnion::report {
namespace {

// Exact stops, so that no corner is rounded.
const std::string straight = "G54 G90 G61\nG0 X10 Y5 Z10\nG1 X60 F3000\nM30\n";

class ReportOfARun : public testing::Test {
 protected:
  std::string file = testing::TempDir() + "/report_" + std::to_string(getpid()) + ".mcap";
  test::RunOptions run;
  void SetUp() override {
    run.file = file;
    run.program = straight;
  }
  void TearDown() override { std::filesystem::remove(file); }
  Report report(TrueTip true_tip = {}) {
    cycles = test::record_run(run);
    ReportInputs inputs;
    inputs.program_name = "program.nc";
    inputs.program_text = run.program;
    inputs.true_tip = std::move(true_tip);
    return make_report(file, inputs);
  }
  std::uint64_t cycles = 0;
};

TEST_F(ReportOfARun, ALineWithoutErrorHasNone) {
  const auto r = report();
  EXPECT_EQ(r.problem, "");
  EXPECT_EQ(r.cycles, cycles);
  EXPECT_EQ(r.executed, cycles);
  EXPECT_GT(r.commanded_feed.cycles, 900u);  // 50 mm at 50 mm/s
  EXPECT_EQ(r.commanded_feed.cycles + r.commanded_rapid.cycles, cycles);
  EXPECT_LT(r.commanded_feed.largest, 1e-9);
  EXPECT_LT(r.actual_feed.largest, 1e-9);
  EXPECT_LT(r.residual_largest, 1e-9);
  EXPECT_NEAR(r.largest_feed, 3000, 0.01);
  EXPECT_EQ(r.machine, "ac-table");
}

// The line is cut along X by 50 mm. The true machine is 4 um off across it, and 2 um more while X goes down.
TEST_F(ReportOfARun, TheTrueTipIsThatOfTheGivenGeometryAndOfTheDirectionOfApproach) {
  EXPECT_EQ(report().true_feed.cycles, 0u) << "no geometry is given";
  run.program = "G54 G90 G61\nG0 X10 Y5 Z10\nG1 X60 F3000\nG1 X10\nM30\n";
  const auto there =
      report([](const language::AxisValues& loads, const std::array<int, 9>& approach, double length) {
        EXPECT_EQ(length, 0) << "no tool is called";
        // Work zero of ac_table(): (0, 0, -380).
        return Vec3(loads[0], loads[1] + 0.004 - (approach[0] < 0 ? 0.002 : 0), loads[2]);
      });
  EXPECT_LT(there.actual_feed.largest, 1e-9);
  EXPECT_EQ(there.true_feed.cycles, there.actual_feed.cycles);
  EXPECT_NEAR(there.true_feed.largest, 0.004, 1e-9);
  // Half of the cycles each: sqrt((4^2 + 2^2) / 2) = 3.162 um, but for the cycles at the corner.
  EXPECT_NEAR(there.true_feed.rms, 0.003162, 0.000010);
  EXPECT_NE(terminal_text(there).find("Contour error, true tip"), std::string::npos);
  EXPECT_EQ(nlohmann::json::parse(json_text(there))["contour_error"]["true_tip_feed"]["max_mm"],
            there.true_feed.largest);
}

// 3 um of Y are across the line, 5 um of X along it: only the first is a contour error.
TEST_F(ReportOfARun, OnlyTheDistanceFromThePathCounts) {
  run.encoder_error = [](std::uint64_t, std::array<double, 5>& axes) {
    axes[0] += 0.005;
    axes[1] += 0.003;
  };
  const auto r = report();
  // Where the line ends the point lies 5 um beyond the corner too: 5.83 um at most.
  EXPECT_NEAR(r.actual_feed.rms, 0.003, 3e-4);
  EXPECT_GE(r.actual_feed.largest, 0.003 - 1e-12);
  EXPECT_LE(r.actual_feed.largest, std::hypot(0.003, 0.005) + 1e-12);
  EXPECT_LT(r.commanded_feed.largest, 1e-9);
}

// Y goes 5 mm to its line and stays there: with 20 um of play its load stops 10 um before. So does Z, which
// comes from below. On the line along X the load is off by 10 um in both directions across it.
TEST_F(ReportOfARun, ThePlayOfAnAxisIsAContourErrorBehindItsEncoder) {
  run.program = "G54 G90 G61\nG0 X10 Y5 Z8\nG1 Z10 F3000\nG1 X60 F3000\nM30\n";
  EXPECT_LT(report().actual_feed.largest, 1e-9);
  run.play = {0, 0.02, 0.02, 0, 0};
  const auto r = report();
  EXPECT_NEAR(r.actual_feed.largest, std::hypot(0.01, 0.01), 1e-9);
  EXPECT_LT(r.commanded_feed.largest, 1e-9);
  EXPECT_EQ(r.actual_feed.cycles, r.commanded_feed.cycles);
}

// Tables of compensation add 59.6 um to Y on purpose. 3 um more of the encoder are an error.
TEST_F(ReportOfARun, WhatCompensationAddsIsNoErrorOfTheAxes) {
  run.compensation = [](std::uint64_t, std::array<double, 5>& axes) { axes[1] += 0.0596; };
  const auto exact = report();
  EXPECT_LT(exact.actual_feed.largest, 1e-9);
  EXPECT_LT(exact.actual_rapid.largest, 1e-9);
  EXPECT_NEAR(exact.residual_largest, 0.0596, 1e-9);
  EXPECT_NE(terminal_text(exact).find("Compensation of the tip      max 59.600 um"), std::string::npos)
      << terminal_text(exact);
  run.encoder_error = [](std::uint64_t, std::array<double, 5>& axes) { axes[1] += 0.003; };
  EXPECT_NEAR(report().actual_feed.largest, 0.003, 1e-9);
}

// 25 mm from R to the depth and 25 mm back, at 500 mm/min: 3 s each, which are 6000 cycles.
TEST_F(ReportOfARun, TheStrokeOfATapIsProgrammedMotionAtFeed) {
  run.program = "G54 G90 G61\nG0 X10 Y10 Z20\nS500\nG84 Z-20 R5 F500\nG80\nM30\n";
  const auto r = report();
  EXPECT_EQ(r.problem, "");
  EXPECT_NEAR(r.programmed.feed_length, 50, 1e-9);
  EXPECT_GT(r.commanded_feed.cycles, 6000u);
  EXPECT_EQ(r.commanded_feed.line, 4u);
  EXPECT_LT(r.commanded_feed.largest, 1e-9);
  EXPECT_LT(r.commanded_rapid.largest, 1e-9);
}

TEST_F(ReportOfARun, OneBadCycleIsTheLargestAndIsNamed) {
  run.encoder_error = [](std::uint64_t n, std::array<double, 5>& axes) { axes[2] += n == 1500 ? 0.02 : 0; };
  const auto r = report();
  EXPECT_NEAR(r.actual_feed.largest, 0.02, 1e-9);
  EXPECT_EQ(r.actual_feed.cycle, test::first_cycle + 1500);
  EXPECT_EQ(r.actual_feed.line, 3u);
}

TEST_F(ReportOfARun, MissingBatchesAreLostCycles) {
  run.skipped_batch = 20;
  const auto r = report();
  EXPECT_EQ(r.lost.at("gantry_batch"), test::batch_cycles);
  EXPECT_EQ(r.lost.at("path_batch"), 0u);
  EXPECT_EQ(r.lost.at("feedback"), 0u);
  EXPECT_EQ(r.residual_cycles, cycles - test::batch_cycles);
}

TEST_F(ReportOfARun, ALateRecordingIsAProblem) {
  run.late_batches = 5;
  const auto r = report();
  EXPECT_EQ(r.problem, "the recording starts after the start of the motion");
  EXPECT_EQ(r.cycles, cycles - 5 * test::batch_cycles);
}

TEST_F(ReportOfARun, CopiesOfTwinsAreNeitherLostNorCountedTwice) {
  run.replicas = true;
  const auto r = report();
  EXPECT_EQ(r.lost.at("kinematics_batch"), 0u);
  EXPECT_EQ(r.repeated_batches, (cycles + test::batch_cycles - 1) / test::batch_cycles);
  EXPECT_EQ(r.cycles, cycles);
}

TEST_F(ReportOfARun, LatenciesAndSpeedComeFromTheTimeStamps) {
  run.replicas = true;  // the later replica must not count
  const auto r = report();
  ASSERT_EQ(r.latencies.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(r.latencies[i].median, 1e-9 * static_cast<double>(test::stage_latency[i]), 1e-12);
    EXPECT_NEAR(r.latencies[i].largest, r.latencies[i].median, 1e-12);
  }
  EXPECT_EQ(r.latencies[3].to, "drive feedback");
  // Eight cycles of 1 ms every 2 ms; the last batch may hold fewer.
  EXPECT_NEAR(r.speed, 4, 0.05);
}

TEST_F(ReportOfARun, TheHashSeesASingleBitOfTheCommands) {
  const auto first = report();
  const auto second = report();
  EXPECT_EQ(first.command_hash, second.command_hash);
  run.encoder_error = [](std::uint64_t, std::array<double, 5>& axes) { axes[0] += 1; };
  EXPECT_EQ(report().command_hash, first.command_hash) << "encoders are not commands";
  run.program = "G54 G90 G61\nG0 X10 Y5 Z10\nG1 X60.0000001 F3000\nM30\n";
  EXPECT_NE(report().command_hash, first.command_hash);
}

TEST_F(ReportOfARun, ARecordingThatWasCutOffIsReportedAsFarAsItGoes) {
  run.cut_off = true;
  const auto r = report();
  EXPECT_NE(r.problem.find("the file ends"), std::string::npos) << r.problem;
  EXPECT_EQ(r.cycles, cycles);
  EXPECT_LT(r.commanded_feed.largest, 1e-9);
}

TEST_F(ReportOfARun, ADifferentProgramIsSeenAsContourError) {
  test::record_run(run);
  ReportInputs inputs;
  inputs.program_text = "G54 G90 G61\nG0 X10 Y5 Z10\nG1 X60 Y6 F3000\nM30\n";
  EXPECT_NEAR(make_report(file, inputs).commanded_feed.largest, 1, 0.01);
}

TEST_F(ReportOfARun, TheConeKeepsItsToleranceAndItsKinematicsCloses) {
  std::ifstream in(PROGRAMS_DIRECTORY "/nas979_cone.nc");
  std::stringstream text;
  text << in.rdbuf();
  run.program = text.str();
  ASSERT_FALSE(run.program.empty());
  // Each axis a few micrometres off in its own rhythm, as a servo does.
  run.encoder_error = [](std::uint64_t n, std::array<double, 5>& axes) {
    for (int a = 0; a < 3; ++a)
      axes[static_cast<std::size_t>(a)] += 0.002 * std::sin(0.003 * (a + 1) * static_cast<double>(n));
    axes[3] += 0.001;
  };
  const auto r = report();
  EXPECT_EQ(r.problem, "");
  EXPECT_GT(r.commanded_feed.largest, 0);
  EXPECT_LE(r.commanded_feed.largest, 0.01) << "contour tolerance 040901";
  EXPECT_LT(r.residual_largest, 1e-9);
  EXPECT_GT(r.actual_feed.largest, r.commanded_feed.rms);
  // 2 um of each linear axis, and 1 mdeg of A on an arm of less than 100 mm.
  EXPECT_LE(r.actual_feed.largest, 0.01 + 0.002 * std::sqrt(3) + 0.001 * M_PI / 180 * 100);
  const std::string directory = testing::TempDir() + "/report_cone_" + std::to_string(getpid());
  write_report(r, directory);
  for (const auto* name : {"report.json", "report.txt", "path.svg", "feed.svg"})
    EXPECT_GT(std::filesystem::file_size(directory + "/" + name), 500u) << name;
  std::ifstream json_file(directory + "/report.json");
  const auto json = nlohmann::json::parse(json_file);
  EXPECT_EQ(json["cycles"], cycles);
  EXPECT_EQ(json["contour_error"]["encoders_feed"]["max_mm"], r.actual_feed.largest);
  EXPECT_NE(terminal_text(r).find("Contour error, encoders"), std::string::npos);
  if (std::getenv("KEEP_REPORT") == nullptr) std::filesystem::remove_all(directory);
}

TEST(Report, SaysWhatItCannotDo) {
  EXPECT_THROW(make_report("/nowhere/run.mcap", {}), std::runtime_error);
  EXPECT_THROW(make_report("/dev/null", {}), std::runtime_error) << "no parameters";
  EXPECT_THROW(write_report({}, "/dev/null/report"), std::runtime_error);
}

TEST(Report, ARecordingWithoutMotionStillGivesEveryFile) {
  ReportInputs inputs;
  inputs.parameters = test::ac_table().parameters;
  const auto r = make_report("/dev/null", inputs);
  EXPECT_NE(r.problem, "");
  EXPECT_NE(path_picture(r).find("</svg>"), std::string::npos);
  EXPECT_NE(feed_picture(r).find("</svg>"), std::string::npos);
  EXPECT_EQ(path_picture(r).find("nan"), std::string::npos);
  EXPECT_EQ(feed_picture(r).find("inf\""), std::string::npos);
}

}  // namespace
}  // namespace trunnion::report
