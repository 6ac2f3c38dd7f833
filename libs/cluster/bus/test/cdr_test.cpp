// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "bus/bus.hpp"
#include "bus/json.hpp"
#include "bus/registry.hpp"
#include "contracts/types.hpp"

namespace trunnion::bus {
namespace {

TEST(Cdr, AlignsPrimitivesToTheirSizeFromTheEndOfTheHeader) {
  idl::stream::StageState state;
  state.stage = idl::stream::Stage::COMPENSATION;
  state.cycle = 0x0102030405060708;
  state.values = {1.0};
  Bytes bytes;
  encode(state, bytes);
  // header 4, enumerator at 0, padding to 8, uint64 at 8, length at 16, padding to 24, one double: 4 + 32
  // bytes.
  ASSERT_EQ(bytes.size(), 36u);
  EXPECT_EQ(bytes[1], 1) << "little-endian plain CDR";
  EXPECT_EQ(bytes[4], 2) << "of the enumerators, from 0";
  EXPECT_EQ(bytes[4 + 8], 0x08);
  EXPECT_EQ(bytes[4 + 16], 1);
  EXPECT_EQ(bytes[4 + 31], 0x3f) << "1.0 is 0x3ff0000000000000";
}

TEST(Cdr, WritesAStringWithItsLengthAndItsNul) {
  idl::program::ProgramEntry entry;
  entry.name = "O1";
  Bytes bytes;
  encode(entry, bytes);
  EXPECT_EQ(bytes[4], 3) << "two letters and the NUL";
  EXPECT_EQ(bytes[8], 'O');
  EXPECT_EQ(bytes[10], 0);
}

TEST(Cdr, DecodesWhatItEncodes) {
  idl::stream::PathBatch batch, copy;
  batch.first = 77;
  batch.count = 2;
  batch.setpoints.assign(18, 0.1);
  batch.lines = {5, 6};
  batch.states.push_back({idl::stream::Stage::KINEMATICS, 78, {1, 2, 3}});
  batch.states.push_back({idl::stream::Stage::GANTRY, 78, {}});
  batch.snapshot.valid = true, batch.snapshot.program_revision = (std::uint64_t{1} << 53) + 1;
  Bytes bytes;
  encode(batch, bytes);
  ASSERT_TRUE(decode(bytes, copy));
  EXPECT_EQ(batch, copy);
}

// What a process of another make may send: the bytes are a message of the type, and no field may have the
// value.
TEST(Cdr, RefusesValuesBeyondTheLimitsOfTheirFieldAndNamesIt) {
  const auto refusal = [](const auto& value) {
    Bytes bytes;
    encode(value, bytes);
    auto copy = value;
    std::string why = "taken";
    decode(bytes, copy, &why);
    return why;
  };
  idl::stream::StreamRequest request;
  request.channel = 31;
  EXPECT_EQ(refusal(request), "taken");
  request.channel = 32;
  EXPECT_EQ(refusal(request), "channel: 32, must be 0 to 31");
  idl::stream::AxisBatch batch;
  batch.count = 64, batch.axes = {0, 1};
  batch.setpoints.assign(128, -1e300);
  EXPECT_EQ(refusal(batch), "taken");
  batch.count = 65;
  EXPECT_EQ(refusal(batch), "count: 65, must be 0 to 64");
  batch.count = 64, batch.setpoints[127] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(refusal(batch), "setpoints: not a finite number");
  idl::channel::ChannelRequest order;
  order.speed = -std::numeric_limits<double>::infinity();
  EXPECT_EQ(refusal(order), "speed: not a finite number");
  idl::parameters::ParameterSet set;
  KeyHash key;
  Bytes bytes;
  encode(request, bytes);
  EXPECT_TRUE(key_of<idl::stream::StreamRequest>(bytes, key)) << "it reaches the reader, which refuses it";
  set.values = {{1, 0, ""}, {2, std::numeric_limits<double>::infinity(), ""}};
  EXPECT_EQ(refusal(set), "value: not a finite number") << "in a struct of a sequence";
}

TEST(Cdr, RefusesASequenceBeyondItsBoundOnBothSides) {
  idl::stream::PathBatch batch;
  batch.lines.assign(65, 0);
  Bytes bytes;
  EXPECT_THROW(encode(batch, bytes), CdrError);
}

TEST(Enumerators, HaveTheNamesOfTheIdlBothWays) {
  using idl::stream::DriveMode;
  EXPECT_STREQ(to_string(DriveMode::RETURNING), "RETURNING");
  EXPECT_EQ(from_string<DriveMode>("OFF"), DriveMode::OFF);
  EXPECT_EQ(from_string<DriveMode>("off"), std::nullopt);
  EXPECT_EQ(from_string<DriveMode>(""), std::nullopt);
  EXPECT_STREQ(to_string(static_cast<DriveMode>(99)), "?");
}

TEST(Cdr, RefusesAnEnumeratorThatDoesNotExist) {
  idl::channel::ChannelReply reply;
  idl::service::Alarm alarm;
  Bytes bytes;
  encode(alarm, bytes);
  bytes[4 + 16] = 9;  // severity follows three uint32 and a boolean padded to four
  EXPECT_FALSE(decode(bytes, alarm));
}

TEST(Cdr, SurvivesEveryTruncationAndSeededNoise) {
  std::mt19937 random(1);
  for (const auto& topic : all_topics()) {
    Bytes noise(400);
    for (int round = 0; round < 300; ++round) {
      for (auto& byte : noise) byte = static_cast<std::uint8_t>(random() % 5 == 0 ? random() : 0);
      noise[0] = 0, noise[1] = 1;
      noise.resize(4 + random() % 396);
      try {
        topic.to_json(noise);
      } catch (const CdrError&) {
      }
      noise.resize(400);
    }
  }
}

TEST(Registry, EveryTopicHasASelfContainedSchemaAndAnUniqueName) {
  std::vector<std::string> names;
  for (const auto& topic : all_topics()) {
    const auto type = topic.type.substr(topic.type.rfind(':') + 1);
    EXPECT_NE(topic.schema.find("struct " + type + " {"), std::string::npos) << topic.description.name;
    names.push_back(topic.description.name);
  }
  std::sort(names.begin(), names.end());
  EXPECT_EQ(std::adjacent_find(names.begin(), names.end()), names.end());
}

}  // namespace
}  // namespace trunnion::bus
