// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>
#include <string>
#include <vector>

#include "recording/mcap_index.hpp"
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

Bytes written(const std::vector<Message>& messages, std::size_t chunk_bytes,
              Compression compression = Compression::zstd) {
  MemorySink sink;
  Writer writer(sink, {.library = "test", .chunk_bytes = chunk_bytes, .compression = compression});
  for (int c = 0; c < 3; ++c)
    writer.add_channel("topic " + std::to_string(c), c == 2 ? "B" : "A",
                       c == 2 ? "struct B {};" : "struct A {};", {{"qos", "batch"}});
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

// Five values a byte, in a hundred or so bytes a message: they do get smaller.
TEST(Mcap, TellsTheCompressionOfItsChunksAndNeedsNone) {
  const auto messages = some_messages(300, 1);
  using Counts = std::map<std::string, std::uint64_t>;
  const auto compressions = [&](const Bytes& file) {
    EXPECT_EQ(read(file).messages, messages);
    MemorySource source(file);
    Reader reader(source);
    MessageView view;
    while (reader.next(view)) {
    }
    return reader.compressions();
  };
  const auto compressed = written(messages, 1 << 20), plain = written(messages, 1 << 20, Compression::none);
  EXPECT_EQ(compressions(compressed), (Counts{{"zstd", 1}}));
  EXPECT_EQ(compressions(plain), (Counts{{"none", 1}}));
  EXPECT_LT(compressed.size(), plain.size());
  // Its first message can be found in the file as it was written.
  const auto& first = messages.front().data;
  EXPECT_NE(std::search(plain.begin(), plain.end(), first.begin(), first.end()), plain.end());
}

TEST(Mcap, CarriesTypesTopicsAndMetadata) {
  const auto file = written(some_messages(50, 2), 1 << 20);
  MemorySource source(file);
  Reader reader(source);
  MessageView view;
  ASSERT_TRUE(reader.next(view));
  EXPECT_EQ(view.channel->encoding, "cdr");
  EXPECT_EQ(view.channel->metadata, (StringMap{{"qos", "batch"}}));
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

// Where the wrong byte is in no chunk, nothing is missing; and what is delivered is as it was written.
TEST(Mcap, AnyWrongByteIsFoundAndCostsNoMoreThanItsChunk) {
  const auto messages = some_messages(60, 4);
  const auto file = written(messages, 800);
  MemorySource whole(file);
  const auto chunks = read_index(whole, 1 << 20).chunks;
  ASSERT_GT(chunks.size(), 4u);
  for (std::size_t at = 0; at < file.size(); ++at) {
    auto left = messages;
    for (const auto& chunk : chunks) {
      if (at < chunk.offset || at >= chunk.offset + chunk.length) continue;
      const auto first = read(std::span(file).first(chunk.offset)).messages.size();
      const auto last = read(std::span(file).first(chunk.end())).messages.size();
      ASSERT_LT(first, last);
      left.erase(left.begin() + static_cast<std::ptrdiff_t>(first),
                 left.begin() + static_cast<std::ptrdiff_t>(last));
    }
    auto broken = file;
    broken[at] ^= static_cast<std::uint8_t>(1u << (at % 8));
    const auto result = read(broken);
    EXPECT_NE(result.ending, Ending::complete) << at;
    EXPECT_FALSE(result.problem.empty()) << at;
    ASSERT_TRUE(result.messages == messages || result.messages == left) << at << ": " << result.problem;
  }
}

TEST(Mcap, NamesBytesAndTimesOfADamagedChunk) {
  const auto messages = some_messages(60, 4);
  auto file = written(messages, 800);
  MemorySource whole(file);
  const auto chunk = read_index(whole, 1 << 20).chunks.at(1);
  file[chunk.offset + chunk.length - 1] ^= 1;
  MemorySource source(file);
  Reader reader(source);
  MessageView view;
  while (reader.next(view)) {
  }
  EXPECT_EQ(reader.ending(), Ending::damaged);
  ASSERT_EQ(reader.damages().size(), 1u);
  const auto& damage = reader.damages()[0];
  EXPECT_EQ(damage.begin, chunk.offset);
  EXPECT_EQ(damage.end, chunk.offset + chunk.length);
  EXPECT_EQ(damage.first_time, chunk.first_time);
  EXPECT_EQ(damage.last_time, chunk.last_time);
  EXPECT_EQ(reader.problem(), "damaged, " + text_of(damage));
}

TEST(Mcap, TellsADamageInOneLine) {
  constexpr std::uint64_t ten_past_ten = 1'772'359'800'000'000'000;  // 2026-03-01, ns
  const Damage damage{2000, 2800, ten_past_ten, ten_past_ten + 1'250'000'000, "the chunk fails its checksum"};
  EXPECT_EQ(text_of(damage),
            "bytes 2000 to 2799, messages of 2026-03-01T10:10:00.000Z to 10:10:01.250Z: the chunk fails its "
            "checksum");
  EXPECT_EQ(text_of(Damage{0, 8, 0, 0, "wrong"}), "bytes 0 to 7: wrong");
  const std::vector<Damage> damages(5, {0, 8, 0, 0, "wrong"});
  EXPECT_EQ(text_of(damages),
            "damaged, bytes 0 to 7: wrong; bytes 0 to 7: wrong; bytes 0 to 7: wrong; and 2 "
            "more places");
}

// Without an index the lengths of the records lead on.
TEST(Mcap, ADamagedChunkOfAFileThatIsCutOffCostsItsMessagesOnly) {
  const auto messages = some_messages(60, 4);
  const auto file = written(messages, 800);
  MemorySource whole(file);
  const auto chunks = read_index(whole, 1 << 20).chunks;
  const auto up_to = [&](std::size_t chunk) {
    return read(std::span(file).first(chunks.at(chunk).end())).messages.size();
  };
  Bytes part(file.begin(), file.begin() + static_cast<std::ptrdiff_t>(chunks.at(4).end()));
  part[chunks[2].offset + chunks[2].length - 1] ^= 1;
  const auto result = read(part);
  EXPECT_EQ(result.ending, Ending::damaged);
  EXPECT_EQ(result.messages.size(), up_to(1) + up_to(4) - up_to(2));
}

TEST(Mcap, WrongRecordsBehindEachOtherAreOneDamage) {
  Bytes file(mcap_magic.begin(), mcap_magic.end());
  for (int i = 0; i < 1000; ++i) {
    file.push_back(static_cast<std::uint8_t>(Opcode::message));
    file.insert(file.end(), 8, 0);  // no bytes
  }
  MemorySource source(file);
  Reader reader(source);
  MessageView view;
  while (reader.next(view)) {
  }
  ASSERT_EQ(reader.damages().size(), 1u);
  EXPECT_EQ(reader.damages()[0].begin, mcap_magic.size());
  EXPECT_EQ(reader.damages()[0].end, file.size());
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
