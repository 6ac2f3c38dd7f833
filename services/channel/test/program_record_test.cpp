// SPDX-License-Identifier: Apache-2.0
#include "program_record.hpp"

#include <gtest/gtest.h>

namespace trunnion::channel {
namespace {

TEST(ProgramRecord, ComesBackAsItWas) {
  const RunningProgram program{
      {"part 7.nc", 12, 0xfffffffeu, 3000000000u}, 1ull << 40, 4000000000u, 4000000001u, 1ull << 41};
  EXPECT_EQ(read_record(write_record(program), "f"), program);
  RunningProgram tapping = program;
  tapping.tap = {-1.25, {10, 0, 2}, {0, 0, -1}};
  EXPECT_EQ(read_record(write_record(tapping), "f"), tapping);
  EXPECT_EQ(read_record(write_record({}), "f"), RunningProgram{});
}

TEST(ProgramRecord, HasALineForWhatIsNotZero) {
  EXPECT_EQ(write_record({{"part 7.nc", 12, 77, 0}, 0, 8}),
            "trunnion program 5\nname part 7.nc\nrevision 12\ncrc 77\nparts 8\n");
  for (const char* bad : {"parts -1", "parts", "part 1", "7", "tool 4294967296"}) {
    try {
      read_record(std::string("trunnion program 5\nline 3\n") + bad + "\n", "channel-0.program");
      ADD_FAILURE() << bad;
    } catch (const std::runtime_error& e) {
      EXPECT_TRUE(std::string(e.what()).starts_with("channel-0.program:3: ")) << e.what();
    }
  }
}

// Checksums of the lines before them, by Python's zlib.crc32.
constexpr const char* record_of_format_4 =
    "trunnion program 4\n12\n77\n40\npart.nc\n900\n8\n3\n850\n583633928\n";

TEST(ProgramRecord, OfTheVersionsBeforeIsRead) {
  EXPECT_EQ(read_record(record_of_format_4, "f"), (RunningProgram{{"part.nc", 12, 77, 40}, 900, 8, 3, 850}));
  EXPECT_EQ(read_record("trunnion program 3\n12\n77\n40\npart.nc\n900\n8\n959751251\n", "f"),
            (RunningProgram{{"part.nc", 12, 77, 40}, 900, 8}));
  EXPECT_EQ(read_record("trunnion program 2\n12\n77\n40\npart.nc\n900\n825921896\n", "f"),
            (RunningProgram{{"part.nc", 12, 77, 40}, 900}));
  EXPECT_EQ(read_record("trunnion program 1\n12\n77\n40\npart.nc\n1426826806\n", "f"),
            (RunningProgram{{"part.nc", 12, 77, 40}, 0}));
  EXPECT_THROW(read_record("trunnion program 1\n12\n77\n41\npart.nc\n1426826806\n", "f"), std::runtime_error);
  EXPECT_THROW(read_record("trunnion program 1\n12\n77\n40\npart.nc\n1426826806\nx", "f"),
               std::runtime_error);
  EXPECT_THROW(read_record("trunnion program 6\nname part.nc\n", "f"), std::runtime_error);
}

TEST(ProgramRecord, OfTheVersionsBeforeNoByteMayBeMissingOrChanged) {
  const std::string text = record_of_format_4;
  for (std::size_t n = 0; n < text.size(); ++n) {
    EXPECT_THROW(read_record(text.substr(0, n), "f"), std::runtime_error) << n;
    auto other = text;
    other[n] = static_cast<char>(other[n] ^ 1);
    EXPECT_THROW(read_record(other, "f"), std::runtime_error) << n;
  }
}

}  // namespace
}  // namespace trunnion::channel
