// SPDX-License-Identifier: Apache-2.0
#include "program_record.hpp"

#include <gtest/gtest.h>

namespace trunnion::channel {
namespace {

TEST(ProgramRecord, ComesBackAsItWas) {
  const RunningProgram program{"part 7.nc", 12, 0xfffffffeu, 3000000000u};
  EXPECT_EQ(read_record(write_record(program), "f"), program);
  EXPECT_EQ(read_record(write_record({}), "f"), RunningProgram{});
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
