// SPDX-License-Identifier: Apache-2.0
// WSTRING: lengths and positions count characters, whatever bytes they have in UTF-8.
#include <random>

#include "plc/machine/strings.hpp"
#include "translated.hpp"

namespace trunnion::st {
namespace {

// Of one, two and three bytes.
const std::vector<std::string> letters = {"a", "z", "\xc3\xa9", "\xce\xa9", "\xe4\xb8\xad", "\xe2\x82\xac"};

using Word = std::vector<std::string>;  // its characters

Word random_word(std::mt19937& random, std::size_t longest) {
  Word word(random() % (longest + 1));
  for (auto& letter : word) letter = letters[random() % letters.size()];
  return word;
}
std::string text(const Word& word) {
  std::string result;
  for (const auto& letter : word) result += letter;
  return result;
}
Word part(const Word& word, std::size_t from, std::size_t count) {
  return {word.begin() + static_cast<std::ptrdiff_t>(from),
          word.begin() + static_cast<std::ptrdiff_t>(from + count)};
}
Word joined(Word a, const Word& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}
std::string quoted(const Word& word) { return "\"" + text(word) + "\""; }

TEST(WideString, FunctionsCountCharactersLikeAListOfThem) {
  Translated program(
      "VAR a, b : WSTRING[12]; l, p : INT; len, place : INT; left, right, mid, erased : WSTRING[12];\n"
      "  joined, inserted, replaced : WSTRING[24]; less, same : BOOL; short : WSTRING[3]; END_VAR",
      "len := LEN(a); place := FIND(a, b); left := LEFT(a, l); right := RIGHT(a, l); mid := MID(a, l, p);\n"
      "joined := CONCAT(a, b); inserted := INSERT(a, b, p); erased := DELETE(a, l, p);\n"
      "replaced := REPLACE(a, b, l, p); same := a = b; less := a < b; short := a;");
  std::mt19937 random(2);
  for (int round = 0; round < 400; ++round) {
    auto a = random_word(random, 11);
    a.push_back("x");
    const auto b = random() % 4 == 0 && a.size() > 2 ? part(a, 1, 2) : random_word(random, 12);
    const auto p = 1 + random() % a.size();
    const auto l = random() % (a.size() - p + 2);
    program.set("a", quoted(a)), program.set("b", quoted(b));
    program.set("l", std::to_string(l)), program.set("p", std::to_string(p));
    ASSERT_EQ(program.scan(), "");
    const auto size = a.size();
    std::size_t found = 0;
    for (std::size_t i = 0; !b.empty() && found == 0 && i + b.size() <= size; ++i)
      if (part(a, i, b.size()) == b) found = i + 1;
    EXPECT_EQ(program.get("len"), std::to_string(size));
    EXPECT_EQ(program.get("place"), std::to_string(found));
    EXPECT_EQ(program.get("left"), quoted(part(a, 0, l)));
    EXPECT_EQ(program.get("right"), quoted(part(a, size - l, l)));
    EXPECT_EQ(program.get("mid"), quoted(part(a, p - 1, l)));
    EXPECT_EQ(program.get("joined"), quoted(joined(a, b)));
    EXPECT_EQ(program.get("inserted"), quoted(joined(joined(part(a, 0, p), b), part(a, p, size - p))));
    EXPECT_EQ(program.get("erased"), quoted(joined(part(a, 0, p - 1), part(a, p - 1 + l, size - p + 1 - l))));
    EXPECT_EQ(program.get("replaced"),
              quoted(joined(joined(part(a, 0, p - 1), b), part(a, p - 1 + l, size - p + 1 - l))));
    EXPECT_EQ(program.get("same"), a == b ? "TRUE" : "FALSE");
    EXPECT_EQ(program.get("short"), quoted(part(a, 0, std::min<std::size_t>(3, size))))
        << "cut off by characters";
    ASSERT_FALSE(HasFailure()) << quoted(a) << " " << quoted(b) << " " << l << " " << p;
  }
}

TEST(WideString, LiteralsHaveCodesAndConvert) {
  Translated program(
      "VAR w : WSTRING[9] := \"a$00e9$4E2d$\"$N\"; n : INT; s : STRING; v, u : WSTRING; list : ARRAY[0..1] "
      "OF WSTRING[3] := "
      "[\"b\", \"$20AC\"]; END_VAR",
      "n := LEN(w); s := WSTRING_TO_STRING(MID(w, 2, 2)); v := STRING_TO_WSTRING('$C3$A9$FFx');\n"
      "u := CONCAT(INT_TO_WSTRING(n), list[1], WSTRING#\"!\"); n := n + WSTRING_TO_INT(\"40\");");
  ASSERT_EQ(program.scan(), "");
  EXPECT_EQ(program.get("w"), "\"a\xc3\xa9\xe4\xb8\xad\"\n\"");
  EXPECT_EQ(program.get("n"), "45");
  EXPECT_EQ(program.get("s"), "'\xc3\xa9\xe4\xb8\xad'");
  EXPECT_EQ(program.get("v"), "\"\xc3\xa9?x\"") << "a byte that is no UTF-8";
  EXPECT_EQ(program.get("u"), "\"5\xe2\x82\xac!\"");
}

TEST(WideString, WhatIsNoneIsRefused) {
  const auto first = [](const std::string& source) {
    const auto lines = compile({{"t.st", source}}, interface_registers()).lines();
    return lines.empty() ? "" : lines[0];
  };
  EXPECT_EQ(first("PROGRAM main VAR w : WSTRING[334]; END_VAR w := w; END_PROGRAM"),
            "t.st:1:22: error: the length of a WSTRING is 1 .. 333, not 334");
  EXPECT_EQ(
      first("PROGRAM main VAR w : WSTRING; END_VAR w := CONCAT(w, 'a'); END_PROGRAM"),
      "t.st:1:44: error: CONCAT is for STRING or for WSTRING, not for both; convert with STRING_TO_WSTRING");
  EXPECT_EQ(first("PROGRAM main VAR w : WSTRING; END_VAR w := 'a'; END_PROGRAM"),
            "t.st:1:44: error: expected WSTRING[80], found STRING[1]; convert with STRING_TO_WSTRING");
  EXPECT_EQ(first("PROGRAM main VAR w : WSTRING; END_VAR w := \"\xf0\x9f\x98\x80\"; END_PROGRAM"),
            "t.st:1:44: error: a WSTRING has characters of at most 16 bits, in UTF-8");
}

}  // namespace
}  // namespace trunnion::st
