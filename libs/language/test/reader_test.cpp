// Numbers, blocks and UTF-8.
#include <gtest/gtest.h>

#include <cstdlib>
#include <random>

#include "language/codes.hpp"
#include "language/decimal.hpp"
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

TEST(IsoDialect, BlockHoldsWordsByLetter) {
  Block block;
  ASSERT_FALSE(IsoDialect().read_block("/ n10 G01x-1.5 (two words) y 2 M3 m8 ; X9", block));
  EXPECT_TRUE(block.skip);
  EXPECT_EQ(block.letters, Block::bit('N') | Block::bit('X') | Block::bit('Y'));
  EXPECT_EQ(block.value('N'), 10);
  EXPECT_EQ(block.value('X'), -1.5);
  EXPECT_EQ(block.value('Y'), 2);
  EXPECT_EQ(block.offset('X'), 9);
  ASSERT_EQ(block.g_count, 1);
  EXPECT_EQ(block.g[0].value, 1);
  ASSERT_EQ(block.m_count, 2);
  EXPECT_EQ(block.m[1].value, 8);
}

TEST(IsoDialect, Heads) {
  const IsoDialect dialect;
  EXPECT_EQ(dialect.program_head("%1234"), 1234u);
  EXPECT_EQ(dialect.program_head(" o0012 (x)"), 12u);
  EXPECT_EQ(dialect.program_head("%"), std::nullopt);
  EXPECT_EQ(dialect.program_head("N1 O2"), std::nullopt);
  EXPECT_EQ(dialect.program_head(""), std::nullopt);
  Block block;
  ASSERT_FALSE(dialect.read_block("% ", block));
  EXPECT_EQ(block.head, Head::tape_mark);
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
