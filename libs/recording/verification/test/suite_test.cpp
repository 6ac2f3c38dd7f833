// SPDX-License-Identifier: Apache-2.0
#include "verification/suite.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "testing_support/refusal.hpp"

namespace trunnion::verification {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

std::vector<VerifiedProcess> two_channels(const SuiteEntry&) {
  return {{"kinematics", 0}, {"compensation", 0}, {"channel", 0}, {"channel", 1}};
}

std::string error_of(const std::string& text) {
  return testing_support::refusal_of([&] { tests_of(parse_suite(text, "dir/suite.yaml"), two_channels); });
}

TEST(Suite, PathsCountFromItsFileAndWhatItSaysBecomesTheArgumentsOfVerify) {
  const auto suite = parse_suite(
      "title: Ours\ntimeout: 30\ntests:\n  - recording: r/golden.mcap\n    services: [compensation]\n    "
      "vendor: fastdds\n"
      "    executables: {compensation: ../build/own}\n    tolerances: {actual: 1e-4}\n"
      "    require: {compensation: [backlash, pitch error]}\n",
      "ci/suite.yaml");
  EXPECT_EQ(suite.title, "Ours");
  const auto tests = tests_of(suite, two_channels);
  ASSERT_EQ(tests.size(), 1u);
  EXPECT_EQ(tests[0].name, "compensation");
  EXPECT_THAT(
      verify_arguments(suite, tests[0]),
      ElementsAre("verify", "--json", "--service", "compensation", "--recording", "ci/r/golden.mcap",
                  "--timeout", "30", "--around", "60", "--vendor", "fastdds", "--exec", "build/own",
                  "--tolerance", "actual=0.0001", "--require", "backlash", "--require", "pitch error"));
}

TEST(Suite, WithoutServicesEveryProcessOfTheMachineIsVerifiedAndChannelsEachByThemselves) {
  const auto suite =
      parse_suite("tests: [{recording: a.mcap}, {recording: b.mcap, services: [channel]}]", "suite.yaml");
  std::vector<std::string> names;
  for (const auto& test : tests_of(suite, two_channels))
    names.push_back(suite.entries[test.entry].recording + " " + test.name);
  EXPECT_THAT(names, ElementsAre("a.mcap kinematics", "a.mcap compensation", "a.mcap channel 0",
                                 "a.mcap channel 1", "b.mcap channel 0", "b.mcap channel 1"));
}

TEST(Suite, WhatIsWrongIsOneLineWithItsPlace) {
  const std::pair<const char*, const char*> wrong[] = {
      {"tests: []", "dir/suite.yaml:1:1: error: 'tests' is missing"},
      {"title: x", "dir/suite.yaml:1:1: error: 'tests' is missing"},
      {"tests:\n  - {services: [drive]}", "dir/suite.yaml:2:5: error: 'recording' is missing"},
      {"tests:\n  - {recording: ''}", "dir/suite.yaml:2:17: error: 'recording' is empty"},
      {"tests:\n  - {recording: a, service: drive}",
       "dir/suite.yaml:2:20: error: unknown key 'service'; the keys are recording"},
      {"tests:\n  - {recording: a, services: [drives]}",
       "dir/suite.yaml:2:31: error: there is no service 'drives'"},
      {"tests:\n  - {recording: a, services: [plc]}", "has no service 'plc'"},
      {"tests:\n  - {recording: a, vendor: opendds}", "2:28: error: vendor must be fastdds or cyclonedds"},
      {"tests:\n  - {recording: a, tolerances: much}", "2:32: error: 'much' is not a number"},
      {"tests:\n  - {recording: a, tolerances: {actual: -1}}",
       "2:41: error: a tolerance must not be below 0"},
      {"timeout: 0\ntests: [{recording: a}]", "1:10: error: timeout must be above 0"},
      {"tests: [{recording: a, services: [kinematics], require: {compensation: all}}]", "is not verified"},
      {"tests: {", "dir/suite.yaml:"},
      {"- 1", "1:1: error: expected 'key: value' with the keys title, timeout, tests"},
  };
  for (const auto& [text, error] : wrong) EXPECT_THAT(error_of(text), HasSubstr(error)) << text;
}

}  // namespace
}  // namespace trunnion::verification
