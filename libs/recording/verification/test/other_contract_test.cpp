// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "contracts/topics.hpp"
#include "sample_recording.hpp"
#include "testing_support/refusal.hpp"
#include "verification/verify_plan.hpp"

namespace trunnion::verification {
namespace {

// What the drive would make of another input is not what it has made.
TEST(OtherContract, IsRefusedWithTheVersionWhereTheServiceUsesTheTopic) {
  auto recording = sample_recording(2);
  recording.metadata["version"] = "0.2.0", recording.metadata["contract"] = "0123456789abcdef";
  const auto refusal = [&](const std::string& topic, const std::string& service) {
    recording.foreign = {topic};
    return testing_support::refusal_of([&] { require_contract(recording, service); });
  };
  EXPECT_EQ(refusal("gantry_batch", "drive"),
            std::string("the recording is of version 0.2.0, contract 0123456789abcdef: service drive uses "
                        "gantry_batch, which has another form in this version (contract ") +
                topics::contract_hash + "); verify it with the services of that version");
  EXPECT_NE(refusal("gantry_batch", "gantry"), "taken") << "its output is compared";
  EXPECT_EQ(refusal("gantry_batch", "kinematics"), "taken");
  EXPECT_NE(refusal("alarm_reset", "kinematics"), "taken") << "every service reads it";
  EXPECT_EQ(refusal("snapshot_request", "kinematics"), "taken") << "it is for the recorder";
  for (const std::string always : {"cluster", "parameter_set", "service_snapshot"})
    EXPECT_NE(refusal(always, "program"), "taken") << always << " says how and from where on it is verified";
  for (const std::string other : {"nobody", "measurement"})
    EXPECT_EQ(refusal("cluster", other), "taken") << "plan_verification() says that it is not verified";
  EXPECT_EQ(refusal("stage_progress", "kinematics"), "taken") << "it is not compared";
  EXPECT_EQ(refusal("elsewhere/topic", "kinematics"), "taken");
}

}  // namespace
}  // namespace trunnion::verification
