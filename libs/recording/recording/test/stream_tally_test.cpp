// SPDX-License-Identifier: Apache-2.0
#include "recording/stream_tally.hpp"

#include <gtest/gtest.h>

#include "bus/codec.hpp"
#include "contracts/types.hpp"

namespace trunnion::recording {
namespace {

template <class T>
bus::Bytes cdr(const T& value) {
  bus::Bytes bytes;
  bus::encode(value, bytes);
  return bytes;
}

TEST(StreamTally, CountsLostCyclesOfEachEpochByItself) {
  StreamTally tally;
  idl::stream::PathBatch batch;
  batch.channel = 1;
  batch.epoch = 1;
  batch.count = 8;
  batch.starts = true;
  batch.first = 100;
  tally.add("path_batch", cdr(batch));
  batch.starts = false;
  batch.first = 116;  // 108 .. 115 are missing
  tally.add("path_batch", cdr(batch));
  batch.epoch = 2;  // a new epoch begins elsewhere: no gap
  batch.starts = true;
  batch.first = 5000;
  tally.add("path_batch", cdr(batch));
  EXPECT_EQ(tally.lost("path_batch"), 8u);
  EXPECT_EQ(tally.cycles("path_batch"), 24u);
  EXPECT_EQ(tally.messages(), 3u);
}

TEST(StreamTally, ChannelsAndTopicsAreSeparate) {
  StreamTally tally;
  idl::stream::AxisBatch batch;
  batch.count = 4;
  for (std::uint64_t first : {0, 8, 16}) {
    batch.first = first;
    batch.channel = 0;
    tally.add("gantry_batch", cdr(batch));
    batch.channel = 1;
    batch.first += 4;
    tally.add("gantry_batch", cdr(batch));
  }
  // Each channel has the gaps of the other.
  EXPECT_EQ(tally.lost("gantry_batch"), 16u);
  EXPECT_EQ(tally.lost("kinematics_batch"), 0u);
}

TEST(StreamTally, FeedbackRowsMustFollowEachOther) {
  StreamTally tally;
  idl::stream::Feedback batch;
  batch.count = 8;
  tally.add("feedback", cdr(batch));
  batch.first = 8;
  batch.count = 0;  // state without rows
  tally.add("feedback", cdr(batch));
  batch.first = 10;
  batch.count = 8;
  tally.add("feedback", cdr(batch));
  EXPECT_EQ(tally.lost("feedback"), 2u);
}

TEST(StreamTally, BytesThatAreNoBatchAreCountedAndNothingElse) {
  StreamTally tally;
  tally.add("path_batch", bus::Bytes{1, 2, 3});
  tally.add("alarm", bus::Bytes{});
  EXPECT_EQ(tally.messages(), 2u);
  EXPECT_EQ(tally.cycles("path_batch"), 0u);
}

}  // namespace
}  // namespace trunnion::recording
