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
  idl::stream::PathFrame frame;
  frame.channel = 1;
  frame.epoch = 1;
  frame.count = 8;
  frame.starts = true;
  frame.first = 100;
  tally.add("path_frame", cdr(frame));
  frame.starts = false;
  frame.first = 116;  // 108 .. 115 are missing
  tally.add("path_frame", cdr(frame));
  frame.epoch = 2;  // a new epoch begins elsewhere: no gap
  frame.starts = true;
  frame.first = 5000;
  tally.add("path_frame", cdr(frame));
  EXPECT_EQ(tally.lost("path_frame"), 8u);
  EXPECT_EQ(tally.cycles("path_frame"), 24u);
  EXPECT_EQ(tally.messages(), 3u);
}

TEST(StreamTally, ChannelsAndTopicsAreSeparate) {
  StreamTally tally;
  idl::stream::AxisFrame frame;
  frame.count = 4;
  for (std::uint64_t first : {0, 8, 16}) {
    frame.first = first;
    frame.channel = 0;
    tally.add("gantry_frame", cdr(frame));
    frame.channel = 1;
    frame.first += 4;
    tally.add("gantry_frame", cdr(frame));
  }
  // Each channel has the gaps of the other.
  EXPECT_EQ(tally.lost("gantry_frame"), 16u);
  EXPECT_EQ(tally.lost("kinematics_frame"), 0u);
}

TEST(StreamTally, FeedbackRowsMustFollowEachOther) {
  StreamTally tally;
  idl::stream::FeedbackFrame frame;
  frame.count = 8;
  tally.add("feedback_frame", cdr(frame));
  frame.first = 8;
  frame.count = 0;  // state without rows
  tally.add("feedback_frame", cdr(frame));
  frame.first = 10;
  frame.count = 8;
  tally.add("feedback_frame", cdr(frame));
  EXPECT_EQ(tally.lost("feedback_frame"), 2u);
}

TEST(StreamTally, BytesThatAreNoFrameAreCountedAndNothingElse) {
  StreamTally tally;
  tally.add("path_frame", bus::Bytes{1, 2, 3});
  tally.add("alarm", bus::Bytes{});
  EXPECT_EQ(tally.messages(), 2u);
  EXPECT_EQ(tally.cycles("path_frame"), 0u);
}

}  // namespace
}  // namespace trunnion::recording
