// SPDX-License-Identifier: Apache-2.0
#include "verification/coverage.hpp"

#include <gtest/gtest.h>

#include "machine/parameter_constants.hpp"
#include "sample_recording.hpp"

namespace trunnion::verification {
namespace {

bool seen(const std::vector<Feature>& features, const std::string& name) {
  for (const auto& feature : features)
    if (feature.name == name) return feature.seen;
  ADD_FAILURE() << "no feature " << name;
  return false;
}

// One batch of compensation, made with a parameter set in which axis 1 has a backlash table or none.
std::vector<Feature> compensated(double backlash_type, double off) {
  idl::parameters::ParameterSet set;
  set.revision = 1;
  set.values = {{40001, 0, ""},
                {40002, 1, ""},
                {100000, 0, "X"},
                {101000, 0, "Y"},
                {parameter::backlash_type.number(1), backlash_type, ""}};
  std::sort(set.values.begin(), set.values.end(),
            [](const auto& a, const auto& b) { return a.number < b.number; });
  auto batch = axis_batch(0, true, true);
  StoredRecording recording;
  recording.messages = {stored(topics::parameter_set, set, 1), stored(topics::kinematics_batch, batch, 2)};
  batch.stage = idl::stream::Stage::COMPENSATION;
  batch.setpoints.back() += off;
  const auto output = stored(topics::compensation_batch, batch, 3);
  recording.messages.push_back(output);
  return coverage_of("compensation", {output}, recording);
}

TEST(Coverage, CompensationWithoutATableIsNotExercised) {
  const auto features = compensated(0, 0);
  EXPECT_TRUE(seen(features, "motion"));
  EXPECT_FALSE(seen(features, "backlash"));
  EXPECT_FALSE(seen(features, "correction"));
  EXPECT_EQ(text_of(features), "1 of 4 features seen: motion; not backlash, pitch error, correction");
}

TEST(Coverage, ATableThatCorrectsIsSeen) {
  const auto features = compensated(1, 0.01);
  EXPECT_TRUE(seen(features, "backlash"));
  EXPECT_FALSE(seen(features, "pitch error"));
  EXPECT_TRUE(seen(features, "correction"));
}

TEST(Coverage, WhatIsRequiredAndNotSeenIsMissing) {
  const std::vector<Feature> features = {{"motion", true}, {"hold", false}, {"homing", false}};
  EXPECT_TRUE(missing(features, {"motion"}).empty());
  EXPECT_EQ(missing(features, {"motion", "hold"}), std::vector<std::string>{"hold"});
  EXPECT_EQ(missing(features, {"all"}), (std::vector<std::string>{"hold", "homing"}));
  EXPECT_THROW(missing(features, {"holding"}), std::runtime_error);
}

}  // namespace
}  // namespace trunnion::verification
