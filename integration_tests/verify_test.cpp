// SPDX-License-Identifier: Apache-2.0
// Services alone against the golden recordings: as recorded, on either vendor; and not when one bit is wrong.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "cluster/cluster_files.hpp"
#include "machine/services.hpp"
#include "verification/verify.hpp"

namespace trunnion::integration {
namespace {

namespace fs = std::filesystem;
using verification::VerifyOptions;

constexpr std::uint64_t wrong_cycle = 700;  // as in variants/one_bit.hpp

VerifyOptions golden(const std::string& machine, const std::string& service) {
  VerifyOptions options;
  options.recording = cluster::find_machine(machine) + "/recordings/golden.mcap";
  options.service = service;
  options.timeout = 20;
  return options;
}

class Stage : public testing::TestWithParam<std::string> {};

TEST_P(Stage, OneWrongBitIsFoundAtItsCycleAndField) {
  auto options = golden("gantry-cb-head", GetParam());
  options.executable = cluster::binary_directory() + "/" + GetParam() + "_one_bit";
  const auto result = verification::verify(options);
  EXPECT_EQ(result.problem, "") << "it answers everything";
  ASSERT_TRUE(result.difference.first.has_value());
  EXPECT_EQ(result.difference.first->topic, GetParam() + "_batch");
  EXPECT_EQ(result.difference.first->index, wrong_cycle);
  EXPECT_EQ(result.difference.first->field, "setpoint.axis0");
  ASSERT_EQ(result.difference.topics.size(), 1u);
  ASSERT_EQ(result.difference.topics[0].fields.size(), 1u);
  EXPECT_EQ(result.difference.topics[0].fields.begin()->second.count, 1u);
  EXPECT_FALSE(result.equal());
}

TEST_P(Stage, IsAsRecordedOnTheOtherVendorToo) {
  auto options = golden("gantry-cb-head", GetParam());
  options.vendor = "fastdds";
  const auto result = verification::verify(options);
  EXPECT_TRUE(result.equal()) << result.problem << text_of(result.difference, "recorded", "written now");
  EXPECT_GT(result.cycles, 500u);
}

INSTANTIATE_TEST_SUITE_P(Stages, Stage, testing::ValuesIn(machine::transforming_stages()),
                         [](const auto& it) { return it.param; });

TEST(Verify, ACompensationWithTheSignOfBacklashTurnedRoundIsFound) {
  auto options = golden("ac-table", "compensation");
  EXPECT_TRUE(verification::verify(options).equal());
  options.executable = cluster::binary_directory() + "/compensation_flipped_backlash";
  const auto result = verification::verify(options);
  EXPECT_EQ(result.problem, "") << "it answers everything";
  ASSERT_TRUE(result.difference.first.has_value());
  EXPECT_EQ(result.difference.first->topic, "compensation_batch");
  EXPECT_FALSE(result.equal());
}

TEST(Verify, AnAngleOfASpindleThatIsWrongInOneBitIsFoundInItsCycle) {
  auto options = golden("gantry-cb-head", "drive");
  const auto right = verification::verify(options);
  EXPECT_TRUE(right.equal()) << right.problem << text_of(right.difference, "recorded", "written now");
  EXPECT_EQ(right.not_compared, "");
  options.executable = cluster::binary_directory() + "/drive_one_bit";
  const auto result = verification::verify(options);
  EXPECT_EQ(result.problem, "") << "it answers everything";
  ASSERT_TRUE(result.difference.first.has_value());
  EXPECT_EQ(result.difference.first->topic, "feedback");
  EXPECT_EQ(result.difference.first->field, "spindle_angle[0]");
  EXPECT_EQ(result.difference.first->meaning, "spindle 1: angle, rev");
  ASSERT_EQ(result.difference.topics.size(), 1u);
  ASSERT_EQ(result.difference.topics[0].fields.size(), 1u);
  EXPECT_EQ(result.difference.topics[0].fields.begin()->second.count, 1u);
  EXPECT_FALSE(result.equal());
}

// The golden recording compensates errors that the machine is not delivered with.
TEST(Verify, SaysThatTheParametersAreTheRecordingsAndUsesTheMachinesWhenAsked) {
  auto options = golden("ac-table", "compensation");
  const auto recorded = verification::verify(options);
  EXPECT_TRUE(recorded.equal());
  EXPECT_EQ(recorded.parameters.rfind("those of the recording, ", 0), 0u) << recorded.parameters;
  EXPECT_NE(recorded.parameters.find(" parameters differ, the first is "), std::string::npos)
      << recorded.parameters;
  options.machine_parameters = true;
  const auto delivered = verification::verify(options);
  EXPECT_EQ(delivered.parameters.rfind("those of " + cluster::find_machine("ac-table") + ", ", 0), 0u)
      << delivered.parameters;
  EXPECT_FALSE(delivered.equal());
  ASSERT_TRUE(delivered.difference.first.has_value()) << delivered.problem;
  EXPECT_EQ(delivered.difference.first->topic, "compensation_batch");
  options.service = "parameters";
  EXPECT_THROW(verification::verify(options), std::runtime_error);
}

TEST(Verify, AServiceThatEndsAtOnceIsAProblemAndNotAWait) {
  auto options = golden("ac-table", "kinematics");
  options.executable = "/bin/false";
  const auto result = verification::verify(options);
  EXPECT_EQ(result.problem, "/bin/false ended with status 1");
  EXPECT_FALSE(result.equal());
}

TEST(Verify, AServiceThatAnswersNothingIsAProblemAfterItsPatience) {
  const auto script = fs::temp_directory_path() / ("trunnion-silent-" + std::to_string(getpid()));
  std::ofstream(script) << "#!/bin/sh\nexec sleep 60\n";
  fs::permissions(script, fs::perms::owner_all);
  auto options = golden("ac-table", "compensation");
  options.executable = script.string();
  options.timeout = 0.5;
  const auto result = verification::verify(options);
  fs::remove(script);
  EXPECT_NE(result.problem.find("wrote nothing more of compensation_batch"), std::string::npos)
      << result.problem;
  EXPECT_FALSE(result.equal());
}

TEST(Verify, ACutOffRecordingIsVerifiedAsFarAsItGoesAndSaidToBe) {
  auto options = golden("ac-table", "kinematics");
  EXPECT_EQ(verification::verify(options).cut_off, "");
  const auto part = fs::temp_directory_path() / ("trunnion-part-" + std::to_string(getpid()) + ".mcap");
  fs::copy_file(options.recording, part);
  fs::resize_file(part, fs::file_size(part) * 3 / 4);
  options.recording = part.string();
  const auto result = verification::verify(options);
  EXPECT_TRUE(result.equal()) << result.problem;
  EXPECT_EQ(result.cut_off.rfind("the file ends ", 0), 0u) << result.cut_off;
  fs::remove(part);
}

TEST(Verify, ARecordingWithAWrongByteIsRefusedAndSaysWhatIsMissing) {
  auto options = golden("ac-table", "kinematics");
  const auto copy = fs::temp_directory_path() / ("trunnion-damaged-" + std::to_string(getpid()) + ".mcap");
  fs::copy_file(options.recording, copy);
  std::fstream file(copy, std::ios::in | std::ios::out | std::ios::binary);
  const auto middle = static_cast<std::streamoff>(fs::file_size(copy) * 2 / 3);
  file.seekg(middle);
  const char wrong = static_cast<char>(file.get() ^ 1);
  file.seekp(middle).put(wrong);
  file.close();
  options.recording = copy.string();
  for (const std::string service : {"kinematics", "gateway"}) {
    options.service = service;
    try {
      verification::verify(options);
      ADD_FAILURE() << service << " is verified";
    } catch (const std::runtime_error& error) {
      EXPECT_EQ(std::string(error.what()).rfind(copy.string() + ": damaged, bytes ", 0), 0u) << error.what();
    }
  }
  fs::remove(copy);
}

}  // namespace
}  // namespace trunnion::integration
