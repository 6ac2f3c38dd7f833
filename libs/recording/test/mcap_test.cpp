// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <string>
#include <vector>

#include "recording/mcap_reader.hpp"
#include "recording/mcap_writer.hpp"

namespace trunnion::recording {
namespace {

struct Message {
  std::string topic;
  std::uint32_t sequence;
  std::uint64_t time;
  Bytes data;
  bool operator==(const Message&) const = default;
};

std::vector<Message> some_messages(int count, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<Message> messages;
  std::uint32_t sequence[3] = {};
  for (int i = 0; i < count; ++i) {
    const auto channel = random() % 3;
    Bytes data(random() % 200);
    for (auto& byte : data) byte = static_cast<std::uint8_t>(random() % 5);
    messages.push_back(
        {"topic " + std::to_string(channel), ++sequence[channel], 1000 + random() % 5000, data});
  }
  return messages;
}

Bytes written(const std::vector<Message>& messages, std::size_t chunk_bytes) {
  MemorySink sink;
  Writer writer(sink, {.library = "test", .chunk_bytes = chunk_bytes});
  for (int c = 0; c < 3; ++c)
    writer.add_channel("topic " + std::to_string(c), c == 2 ? "B" : "A",
                       c == 2 ? "struct B {};" : "struct A {};", {{"qos", "frame"}});
  writer.metadata("trunnion", {{"machine", "test"}, {"domain", "7"}});
  for (const auto& m : messages)
    EXPECT_TRUE(writer.write(static_cast<std::uint16_t>(m.topic.back() - '0'), m.sequence, m.time, m.data));
  EXPECT_TRUE(writer.finish());
  EXPECT_EQ(writer.messages(), messages.size());
  EXPECT_EQ(writer.bytes(), sink.data.size());
  return sink.data;
}

struct Result {
  std::vector<Message> messages;
  Ending ending;
  std::string problem;
};

Result read(std::span<const std::uint8_t> file) {
  MemorySource source(file);
  Reader reader(source);
  Result result;
  MessageView view;
  while (reader.next(view)) {
    EXPECT_EQ(view.log_time, view.publish_time);
    result.messages.push_back(
        {view.channel->topic, view.sequence, view.log_time, Bytes(view.data.begin(), view.data.end())});
  }
  result.ending = reader.ending();
  result.problem = reader.problem();
  return result;
}

TEST(Mcap, GivesBackEveryMessageInOrder) {
  for (const std::size_t chunk : {1u, 500u, 5000u, 1u << 20}) {
    const auto messages = some_messages(300, 1);
    const auto result = read(written(messages, chunk));
    EXPECT_EQ(result.ending, Ending::complete) << result.problem;
    EXPECT_EQ(result.messages, messages);
  }
}

TEST(Mcap, CarriesTypesTopicsAndMetadata) {
  const auto file = written(some_messages(50, 2), 1 << 20);
  MemorySource source(file);
  Reader reader(source);
  MessageView view;
  ASSERT_TRUE(reader.next(view));
  EXPECT_EQ(view.channel->encoding, "cdr");
  EXPECT_EQ(view.channel->metadata, (StringMap{{"qos", "frame"}}));
  ASSERT_EQ(reader.metadata().size(), 1u);
  EXPECT_EQ(reader.metadata()[0].name, "trunnion");
  EXPECT_EQ(reader.metadata()[0].values, (StringMap{{"machine", "test"}, {"domain", "7"}}));
  while (reader.next(view)) {
  }
  // Two of the three topics share a type.
  ASSERT_EQ(reader.schemas().size(), 2u);
  ASSERT_EQ(reader.channels().size(), 3u);
  for (const auto& [id, channel] : reader.channels()) {
    const auto& schema = reader.schemas().at(channel.schema);
    EXPECT_EQ(schema.encoding, "omgidl");
    EXPECT_EQ(schema.name, channel.topic == "topic 2" ? "B" : "A");
    EXPECT_EQ(schema.data, "struct " + schema.name + " {};");
  }
}

TEST(Mcap, AFileCutOffAnywhereGivesItsWholeChunks) {
  const auto messages = some_messages(60, 3);
  const auto file = written(messages, 800);
  std::size_t most = 0;
  for (std::size_t size = 0; size < file.size(); ++size) {
    const auto result = read(std::span(file).first(size));
    // Behind the data end record only the summary is missing.
    EXPECT_TRUE(result.ending == Ending::cut_off ||
                (result.ending == Ending::complete && result.messages == messages))
        << size << ": " << result.problem;
    ASSERT_LE(result.messages.size(), messages.size());
    EXPECT_TRUE(std::equal(result.messages.begin(), result.messages.end(), messages.begin())) << size;
    EXPECT_GE(result.messages.size(), most) << "a longer file gives no less";
    most = result.messages.size();
  }
  EXPECT_EQ(most, messages.size());
}

// A wrong opcode makes a chunk a record of a later version, which readers have to skip; so chunks may be
// missing, but nothing else is ever delivered.
TEST(Mcap, AWrongByteNeverChangesAMessage) {
  const auto messages = some_messages(60, 4);
  const auto file = written(messages, 800);
  int damaged = 0;
  for (std::size_t at = 0; at < file.size(); ++at) {
    auto broken = file;
    broken[at] ^= 0x10;
    const auto result = read(broken);
    auto place = messages.begin();
    for (const auto& message : result.messages) {
      place = std::find_if(place, messages.end(), [&](const Message& m) { return m.data == message.data; });
      ASSERT_NE(place, messages.end()) << at;
      ++place;
    }
    EXPECT_NE(result.ending, Ending::none);
    damaged += result.ending == Ending::damaged;
  }
  // Most of the file is chunks, and every byte of a chunk's messages is under its checksum.
  EXPECT_GT(damaged, static_cast<int>(file.size() / 3));
}

TEST(Mcap, ForgedLengthsAreRefusedWithoutAllocating) {
  Bytes file(mcap_magic.begin(), mcap_magic.end());
  file.push_back(static_cast<std::uint8_t>(Opcode::chunk));
  for (int i = 0; i < 8; ++i) file.push_back(0xff);
  file.resize(200);
  EXPECT_EQ(read(file).ending, Ending::cut_off);
  EXPECT_EQ(read({}).ending, Ending::cut_off);
  EXPECT_EQ(read(Bytes(100, 'x')).ending, Ending::damaged);
  EXPECT_EQ(read(Bytes(100, 'x')).problem, "not an MCAP file: the magic bytes are missing");
}

// Writes until `capacity` bytes are used up, as a disk does.
struct SmallDisk final : Sink {
  explicit SmallDisk(std::size_t size) : capacity(size) {}
  bool write(std::span<const std::uint8_t> bytes) override {
    const auto count = std::min(bytes.size(), capacity - data.size());
    data.insert(data.end(), bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(count));
    return count == bytes.size();
  }
  std::size_t capacity;
  Bytes data;
};

TEST(Mcap, AFullDiskStopsTheWriterAndLeavesAReadableFile) {
  const auto messages = some_messages(200, 5);
  SmallDisk disk(5000);
  Writer writer(disk, {.chunk_bytes = 1000});
  for (int c = 0; c < 3; ++c) writer.add_channel("topic " + std::to_string(c), "A", "");
  std::size_t accepted = 0;
  for (const auto& m : messages)
    accepted += writer.write(static_cast<std::uint16_t>(m.topic.back() - '0'), m.sequence, m.time, m.data);
  EXPECT_LT(accepted, messages.size());
  EXPECT_TRUE(writer.failed());
  EXPECT_FALSE(writer.finish());
  EXPECT_LE(disk.data.size(), disk.capacity);
  const auto result = read(disk.data);
  EXPECT_EQ(result.ending, Ending::cut_off);
  EXPECT_GT(result.messages.size(), 0u);
  EXPECT_TRUE(std::equal(result.messages.begin(), result.messages.end(), messages.begin()));
}

TEST(Mcap, FlushedMessagesSurviveACrash) {
  MemorySink sink;
  Writer writer(sink);
  const auto channel = writer.add_channel("topic 0", "A", "");
  writer.write(channel, 1, 5, Bytes{1});
  writer.flush();
  writer.write(channel, 2, 6, Bytes{2});
  const auto result = read(sink.data);
  ASSERT_EQ(result.messages.size(), 1u);
  EXPECT_EQ(result.messages[0].data, Bytes{1});
  EXPECT_EQ(result.ending, Ending::cut_off);
}

}  // namespace
}  // namespace trunnion::recording
