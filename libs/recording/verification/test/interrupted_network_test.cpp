// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "cluster/instances.hpp"
#include "machine/alarm_constants.hpp"
#include "sample_recording.hpp"
#include "verification/verify_plan.hpp"

namespace trunnion::verification {
namespace {

StoredMessage lost(std::uint32_t part, const std::string& text, bool active = true) {
  idl::service::Alarm raised;
  raised.number = alarm::service_lost.number;
  raised.part = part;
  raised.active = active;
  raised.text = text;
  return stored(topics::alarm, raised, 5);
}

TEST(InterruptedNetwork, IsToldByTheAlarmOfAHostAndByNoOther) {
  StoredRecording recording;
  recording.messages = {
      lost(3, "kinematics has ended: killed by signal 9"),
      lost(3 + cluster::generation_step, "kinematics, which was swapped in, has ended"),
      lost(cluster::launcher_instance + 1, "Host motion is silent, and with it gantry: check it", false)};
  EXPECT_EQ(interrupted_network(recording), "");
  recording.messages.push_back(
      lost(cluster::launcher_instance + 1, "Host motion is silent, and with it gantry: check it"));
  EXPECT_EQ(
      interrupted_network(recording),
      "the network was interrupted (Host motion is silent, and with it gantry): when the messages of that "
      "time arrived is not in the recording");
}

}  // namespace
}  // namespace trunnion::verification
