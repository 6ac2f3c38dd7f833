// SPDX-License-Identifier: Apache-2.0
#include "program_record.hpp"

#include <gtest/gtest.h>

namespace trunnion::channel {
namespace {

TEST(ProgramRecord, ComesBackAsItWas) {
  const RunningProgram program{"part 7.nc", 12,          0xfffffffeu, 3000000000u,
                               1ull << 40,  4000000000u, 4000000001u, 1ull << 41};
  EXPECT_EQ(read_record(write_record(program), "f"), program);
  EXPECT_EQ(read_record(write_record({}), "f"), RunningProgram{});
}

TEST(ProgramRecord, OfTheVersionsBeforeIsRead) {
  // Checksums of the lines before them, by Python's zlib.crc32.
  EXPECT_EQ(read_record("trunnion program 3\n12\n77\n40\npart.nc\n900\n8\n959751251\n", "f"),
            (RunningProgram{"part.nc", 12, 77, 40, 900, 8}));
  EXPECT_EQ(read_record("trunnion program 2\n12\n77\n40\npart.nc\n900\n825921896\n", "f"),
            (RunningProgram{"part.nc", 12, 77, 40, 900}));
  EXPECT_EQ(read_record("trunnion program 1\n12\n77\n40\npart.nc\n1426826806\n", "f"),
            (RunningProgram{"part.nc", 12, 77, 40, 0}));
  EXPECT_THROW(read_record("trunnion program 1\n12\n77\n41\npart.nc\n1426826806\n", "f"), std::runtime_error);
  EXPECT_THROW(read_record("trunnion program 1\n12\n77\n40\npart.nc\n1426826806\nx", "f"),
               std::runtime_error);
}

TEST(ProgramRecord, NoByteMayBeMissingOrChanged) {
  const auto text = write_record({"part.nc", 12, 77, 40});
  for (std::size_t n = 0; n < text.size(); ++n) {
    EXPECT_THROW(read_record(text.substr(0, n), "f"), std::runtime_error) << n;
    auto other = text;
    other[n] = static_cast<char>(other[n] ^ 1);
    EXPECT_THROW(read_record(other, "f"), std::runtime_error) << n;
  }
}

}  // namespace
}  // namespace trunnion::channel
