// SPDX-License-Identifier: Apache-2.0
// Instruction lists in files: truth tables, words, blocks by time, errors with their places.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "checked_compilation.hpp"
#include "plc/library/register_names.hpp"

namespace trunnion::st {
namespace {

/// main.il, run at chosen times.
class ListRun {
 public:
  explicit ListRun(const std::string& source)
      : compilation(compile({{"main.il", source}}, interface_registers())), run_(checked(compilation)) {}
  /// One scan, `now` in ms.
  ListRun& at(std::int64_t now) {
    EXPECT_EQ(run_.scan("", (now - now_) * 1000000).kind, FaultKind::none);
    now_ = now;
    return *this;
  }
  Fault scan() { return run_.scan("", 0); }
  bool bit(const std::string& path) const { return run_.get(path) == "TRUE"; }
  std::int64_t word(const std::string& path) const { return std::stoll(run_.get(path)); }
  void put(const std::string& path, bool value) { run_.set(path, value ? "TRUE" : "FALSE"); }
  void put(const std::string& path, int value) { run_.set(path, std::to_string(value)); }
  const Machine& machine() { return run_.machine(); }
  /// When the next timer ends, ms from the first scan on; -1: none runs.
  std::int64_t timer_end() {
    const auto end = run_.machine().next_timer_end(run_.now());
    return end ? *end / 1000000 : -1;
  }
  std::string get(const std::string& path) const { return run_.get(path); }

  const Compilation compilation;

 private:
  SourceRun run_;
  std::int64_t now_ = 0;
};

std::string list_error(const std::string& source, const std::string& name = "t.il") {
  const auto lines = compile({{name, source}}, interface_registers()).lines();
  for (const auto& line : lines)
    if (line.find(": error: ") != std::string::npos) return line;
  return "";
}

struct ListLogic {
  const char* name;
  bool (*truth)(bool, bool);
};

class ListOperator : public testing::TestWithParam<ListLogic> {};

TEST_P(ListOperator, HasItsTruthTablePlainAndWithAParenthesis) {
  const auto [name, truth] = GetParam();
  ListRun plain(std::string("LD R0.0\n") + name + " R0.1\nST R0.2\n");
  ListRun deferred(std::string("LD R0.0\n") + name + "( R0.1\nAND R0.3\n)\nST R0.2\n");
  for (int bits = 0; bits < 8; ++bits) {
    const bool a = (bits & 1) != 0, b = (bits & 2) != 0, c = (bits & 4) != 0;
    for (auto* list : {&plain, &deferred})
      list->put("%R0.0", a), list->put("%R0.1", b), list->put("%R0.3", c);
    EXPECT_EQ(plain.at(0).bit("%R0.2"), truth(a, b)) << name << " " << a << " " << b;
    EXPECT_EQ(deferred.at(0).bit("%R0.2"), truth(a, b && c)) << name << "( " << a << " " << b << " " << c;
  }
}

INSTANTIATE_TEST_SUITE_P(All, ListOperator,
                         testing::Values(ListLogic{"AND", [](bool a, bool b) { return a && b; }},
                                         ListLogic{"ANDN", [](bool a, bool b) { return a && !b; }},
                                         ListLogic{"OR", [](bool a, bool b) { return a || b; }},
                                         ListLogic{"ORN", [](bool a, bool b) { return a || !b; }},
                                         ListLogic{"XOR", [](bool a, bool b) { return a != b; }},
                                         ListLogic{"XORN", [](bool a, bool b) { return a == b; }}),
                         [](const auto& entry) { return std::string(entry.param.name); });

TEST(InstructionList, StoresSetsAndResets) {
  ListRun list("LD X0.0\nST Y0.0\nSTN Y0.1\nS Y0.2\nR Y0.3\nLDN X0.0\nST Y0.4\nNOT\nST Y0.5\n");
  for (const bool in : {false, true}) {
    list.put("%X0.0", in), list.put("%Y0.2", false), list.put("%Y0.3", true);
    list.at(0);
    EXPECT_EQ(list.bit("%Y0.0"), in);
    EXPECT_EQ(list.bit("%Y0.1"), !in);
    EXPECT_EQ(list.bit("%Y0.2"), in);   // set by a true result only
    EXPECT_EQ(list.bit("%Y0.3"), !in);  // reset by a true result only
    EXPECT_EQ(list.bit("%Y0.4"), !in);
    EXPECT_EQ(list.bit("%Y0.5"), in);
  }
}

// B1 is 32 bits with sign, G300 16 bits without one.
TEST(InstructionList, EveryComparisonOrdersWordsOfAnyWidth) {
  const std::vector<std::pair<const char*, bool (*)(int, int)>> comparisons = {
      {"GT", [](int a, int b) { return a > b; }},  {"GE", [](int a, int b) { return a >= b; }},
      {"EQ", [](int a, int b) { return a == b; }}, {"NE", [](int a, int b) { return a != b; }},
      {"LE", [](int a, int b) { return a <= b; }}, {"LT", [](int a, int b) { return a < b; }}};
  for (const auto& [name, truth] : comparisons) {
    ListRun list(std::string("LD G300\n") + name + " B1\nST R0.0\nLD G300\n" + name + " -5\nST R0.1\n");
    for (const int a : {0, 7, 65535})
      for (const int b : {-5, 0, 7}) {
        list.put("%G300", a), list.put("%B1", b);
        EXPECT_EQ(list.at(0).bit("%R0.0"), truth(a, b)) << a << name << b;
        EXPECT_EQ(list.bit("%R0.1"), truth(a, -5)) << a << name;
      }
  }
}

TEST(InstructionList, ArithmeticSaturatesAndDivisionByZeroIsZero) {
  ListRun list(
      "LD B0\nMUL B1\nADD 10\nST B2\nST G300\nLD B0\nDIV B3\nST B4\nLD 10\nSUB( 4\nADD 3\n)\nST B5\n");
  list.put("%B0", 2000000000), list.put("%B1", 2);
  list.at(0);
  EXPECT_EQ(list.word("%B2"), 2147483647);
  EXPECT_EQ(list.word("%G300"), 65535);
  EXPECT_EQ(list.word("%B4"), 0);
  EXPECT_EQ(list.word("%B5"), 3);  // 10 - (4 + 3)
  list.put("%B1", -2), list.put("%B3", 7);
  list.at(0);
  EXPECT_EQ(list.word("%B2"), -2147483638);  // the product saturates at -2147483648, then 10 more
  EXPECT_EQ(list.word("%G300"), 0);
  EXPECT_EQ(list.word("%B4"), 285714285);  // 2000000000 / 7
}

TEST(InstructionList, BitsOfRegisterBReachUpTo31) {
  ListRun list("LD B0.31\nST R0.0\nLD X0.0\nST B1.31\n");
  list.put("%B0", -1), list.put("%X0.0", true);
  list.at(0);
  EXPECT_TRUE(list.bit("%R0.0"));
  EXPECT_EQ(list.word("%B1"), -2147483647 - 1);
}

TEST(InstructionList, MoveHappensOnlyWhileTheResultIsTrueAndSaturates) {
  ListRun list("LD X0.0\nMOVE 7, G300\nMOVE B0, R9\nST Y0.0\n");
  list.put("%B0", 300);
  EXPECT_EQ(list.at(0).word("%G300"), 0);
  list.put("%X0.0", true);
  EXPECT_EQ(list.at(0).word("%G300"), 7);
  EXPECT_EQ(list.word("%R9"), 255);
  EXPECT_TRUE(list.bit("%Y0.0"));
}

TEST(InstructionList, AnOnDelayComesAfterItsTimeAndFallsAtOnce) {
  ListRun list("LD X0.0\nTON 3, 50\nST Y0.0\n");
  list.put("%X0.0", true);
  EXPECT_FALSE(list.at(0).bit("%Y0.0"));
  EXPECT_EQ(list.timer_end(), 50);
  EXPECT_FALSE(list.at(49).bit("%Y0.0"));
  EXPECT_EQ(list.get("main.ton_3.ET"), "T#49ms") << "a variable like any other";
  EXPECT_TRUE(list.machine().timer_due(50 * 1000000));
  EXPECT_TRUE(list.at(50).bit("%Y0.0"));
  EXPECT_EQ(list.timer_end(), -1);
  list.put("%X0.0", false);
  EXPECT_FALSE(list.at(51).bit("%Y0.0"));
  list.put("%X0.0", true);  // starts afresh
  EXPECT_FALSE(list.at(52).bit("%Y0.0"));
  EXPECT_TRUE(list.at(102).bit("%Y0.0"));
}

TEST(InstructionList, AnOffDelayHoldsForItsTime) {
  ListRun list("LD X0.0\nTOF 0, %W5\nST Y0.0\n");
  list.put("%W5", 20);
  EXPECT_FALSE(list.at(0).bit("%Y0.0"));
  list.put("%X0.0", true);
  EXPECT_TRUE(list.at(10).bit("%Y0.0"));
  list.put("%X0.0", false);
  EXPECT_TRUE(list.at(11).bit("%Y0.0"));
  EXPECT_TRUE(list.at(30).bit("%Y0.0"));
  EXPECT_FALSE(list.at(31).bit("%Y0.0"));
}

TEST(InstructionList, TimersStayRightWhenScansAreSkipped) {
  ListRun list("LD X0.0\nTON 0, 1000\nST Y0.0\n");
  list.put("%X0.0", true);
  list.at(5);
  EXPECT_FALSE(list.at(1004).bit("%Y0.0"));
  EXPECT_TRUE(list.at(99999).bit("%Y0.0"));
}

TEST(InstructionList, EdgesLastOneScanAndCountersCountThem) {
  ListRun list(
      "LD X0.0\nR_TRIG 0\nST Y0.0\nLD X0.0\nF_TRIG 1\nST Y0.1\nLD X0.0\nCTU 0, 2\nST Y0.2\nLD X0.1\nCTR 0\n");
  std::string seen;
  for (const char in : std::string("0110010")) {
    list.put("%X0.0", in == '1');
    list.at(0);
    seen += static_cast<char>('0' + (list.word("%Y0") & 7));
  }
  // Rising at the second and sixth scan, falling at the fourth and seventh; two rises make the counter true.
  EXPECT_EQ(seen, "0102056");
  list.put("%X0.1", true);
  list.at(0);
  EXPECT_FALSE(list.at(0).bit("%Y0.2"));
  list.put("%X0.1", false);
  for (const bool in : {true, false, true}) list.put("%X0.0", in), list.at(0);
  EXPECT_TRUE(list.bit("%Y0.2")) << "it counts again from zero";
}

TEST(InstructionList, JumpsSkipWhatIsBetween) {
  ListRun list("LD X0.0\nJMPC over\nLD 1\nST B0\nJMP end\nover:\nLD 2\nST B0\nend: LD 3\nST B1\n");
  EXPECT_EQ(list.at(0).word("%B0"), 1);
  list.put("%X0.0", true);
  EXPECT_EQ(list.at(0).word("%B0"), 2);
  EXPECT_EQ(list.word("%B1"), 3);
}

TEST(InstructionList, AnEndlessLoopIsStopped) {
  ListRun list("back:\nLD X0.0\nJMPC back\n");
  list.put("%X0.0", true);
  EXPECT_EQ(list.scan().kind, FaultKind::budget);
}

TEST(InstructionList, NamesStandForAddresses) {
  ListRun list(
      "VAR\n  lamp AT %Y3.1 : BOOL;\n  speed AT G300 : INT\nEND_VAR\nLD reset_button // the panel's\n"
      "ST lamp (* two\nlines *)\nMOVE 65535, speed\n");
  list.put("%X0.1", true);
  EXPECT_TRUE(list.at(0).bit("%Y3.1"));
  EXPECT_EQ(list.word("main.speed"), 65535) << "a register of 16 bits, without sign";
}

TEST(InstructionList, VariablesAndBlocksOfStructuredTextAreThereToo) {
  ListRun list(
      "VAR\nn : DINT;\npulse : TP;\nEND_VAR\nCAL pulse(IN := X0.0, PT := T#1s)\nLD pulse.Q\nST Y0.0\n"
      "LD n\nADD 1\nST n\n");
  list.put("%X0.0", true);
  EXPECT_TRUE(list.at(0).bit("%Y0.0"));
  EXPECT_EQ(list.word("main.n"), 1);
}

// What the list computes on its way costs no statements and is nowhere shown.
TEST(InstructionList, OnlyWhatItWritesIsCountedAndShown) {
  ListRun plain("LD X0.0\nST Y0.0\n"), more("LD X0.0\nAND X0.1\nORN( X0.2\nXOR X0.3\n)\nNOT\nST Y0.0\n");
  plain.at(0), more.at(0);
  EXPECT_EQ(more.machine().statements(), plain.machine().statements());
  EXPECT_THAT(more.compilation.lines(), testing::IsEmpty());
  for (const auto& symbol : more.compilation.symbols)
    EXPECT_EQ(symbol.path.find('@'), std::string::npos) << symbol.path;
  for (const auto& reference : more.compilation.references)
    EXPECT_EQ(reference.name.find('@'), std::string::npos) << reference.name;
}

TEST(InstructionList, ErrorsSayFileLineColumnAndWhat) {
  using testing::StartsWith;
  EXPECT_THAT(list_error("LD X0.8\n"), StartsWith("t.il:1:4: error: "));
  EXPECT_THAT(list_error("LD M7\n"), StartsWith("t.il:1:4: error: there is no variable 'M7'"));
  EXPECT_THAT(list_error("\n  LDD X0.0\n"), StartsWith("t.il:2:3: error: unknown instruction 'LDD'"));
  EXPECT_THAT(list_error("ST Y0.0\n"), StartsWith("t.il:1:1: error: there is no current result"));
  EXPECT_THAT(list_error("LD X0.0\nADD 3\n"), StartsWith("t.il:2:1: error: the current result is a bit"));
  EXPECT_THAT(list_error("LD 3\nAND X0.0\n"), StartsWith("t.il:2:1: error: the current result is a word"));
  EXPECT_THAT(list_error("LD X0.0\nAND F1\n"), StartsWith("t.il:2:1: error: "));
  EXPECT_THAT(list_error("LD X0.0\nTON 1\n"), StartsWith("t.il:2:1: error: TON takes a number and a value"));
  EXPECT_THAT(list_error("LD X0.0\nTON 1, 5\nLD X0.0\nTON 1, 5\n"),
              StartsWith("t.il:4:5: error: TON 1 is there already in line 2"));
  EXPECT_THAT(list_error("LD X0.0\nCTR 4\n"),
              StartsWith("t.il:2:1: error: the list has no CTU with this number"));
  EXPECT_THAT(list_error("LD X0.0\nMOVE X0.1, %W5\n"),
              StartsWith("t.il:2:6: error: the operand must be a word"));
  EXPECT_THAT(list_error("JMP away\n"), StartsWith("t.il:1:1: error: there is no label 'away'"));
  EXPECT_THAT(list_error("LD X0.0\nAND( X0.1\n"),
              StartsWith("t.il:2:1: error: the parenthesis is not closed"));
  EXPECT_THAT(list_error("LD X0.0\n)\n"), StartsWith("t.il:2:1: error: there is no open parenthesis"));
  EXPECT_THAT(list_error("LD X0.0 X0.1\n"), StartsWith("t.il:1:9: error: "));
  EXPECT_THAT(list_error("LD 5\nST 6\n"), StartsWith("t.il:2:4: error: "));
  EXPECT_THAT(list_error("(* never\nends"), StartsWith("t.il:1:1: error: the comment is not closed"));
  EXPECT_THAT(list_error("(* a (* b\n*) *) LD X0.0 X0.1\n"), StartsWith("t.il:2:15: error: "));
  EXPECT_THAT(list_error("VAR//"), StartsWith("t.il:1:1: error: VAR without END_VAR"));
  EXPECT_THAT(list_error("LD"), StartsWith("t.il:1:1: error: the operand is missing"));
  EXPECT_THAT(list_error("VAR\n  a AT X0.0 : INT;\nEND_VAR\nLD X0.0\n"),
              StartsWith("t.il:2:8: error: a bit is BOOL"));
  EXPECT_THAT(list_error("VAR\n  B1 AT X0.0 : BOOL;\nEND_VAR\n"),
              StartsWith("t.il:2:3: error: 'B1' is a register"));
  EXPECT_THAT(list_error("LD X0.0\n", "two words.il"),
              StartsWith("two words.il:1:1: error: 'two words' is no name of a program"));
}

TEST(InstructionList, TheSameProgramTwiceIsRefused) {
  const auto lines = compile({{"main.il", "LD X0.0\nST Y0.0\n"}, {"main.st", "PROGRAM main\nEND_PROGRAM\n"}},
                             interface_registers())
                         .lines();
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_THAT(lines[0], testing::StartsWith("main.st:1:9: error: 'main' is declared already"));
}

}  // namespace
}  // namespace trunnion::st
