// SPDX-License-Identifier: Apache-2.0
#include "core/recording_table.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "bus/codec.hpp"
#include "bus/registry.hpp"
#include "contracts/topics.hpp"
#include "core/recording_files.hpp"
#include "recording/mcap_writer.hpp"

namespace trunnion::gateway {
namespace {

/// Batches of three cycles from `first` on, of two axes: commanded = cycle / 7, actual = that less 0.25.
recording::Bytes recorded(std::uint64_t first, std::uint32_t batches, const std::string& schema = "") {
  recording::MemorySink sink;
  recording::Writer writer(sink, {.chunk_bytes = 4096});
  const auto* entry = bus::find_topic(topics::feedback.name);
  const auto channel =
      writer.add_channel(entry->description.name, entry->type, schema.empty() ? entry->schema : schema);
  const auto other = writer.add_channel("trunnion/other/1", "Other", "struct Other {};");
  for (std::uint32_t batch = 0; batch < batches; ++batch) {
    idl::stream::Feedback feedback{};
    feedback.first = first + 3 * batch;
    feedback.count = 3;
    feedback.axis_count = 2;
    for (std::uint64_t cycle = feedback.first; cycle < feedback.first + 3; ++cycle)
      for (int axis = 0; axis < 2; ++axis) {
        feedback.commanded.push_back(static_cast<double>(cycle) / 7 + axis);
        feedback.actual.push_back(static_cast<double>(cycle) / 7 + axis - 0.25);
      }
    feedback.velocity = {1.5, -2};
    feedback.torque = {0.125, 0};
    bus::Bytes cdr;
    bus::encode(feedback, cdr);
    writer.write(channel, batch, batch, cdr);
    writer.write(other, batch, batch, recording::Bytes{1, 2, 3});
  }
  writer.finish();
  return sink.data;
}

struct Table {
  bool begun = false;
  std::string text;
  std::size_t parts = 0, largest = 0;
};

Table table(const recording::Bytes& bytes) {
  RecordingTable made(std::make_unique<recording::MemorySource>(bytes));
  Table result;
  result.begun = made.begin();
  while (auto part = made.next()) {
    if (part->empty()) break;
    result.text += *part;
    ++result.parts;
    result.largest = std::max(result.largest, part->size());
  }
  return result;
}

TEST(RecordingTable, HasALineForEachExecutedCycle) {
  const auto made = table(recorded(70, 2));
  EXPECT_TRUE(made.begun);
  std::istringstream lines(made.text);
  std::string line;
  std::getline(lines, line);
  EXPECT_EQ(
      line,
      "cycle,commanded[0],commanded[1],actual[0],actual[1],velocity[0],velocity[1],torque[0],torque[1]");
  std::getline(lines, line);
  EXPECT_EQ(line, "70,10,11,9.75,10.75,,,,");  // 70/7 = 10
  for (std::uint64_t cycle = 71; cycle < 76; ++cycle) {
    ASSERT_TRUE(std::getline(lines, line)) << cycle;
    std::istringstream cells(line);
    std::string cell;
    std::getline(cells, cell, ',');
    EXPECT_EQ(cell, std::to_string(cycle));
    std::getline(cells, cell, ',');
    EXPECT_EQ(std::strtod(cell.c_str(), nullptr), static_cast<double>(cycle) / 7) << "the same bits";
    EXPECT_EQ(line.ends_with(",1.5,-2,0.125,0"), cycle == 72 || cycle == 75) << "the last line of a batch";
  }
  EXPECT_FALSE(std::getline(lines, line));
}

TEST(RecordingTable, IsMadeInPartsOfBoundedSize) {
  // 60,000 cycles of some 60 bytes are several parts; one batch more than a part's size is 3 lines at most.
  const auto made = table(recorded(0, 20000));
  EXPECT_EQ(std::count(made.text.begin(), made.text.end(), '\n'), 60001);
  EXPECT_GT(made.parts, 5u);
  EXPECT_LT(made.largest, RecordingTable::part_bytes + 3 * 9 * 25);
}

TEST(RecordingTable, OfAFileThatIsCutOffHasWhatIsWhole) {
  const auto whole = recorded(0, 1000);
  const auto all = table(whole).text;
  for (const std::size_t size : {whole.size() / 4, whole.size() / 2, whole.size() - whole.size() / 4}) {
    const auto part = table(recording::Bytes(whole.begin(), whole.begin() + static_cast<long>(size))).text;
    EXPECT_TRUE(all.starts_with(part)) << size;
    EXPECT_FALSE(part.empty()) << size;
  }
}

TEST(RecordingTable, DoesNotBeginWithoutCyclesOfThisContract) {
  EXPECT_FALSE(table(recorded(0, 0)).begun);
  EXPECT_FALSE(table(recorded(0, 5, "struct Feedback { long other; };")).begun);
  EXPECT_FALSE(table({}).begun);
  EXPECT_FALSE(table(recording::Bytes(1000, 0x55)).begun);
}

TEST(RecordingFiles, AreNamedWithoutAWayOutOfTheirDirectory) {
  for (const char* name : {"a.mcap", "20261123-064500.mcap", "mill_3-part.2.mcap"})
    EXPECT_TRUE(is_recording_name(name)) << name;
  for (const char* name : {"", ".mcap", "..mcap", ".a.mcap", "a.csv", "../a.mcap", "a/b.mcap", "a b.mcap",
                           "a\n.mcap", "recorder.log"})
    EXPECT_FALSE(is_recording_name(name)) << name;
  EXPECT_FALSE(is_recording_name(std::string(96, 'x') + ".mcap"));
}

TEST(RecordingFiles, ListsFilesButNoLinksAndReadsTheirParts) {
  namespace fs = std::filesystem;
  const fs::path directory = testing::TempDir() + "/recording_files_" + std::to_string(getpid());
  EXPECT_TRUE(recording_files(directory).empty());
  fs::create_directories(directory / "directory.mcap");
  std::ofstream(directory / "b.mcap") << "0123456789";
  std::ofstream(directory / "a.mcap") << "";
  std::ofstream(directory / "secret.txt") << "secret";
  fs::create_symlink("secret.txt", directory / "link.mcap");
  const auto files = recording_files(directory);
  ASSERT_EQ(files.size(), 2u);
  EXPECT_EQ(files[0].name, "a.mcap");
  EXPECT_EQ(files[1].size, 10u);
  EXPECT_NE(files[0].etag(), files[1].etag());
  EXPECT_FALSE(recording_file(directory, "link.mcap"));
  EXPECT_EQ(file_part(directory / "link.mcap", {}), nullptr);
  const auto part = file_part(directory / "b.mcap", {ByteRange::Kind::part, 2, 3});
  EXPECT_EQ(part->next(), "234");
  EXPECT_EQ(part->next(), "");
  const auto shortened = file_part(directory / "b.mcap", {ByteRange::Kind::part, 0, 10});
  fs::resize_file(directory / "b.mcap", 4);
  EXPECT_EQ(shortened->next(), "0123");
  EXPECT_FALSE(shortened->next()) << "the rest cannot be had";
  fs::remove_all(directory);
}

}  // namespace
}  // namespace trunnion::gateway
