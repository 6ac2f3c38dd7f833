// SPDX-License-Identifier: Apache-2.0
#include "machine/stream_settings.hpp"

#include <gtest/gtest.h>

#include "machine/parameter_constants.hpp"

namespace trunnion::machine {
namespace {

Parameters with(double lead, double ahead, double batch_virtual) {
  Parameters p;
  p.values[900] = {lead, ""};
  p.values[902] = {batch_virtual, ""};
  p.values[903] = {ahead, ""};
  return p;
}

TEST(StreamSettings, InRealTimeNothingIsWrittenBeyondTheLead) {
  const StreamSettings real(with(32, 256, 64), false);
  EXPECT_EQ(real.ahead, 32);
  EXPECT_EQ(real.batch, 4) << "the default of 000901";
  EXPECT_EQ(real.feedback_batch, 4);
}

TEST(StreamSettings, InVirtualTimeTheLeadLimitsTheMotionsThatUseFeedback) {
  const StreamSettings stream(with(32, 256, 64), true);
  EXPECT_EQ(stream.lead, 32);
  EXPECT_EQ(stream.ahead, 256);
  EXPECT_EQ(stream.batch, 64);
  EXPECT_EQ(stream.feedback_batch, 16) << "two batches in a lead of 32";
}

TEST(StreamSettings, TwoBatchesFitIntoEveryLead) {
  for (double lead = 8; lead <= 512; lead += 7)
    for (double ahead = 8; ahead <= 512; ahead += 13)
      for (double size = 1; size <= 64; size += 3) {
        const StreamSettings stream(with(lead, ahead, size), true);
        ASSERT_LE(2 * stream.batch, stream.ahead);
        ASSERT_LE(2 * stream.feedback_batch, stream.lead);
        ASSERT_GE(stream.ahead, stream.lead);
        ASSERT_GE(stream.feedback_batch, 1u);
      }
}

}  // namespace
}  // namespace trunnion::machine
