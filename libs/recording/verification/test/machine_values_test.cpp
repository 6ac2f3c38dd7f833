// SPDX-License-Identifier: Apache-2.0
#include "verification/machine_values.hpp"

#include <gtest/gtest.h>

#include "sample_recording.hpp"

namespace trunnion::verification {
namespace {

using Values = std::map<std::uint32_t, machine::ParameterValue>;

// 000001 is the interpolation cycle, 1000 us by default, 300001 the backlash of axis 0, which is 0.
StoredRecording recorded_with(double backlash) {
  idl::parameters::ParameterSet set;
  set.revision = 7;
  set.values = {{300001, backlash, ""}};
  StoredRecording recording;
  recording.messages = {stored(topics::parameter_set, set, 1)};
  return recording;
}

TEST(MachineValues, CountsWhatDiffersAndNamesTheFirstWithItsUnit) {
  EXPECT_EQ(parameters_apart(recorded_with(0.02), {{300001, {0.03, ""}}}),
            "1 parameter differs, 300001 (backlash): 0.02 mm recorded, 0.03 mm there");
  EXPECT_EQ(
      parameters_apart(recorded_with(0.02), {{1, {2000, ""}}}),
      "2 parameters differ, the first is 000001 (interpolation_cycle): 1000 us recorded, 2000 us there");
  EXPECT_EQ(parameters_apart(recorded_with(0.02), {{1, {1000, ""}}, {300001, {0.02, ""}}}), "")
      << "a default that is written down is no difference";
  EXPECT_EQ(parameters_apart({}, {{1, {2000, ""}}}), "") << "no set is recorded";
}

TEST(MachineValues, ReplaceThoseOfEverySetAndKeepItsRevision) {
  auto recording = recorded_with(0.02);
  const Values delivered = {{1, {1000, ""}}, {300001, {0.03, ""}}};
  use_parameters(recording, delivered);
  idl::parameters::ParameterSet set;
  ASSERT_TRUE(bus::decode(recording.messages.at(0).cdr, set));
  EXPECT_EQ(set.revision, 7u);
  ASSERT_EQ(set.values.size(), 1u) << "a set has no defaults";
  EXPECT_EQ(set.values[0].value, 0.03);
  EXPECT_EQ(parameters_apart(recording, delivered), "");
}

}  // namespace
}  // namespace trunnion::verification
