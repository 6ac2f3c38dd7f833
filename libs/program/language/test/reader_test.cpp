// SPDX-License-Identifier: Apache-2.0
// Numbers, blocks and UTF-8.
#include <gtest/gtest.h>

#include <cstdlib>
#include <optional>
#include <random>
#include <tuple>

#include "language/codes.hpp"
#include "language/decimal.hpp"
#include "language/interpreter.hpp"
#include "language/iso_dialect.hpp"

namespace trunnion::language {
namespace {

Decimal decimal(std::string_view text) { return read_decimal(text.data(), text.data() + text.size()); }

TEST(Decimal, FormsOfANumber) {
  for (const auto& [text, value] : {std::pair{"5", 5.0},
                                    {"5.", 5.0},
                                    {".5", 0.5},
                                    {"+5", 5.0},
                                    {"-.5", -0.5},
                                    {"007.250", 7.25},
                                    {"-0", 0.0},
                                    {"999999999", 999999999.0}}) {
    EXPECT_EQ(decimal(text).status, DecimalStatus::ok) << text;
    EXPECT_EQ(decimal(text).value, value) << text;
  }
  for (const char* text : {"", "-", "+", ".", "-.", "X", "--1", "+-1"}) {
    EXPECT_EQ(decimal(text).status, DecimalStatus::missing) << text;
  }
  EXPECT_EQ(decimal("1000000000").status, DecimalStatus::too_large);
  EXPECT_EQ(decimal(std::string(1000, '9')).status, DecimalStatus::too_large);
  EXPECT_EQ(decimal("-" + std::string(1000, '9')).status, DecimalStatus::too_large);
  EXPECT_EQ(decimal(std::string(500, '0') + "7").value, 7.0);
  EXPECT_EQ(decimal("0." + std::string(500, '0') + "7").value, 0.0);
  EXPECT_EQ(*decimal("12.5Y").end, 'Y');
}

TEST(Decimal, IsTheNearestDoubleForEveryNumberOfDigits) {
  std::mt19937_64 random(1);
  for (int i = 0; i < 200000; ++i) {
    std::string text = i % 2 == 0 ? "-" : "";
    const int whole = static_cast<int>(random() % 9);
    const int fraction = static_cast<int>(random() % 20) + (whole == 0 ? 1 : 0);
    for (int k = 0; k < whole; ++k) text += static_cast<char>('0' + random() % 10);
    text += '.';
    for (int k = 0; k < fraction; ++k) text += static_cast<char>('0' + random() % 10);
    ASSERT_EQ(decimal(text).value, std::strtod(text.c_str(), nullptr)) << text;  // strtod rounds exactly
  }
}

/// Reads lines as a program without system variables would.
struct Reading : SystemVariables {
  AlarmNumber read(const VariableRange&, std::uint32_t, Value&) const override {
    return AlarmNumber::variable_unknown;
  }
  AlarmNumber write(const VariableRange&, std::uint32_t, Value) override {
    return AlarmNumber::variable_unknown;
  }

  Reading() : variables(*this) { variables.start(no_variables); }
  Fault operator()(std::string_view line, SkipLevels skip = 0) {
    return IsoDialect().read_block(line, skip, variables, block);
  }
  Variables variables;
  Block block;
};

TEST(IsoDialect, BlockHoldsWordsByLetter) {
  Reading read;
  ASSERT_FALSE(read("/ n10 G01x-1.5 (two words) y 2 M3 m8 ; X9"));
  EXPECT_EQ(read.block.letters, Block::bit('N') | Block::bit('X') | Block::bit('Y'));
  EXPECT_EQ(read.block.value('N'), 10);
  EXPECT_EQ(read.block.value('X'), -1.5);
  EXPECT_EQ(read.block.value('Y'), 2);
  EXPECT_EQ(read.block.offset('X'), 9);
  ASSERT_EQ(read.block.g_count, 1);
  EXPECT_EQ(read.block.g[0].value, 1);
  ASSERT_EQ(read.block.m_count, 2);
  EXPECT_EQ(read.block.m[1].value, 8);
}

TEST(IsoDialect, SkippedBlockIsNotRead) {
  Reading read;
  for (const char* line : {"/G0 X1", "/1 G0 X1", " / X1 )", "N10 / X1", "N10/1 #1=1"}) {
    ASSERT_FALSE(read(line, 0b1)) << line;
    EXPECT_TRUE(read.block.skipped) << line;
    EXPECT_FALSE(read.block.has('X')) << line;
  }
  ASSERT_FALSE(read("/2 G0 X1", 0b1));
  EXPECT_FALSE(read.block.skipped);
  EXPECT_TRUE(read.block.has('X'));
  ASSERT_FALSE(read("/9 G0 X1", 0b100000000));
  EXPECT_TRUE(read.block.skipped);
  Value value;
  ASSERT_EQ(read.variables.read(1, value), AlarmNumber::none);
  EXPECT_FALSE(value.given);
}

TEST(IsoDialect, SkipInTheMiddleLeavesOutTheRestOfTheBlock) {
  Reading read;
  ASSERT_FALSE(read("G0 X1 /2 Y1 )", 0b10));
  EXPECT_FALSE(read.block.skipped);
  EXPECT_EQ(read.block.letters, Block::bit('X'));
  ASSERT_FALSE(read("G0 X1 /2 Y1", 0b1));
  EXPECT_TRUE(read.block.has('Y'));
  for (const char* line : {"/1/3 G0 X1", "/1 /3 G0 X1", "(c) /3 G0 X1", "/1 N5 /3 G0 X1", "N5 (c) /1/3 X1"}) {
    ASSERT_FALSE(read(line, 0b100)) << line;
    EXPECT_TRUE(read.block.skipped) << line;
    ASSERT_FALSE(read(line, 0b10)) << line;
    EXPECT_FALSE(read.block.skipped) << line;
    EXPECT_TRUE(read.block.has('X')) << line;
  }
}

TEST(IsoDialect, BlanksInsideNumbersMeanNothing) {
  Reading read;
  ASSERT_FALSE(read("G 43 . 4 X 1 . 5 Y - .5 Z1. 25 A1 .5\tB\t-\t2 M 3"));
  EXPECT_EQ(read.block.g[0].value, 43.4);
  EXPECT_EQ(read.block.value('X'), 1.5);
  EXPECT_EQ(read.block.value('Y'), -0.5);
  EXPECT_EQ(read.block.value('Z'), 1.25);
  EXPECT_EQ(read.block.value('A'), 1.5);
  EXPECT_EQ(read.block.value('B'), -2);
}

TEST(IsoDialect, EightMCodes) {
  Reading read;
  ASSERT_FALSE(read("M3 M8 M10 M11 M12 M13 M14 M15"));
  EXPECT_EQ(read.block.m_count, 8);
}

TEST(IsoDialect, CommentsMayHoldAnyBytes) {
  Reading read;
  // "\xd6\xd0" is a Chinese character in GBK, the encoding of programs older than UTF-8.
  ASSERT_FALSE(read("G0 (\xd6\xd0) X1 ;\xd6\xd0"));
  EXPECT_TRUE(read.block.has('X'));
  ASSERT_FALSE(read("* Machine: \xd6\xd0 # ) anything"));
  EXPECT_TRUE(read.block.empty());
  EXPECT_EQ(read("G0 X1 \xd6\xd0").number, AlarmNumber::not_utf8);
  EXPECT_EQ(read("G0 X1 \xc3\xa4").number, AlarmNumber::unknown_character);
}

TEST(IsoDialect, WordsMayBeComputed) {
  Reading read;
  ASSERT_FALSE(read("#1=2 #2=3.5"));
  ASSERT_FALSE(read("G#1 X[#1+2] Y-#2 Z - [ #1 * #2 ] A#[#1-1+1] B+#1"));
  EXPECT_EQ(read.block.g[0].value, 2);
  EXPECT_EQ(read.block.value('X'), 4);
  EXPECT_EQ(read.block.value('Y'), -3.5);
  EXPECT_EQ(read.block.value('Z'), -7);
  EXPECT_EQ(read.block.value('A'), 3.5);  // #[2-1+1]
  EXPECT_EQ(read.block.value('B'), 2);
}

TEST(IsoDialect, WordOfAVacantVariableIsLeftOut) {
  Reading read;
  ASSERT_FALSE(read("G0 X#1 Y5 Z-#0"));
  EXPECT_EQ(read.block.letters, Block::bit('Y'));
}

TEST(IsoDialect, Heads) {
  const IsoDialect dialect;
  const auto head = [&](std::string_view line) {
    const Outline outline = dialect.outline(line, 0);
    return outline.head == Head::program ? std::optional(outline.program_number) : std::nullopt;
  };
  EXPECT_EQ(head("%1234"), 1234u);
  EXPECT_EQ(head(" o0012 (x)"), 12u);
  EXPECT_EQ(head("%"), std::nullopt);
  EXPECT_EQ(head("N1 O2"), std::nullopt);
  EXPECT_EQ(head(""), std::nullopt);
  EXPECT_EQ(head("* O12"), std::nullopt);
  EXPECT_EQ(head(":1000 (x)"), 1000u);
  EXPECT_EQ(head("%O1000"), 1000u);
  EXPECT_EQ(head("% : 1000"), 1000u);
  EXPECT_EQ(head("(x) O12"), 12u);
  EXPECT_EQ(head("/1/2 O12"), 12u);
  EXPECT_EQ(head("O<NAME>"), 0u);
  EXPECT_EQ(head("<NAME> (x)"), 0u);
  EXPECT_EQ(head("% PART 12"), std::nullopt);
  EXPECT_EQ(head("OPART"), std::nullopt);
  Reading read;
  ASSERT_FALSE(read("% "));
  EXPECT_EQ(read.block.head, Head::tape_mark);
}

TEST(IsoDialect, OutlineSeesWhatABlockWillBe) {
  using enum Statement;
  const IsoDialect dialect;
  for (const auto& [line, statement, label] : {std::tuple{"IF [#1 EQ 2]", begin_if, 0u},
                                               {"if#1 EQ 2 then ; all", begin_if, 0u},
                                               {"N5 IF[#1EQ2] (GOTO 7)", begin_if, 0u},
                                               {"IF[#1EQ2]GOTO 7", none, 0u},
                                               {"IF[#1EQ2]THEN#1=2", none, 0u},
                                               {"ELSEIF #1 EQ 2", else_if, 0u},
                                               {"ELSE (no)", else_, 0u},
                                               {"ENDIF", end_if, 0u},
                                               {"WHILE[#1LT2]DO1", begin_do, 1u},
                                               {"WHILE #1 LT 2", begin_while, 0u},
                                               {"DO 12", begin_do, 12u},
                                               {"END12", end_do, 12u},
                                               {"/ENDW", end_while, 0u},
                                               {"(rest) IF [#1 EQ 2]", begin_if, 0u},
                                               {"(a) N5 (b) ENDIF", end_if, 0u},
                                               {"N5 (b) /2 DO3", begin_do, 3u},
                                               {"IF[1]THEN IF[0]GOTO 7", none, 0u},
                                               {"D1 E2", none, 0u},
                                               {"WH[#1LT2]DO1", begin_do, 1u},
                                               {"wh #1 LT 2", begin_while, 0u},
                                               {"EN12", end_do, 12u},
                                               {"IF[#1EQ2]TH#1=2", none, 0u},
                                               {"IF[#1EQ2] TH (all)", begin_if, 0u},
                                               {"/1/3 ENDW", end_while, 0u},
                                               {"(a) /2 ENDIF", end_if, 0u},
                                               {"/1 (a) N5 /3 DO4", begin_do, 4u},
                                               {"\x0c\x11 N5 \x13 ELSE \x04", else_, 0u},
                                               {"G1 X1", none, 0u}}) {
    const Outline outline = dialect.outline(line, 0);
    EXPECT_EQ(outline.statement, statement) << line;
    EXPECT_EQ(outline.label, label) << line;
    // What is executed must agree with what a search sees.
    Reading read;
    ASSERT_FALSE(read(line)) << line;
    if (read.block.statement != go_to && read.block.statement != assignment) {
      EXPECT_EQ(read.block.statement, statement) << line;
    }
  }
  EXPECT_EQ(dialect.outline("/ENDW", 1).statement, none);
  EXPECT_EQ(dialect.outline("N10", 0).sequence_number, 10u);
  EXPECT_EQ(dialect.outline(" /2 n 10 G1", 0).sequence_number, 10u);
  EXPECT_EQ(dialect.outline("N10.5 G1", 0).sequence_number, std::nullopt);
  EXPECT_EQ(dialect.outline("/N10", 1).sequence_number, std::nullopt);
  EXPECT_EQ(dialect.outline("(a) N10", 1).sequence_number, 10u);
  EXPECT_EQ(dialect.outline("/1/3 N10", 0b10).sequence_number, 10u);
  EXPECT_EQ(dialect.outline("/1/3 N10", 0b100).sequence_number, std::nullopt);
  EXPECT_EQ(dialect.outline("(a) /3 N10", 0b100).sequence_number, std::nullopt);
  EXPECT_EQ(dialect.outline("\x0cN10", 0).sequence_number, 10u);
  EXPECT_EQ(dialect.outline("(a N10", 1).sequence_number, std::nullopt);
}

TEST(IsoDialect, NoStructureBehindThenOnOneLine) {
  // A search for ENDIF decides by the text alone; a structure that opens only when a condition holds could
  // not be found again.
  for (const auto* line :
       {"IF[1]THEN IF[1]THEN", "IF[1]THEN IF[0]", "IF[1]THEN WHILE[0]DO1", "IF[1]THEN ENDIF"}) {
    EXPECT_EQ(Reading()(line).number, AlarmNumber::statement_not_first) << line;
  }
}

TEST(Codes, EveryCodeIsFoundByItsNumberAndHasAMeaning) {
  for (const GCode& code : g_codes) {
    EXPECT_EQ(g_code(code.tenths), &code);
    EXPECT_STRNE(code.meaning, "");
  }
  EXPECT_EQ(g_code(436), nullptr);
  EXPECT_EQ(g_code(1000), nullptr);
  EXPECT_EQ(m_code(30).action, MAction::program_end);
  EXPECT_EQ(m_code(500).when, When::before);
}

}  // namespace
}  // namespace trunnion::language
