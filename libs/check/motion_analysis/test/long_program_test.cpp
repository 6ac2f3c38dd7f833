// SPDX-License-Identifier: Apache-2.0
// Memory does not grow with the length of a program.
#include <gtest/gtest.h>

#include <numbers>
#include <ostream>
#include <streambuf>

#include "analysis/check_program.hpp"
#include "analysis/default_machine.hpp"
#include "motion_analysis/plan_report.hpp"
#include "testing_support/allocation_count.hpp"

namespace trunnion::analysis {
namespace {

/// The same lines again and again, made while they are read; at the end what they call.
class LongText : public language::TextSource {
 public:
  explicit LongText(std::uint64_t repetitions) : end_(repetitions * part_.size()) {}
  LongText(std::uint64_t repetitions, std::string_view part, std::string_view last)
      : part_(part), last_(last), end_(repetitions * part_.size()) {}
  language::ReadResult read(std::uint64_t offset, char* buffer, std::size_t capacity) override {
    const std::uint64_t size = end_ + last_.size();
    if (offset >= size) return {language::ReadStatus::end, 0};
    const auto bytes = static_cast<std::size_t>(std::min<std::uint64_t>(capacity, size - offset));
    for (std::size_t i = 0; i < bytes; ++i) {
      const std::uint64_t at = offset + i;
      buffer[i] = at < end_ ? part_[at % part_.size()] : last_[at - end_];
    }
    return {language::ReadStatus::bytes, bytes};
  }
  std::uint64_t size() const { return end_ + last_.size(); }

 private:
  std::string_view part_ =
      "N10 G90 G1 X1.5 Y2 F1000 (roughing of the upper pocket, first pass, as the post processor says it)\n"
      "G3 X3 Y3.5 R1.5 (a comment of some length, for the length of the text is what this is all about)\n"
      "#1=[#1+1]*0.5\nG68 X0 Y0 R30\nG0 Z[5+#1*0]\nG69\nG0 X0 Y0\n";
  std::string_view last_ = "M98 P7\nM30\nO7\nG0 X9\nM99\n";
  std::uint64_t end_;
};

struct Nowhere : std::streambuf {
  int overflow(int c) override { return c; }
  std::streamsize xsputn(const char*, std::streamsize size) override {
    written += static_cast<std::uint64_t>(size);
    return size;
  }
  std::uint64_t written = 0;
};

std::size_t allocations_of(LongText& text, bool json_lines, Nowhere& nowhere) {
  DefaultMachine machine({});
  std::ostream out(&nowhere);
  CheckOptions options;
  options.json_lines = json_lines;
  const auto before = testing_support::allocations;
  EXPECT_TRUE(check_program(
      text, machine, {}, options, [](std::uint32_t) { return "long.nc"; }, out));
  return testing_support::allocations - before;
}

TEST(LongProgram, FiftyMegabytesAllocateNoMoreThanFiveKilobytes) {
  for (const bool json_lines : {false, true}) {
    LongText brief(20), lengthy(201'000);
    EXPECT_LT(brief.size(), 6'000u);
    EXPECT_GT(lengthy.size(), 50'000'000u);
    Nowhere little, much;
    const auto few = allocations_of(brief, json_lines, little);
    // The figures of the summary are longer: a text of more than 15 characters takes memory of its own.
    EXPECT_LE(allocations_of(lengthy, json_lines, much), few + 2);
    if (json_lines) {
      EXPECT_GT(much.written, 9000 * little.written);
    }
  }
}

// A circle of R5 in chords of 0.1 mm at the programmed feed, then a corner, where the least time is solved.
std::string circle_and_corner() {
  std::string text;
  for (int k = 1; k <= 314; ++k) {
    char line[60];
    const double angle = 2 * std::numbers::pi * k / 314;
    std::snprintf(line, sizeof line, "G1 X%.4f Y%.4f F3000\n", 5 * std::cos(angle), 5 * std::sin(angle));
    text += line;
  }
  return text + "G1 X7\nX5\n";
}

TEST(LongProgram, PlanningTakesNoMoreMemoryForMoreBlocks) {
  const std::string part = circle_and_corner();
  constexpr std::uint64_t circles = 250, early = 100, blocks_of_one = 316;
  LongText text(circles, part, "M30\n");
  auto tables = tool_tables::load_machine_tables(std::string(MACHINES_DIRECTORY) + "/ac-table");
  tables.offsets.offsets.clear();
  channel_setup::ChannelSetup machine(tables);
  const std::size_t before = testing_support::live_bytes;
  std::size_t most_early = 0, most = 0;
  const PlanReport report = plan_program(text, machine, {}, [&](const PlannedCycle& cycle) {
    most = std::max(most, testing_support::live_bytes - before);
    if (cycle.setpoint->line < early * blocks_of_one) most_early = most;
  });
  ASSERT_TRUE(report.result.good) << report.result.alarm;
  EXPECT_EQ(report.result.blocks, circles * blocks_of_one);
  // The tables that the planner itself holds are some megabytes.
  EXPECT_GT(most_early, 1'000'000u);
  EXPECT_EQ(most, most_early);
  EXPECT_LT(most, 100'000'000u);
}

}  // namespace
}  // namespace trunnion::analysis
