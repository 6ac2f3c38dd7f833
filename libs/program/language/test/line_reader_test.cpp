// SPDX-License-Identifier: Apache-2.0
#include "language/line_reader.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace trunnion::language {
namespace {

std::vector<std::string> lines(std::string_view text) {
  StringSource source(text);
  LineReader reader;
  reader.seek(source, {});
  std::vector<std::string> result;
  std::string_view line;
  while (reader.next(line) == LineReader::Status::line) result.emplace_back(line);
  return result;
}

using testing::ElementsAre;

TEST(LineReader, EveryLineEndIsOne) {
  EXPECT_THAT(lines("a\nb\r\nc\rd"), ElementsAre("a", "b", "c", "d"));
  EXPECT_THAT(lines("a\n\nb\r\n\r\nc\r\rd\n"), ElementsAre("a", "", "b", "", "c", "", "d"));
  EXPECT_THAT(lines("a\r"), ElementsAre("a"));
  EXPECT_THAT(lines("\r\n"), ElementsAre(""));
  EXPECT_THAT(lines(""), ElementsAre());
}

TEST(LineReader, LineEndsAcrossAnyEdge) {
  // Reads ask for 2048, 4096 .. 32768 bytes: a line end is put at every place around each edge, 2048 * (2^n -
  // 1).
  for (const std::size_t edge : {2048u, 6144u, 14336u, 30720u, 63488u, 96256u, 129024u}) {
    for (std::size_t size = edge - 4; size < edge + 4; ++size) {
      std::string text;
      std::size_t count = 2;
      for (; text.size() + 1001 < size; ++count) text += std::string(1000, 'x') + "\n";
      text += std::string(size - text.size(), 'y') + "\r\nz";
      const auto result = lines(text);
      ASSERT_EQ(result.size(), count) << size;
      EXPECT_EQ(result.back(), "z");
    }
  }
}

TEST(LineReader, LongestLine) {
  const std::string longest(max_line_length, 'x');
  EXPECT_THAT(lines(longest + "\na"), ElementsAre(longest, "a"));
  EXPECT_THAT(lines("\n" + longest), ElementsAre("", longest));
  for (const std::size_t size : {max_line_length + 1, std::size_t{1} << 20}) {
    const std::string text = "a\n" + std::string(size, 'x') + "\na";
    StringSource source(text);
    LineReader reader;
    reader.seek(source, {});
    std::string_view line;
    EXPECT_EQ(reader.next(line), LineReader::Status::line);
    EXPECT_EQ(reader.next(line), LineReader::Status::too_long);
    EXPECT_EQ(reader.position().line, 2u);
  }
}

TEST(LineReader, LoopOfManyLinesReadsItsSourceOnce) {
  struct Counting : TextSource {
    explicit Counting(std::string_view text) : whole(text) {}
    ReadResult read(std::uint64_t offset, char* buffer, std::size_t capacity) override {
      const ReadResult result = whole.read(offset, buffer, capacity);
      bytes += result.size;
      return result;
    }
    StringSource whole;
    std::size_t bytes = 0;
  };
  std::string text;
  for (int i = 0; i < 20000; ++i) text += "G1 X1\n";
  Counting source(text);
  LineReader reader;
  reader.seek(source, {});
  std::string_view line;
  for (int i = 0; i < 10000; ++i) ASSERT_EQ(reader.next(line), LineReader::Status::line);
  const TextPosition begin = reader.position();
  for (int turn = 0; turn < 100; ++turn) {
    reader.seek(source, begin);
    for (int i = 0; i < 2000; ++i) ASSERT_EQ(reader.next(line), LineReader::Status::line);  // 12 kB
  }
  // Everything up to the loop's end and one read ahead, and no more.
  EXPECT_LE(source.bytes, 12000u * 6 + 32768);
}

struct EmptySource : TextSource {
  ReadResult read(std::uint64_t, char*, std::size_t) override { return {ReadStatus::bytes, 0}; }
};

TEST(LineReader, SourceThatDeliversNothingIsPending) {
  EmptySource source;
  LineReader reader;
  reader.seek(source, {});
  std::string_view line;
  EXPECT_EQ(reader.next(line), LineReader::Status::pending);
}

TEST(LineReader, ByteOrderMarkIsLeftOut) { EXPECT_THAT(lines("\xef\xbb\xbfG0\nX"), ElementsAre("G0", "X")); }

TEST(LineReader, SeekGoesBackToAPosition) {
  StringSource source("a\nb\nc\n");
  LineReader reader;
  reader.seek(source, {});
  std::string_view line;
  ASSERT_EQ(reader.next(line), LineReader::Status::line);
  const TextPosition second = reader.position();
  ASSERT_EQ(reader.next(line), LineReader::Status::line);
  ASSERT_EQ(reader.next(line), LineReader::Status::line);
  EXPECT_EQ(reader.position().line, 4u);
  reader.seek(source, second);
  ASSERT_EQ(reader.next(line), LineReader::Status::line);
  EXPECT_EQ(line, "b");
  EXPECT_EQ(reader.position().line, 3u);
}

}  // namespace
}  // namespace trunnion::language
