// SPDX-License-Identifier: Apache-2.0
#include "text/utf8.hpp"

#include <gtest/gtest.h>

#include <string>

namespace trunnion::text {
namespace {

TEST(Utf8, WellFormedAndIllFormedSequences) {
  // Unicode 15 table 3-7: first and last sequence of each row, and their neighbours outside.
  for (const char* good :
       {"", "abc", "\xc2\x80", "\xdf\xbf", "\xe0\xa0\x80", "\xed\x9f\xbf", "\xee\x80\x80", "\xef\xbf\xbf",
        "\xf0\x90\x80\x80", "\xf4\x8f\xbf\xbf", "12345678\u00e412345678"}) {
    EXPECT_EQ(valid_utf8_prefix(good), std::string_view(good).size()) << good;
  }
  for (const char* bad :
       {"ab\x80", "ab\xc1\xbf", "ab\xc3", "ab\xe0\x9f\xbf", "ab\xed\xa0\x80", "ab\xf0\x8f\xbf\xbf",
        "ab\xf4\x90\x80\x80", "ab\xf5\x80\x80\x80", "ab\xe2\x82", "ab\xff"}) {
    EXPECT_EQ(valid_utf8_prefix(bad), 2u) << bad;
  }
}

TEST(Shortened, LeavesWhatFitsAndMarksWhatDoesNot) {
  EXPECT_EQ(shortened("", 8), "");
  EXPECT_EQ(shortened("12345678", 8), "12345678");
  EXPECT_EQ(shortened("123456789", 8), "1234 ...");
  EXPECT_EQ(shortened("12  56789", 8), "12 ...");
  EXPECT_EQ(shortened("123456789", 4), " ...");
}

std::string readable(std::string_view text, std::size_t most = 64) {
  std::string out(most, '\0');
  out.resize(copy_readable(text, out));
  return out;
}

// In Windows-1252 80 is the euro sign (U+20AC), 81 is not there, 9f is U+0178 and e9 U+00E9.
TEST(CopyReadable, TakesWhatIsNoUtf8ForWindows1252) {
  EXPECT_EQ(readable("plain"), "plain");
  EXPECT_EQ(readable("\xc3\xa9"), "\xc3\xa9") << "UTF-8 stays";
  EXPECT_EQ(readable("\xe9"), "\xc3\xa9");
  EXPECT_EQ(readable("M\x80 \x9f\x81."), "M\xe2\x82\xac \xc5\xb8?.");
  EXPECT_EQ(readable("F\xdcR"), "F\xc3\x9cR") << "dc begins two bytes of UTF-8, which R does not continue";
  EXPECT_EQ(readable(std::string_view("a\tb\0c\x7f", 6)), "a?b?c?");
}

TEST(CopyReadable, WritesWholeCharactersAsFarAsTheyFit) {
  EXPECT_EQ(readable("12\x80", 4), "12");
  EXPECT_EQ(readable("12\x80", 5), "12\xe2\x82\xac");
  EXPECT_EQ(readable("12\xc3\xa9", 3), "12");
  EXPECT_EQ(readable("abc", 0), "");
}

TEST(CharacterCount, CountsABrokenByteAsOne) {
  EXPECT_EQ(character_count(""), 0u);
  EXPECT_EQ(character_count("a\xc3\xa9z"), 3u);
  EXPECT_EQ(character_count("a\xb0z"), 3u);
  EXPECT_EQ(character_count("\xe5\x8f"), 2u);
}

// With 10 bytes six are left before the mark: the three bytes of the euro sign are the fifth to the seventh.
TEST(Shortened, CutsNoCharacterInTwo) {
  EXPECT_EQ(shortened("1234\xe2\x82\xac"
                      "5678",
                      10),
            "1234 ...");
  EXPECT_EQ(shortened("123\xe2\x82\xac"
                      "45678",
                      10),
            "123\xe2\x82\xac ...");
  EXPECT_EQ(shortened("12345\xc3\xa9"
                      "6789",
                      10),
            "12345 ...");
}

TEST(Shortened, IsNeverLongerThanItMayBe) {
  std::string text;
  for (int i = 0; i < 30; ++i) text += i % 3 == 0 ? "x" : i % 3 == 1 ? "\xc3\xa9" : "\xf0\x9f\x98\x80";
  for (std::size_t most = 4; most < text.size(); ++most) {
    const auto found = shortened(text, most);
    EXPECT_LE(found.size(), most);
    EXPECT_GT(found.size() + 4, most) << "a character has four bytes at most";
    EXPECT_EQ(valid_utf8_prefix(found), found.size());
    EXPECT_TRUE(found.ends_with(" ..."));
  }
}

// The bytes of the letter A with a diaeresis, c3 84, stay.
TEST(LowerCase, ChangesTheLettersAToZAlone) {
  EXPECT_EQ(lower_case("G43.4 Az[@"), "g43.4 az[@");
  EXPECT_EQ(lower_case("\xc3\x84"), "\xc3\x84");
}

}  // namespace
}  // namespace trunnion::text
