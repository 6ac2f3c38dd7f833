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

TEST(LineReader, LineEndsAcrossTheWindow) {
  // The window is 16384 bytes: one line end is put at every place around its edge.
  for (std::size_t size = 16380; size < 16390; ++size) {
    std::string text;
    while (text.size() + 1001 < size) text += std::string(1000, 'x') + "\n";
    text += std::string(size - text.size(), 'y') + "\r\nz";
    const auto result = lines(text);
    ASSERT_EQ(result.size(), 18u) << size;  // 16 lines of 1001 bytes = 16016, the y, the z
    EXPECT_EQ(result[17], "z");
  }
}

TEST(LineReader, LongestLine) {
  EXPECT_THAT(lines(std::string(1024, 'x') + "\na"), ElementsAre(std::string(1024, 'x'), "a"));
  EXPECT_THAT(lines(std::string(1024, 'x')), ElementsAre(std::string(1024, 'x')));
  StringSource source("\n");
  const std::string text = std::string(1025, 'x') + "\na";
  StringSource longer(text);
  LineReader reader;
  reader.seek(longer, {});
  std::string_view line;
  EXPECT_EQ(reader.next(line), LineReader::Status::too_long);
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
