// SPDX-License-Identifier: Apache-2.0
// The instruction list: truth tables, blocks by time, errors with their places.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "execution.hpp"
#include "plc/instruction_list/compiler.hpp"

namespace trunnion::plc {
namespace {

/// A task with an image of its own, run at chosen times.
class Task {
 public:
  explicit Task(const std::string& source) {
    il::Compiler compiler(il::interface_symbols());
    program_ = compiler.compile(source, "t.il");
  }
  Task& at(std::uint64_t now) {
    execute(program_, registers, blocks_, now);
    return *this;
  }
  std::int32_t get(const char* address) const { return load(registers, *il::parse_address(address)); }
  void put(const char* address, std::int64_t value) { store(registers, *il::parse_address(address), value); }
  const Blocks& blocks() const { return blocks_; }

  Registers registers;

 private:
  il::Program program_;
  Blocks blocks_;
};

std::string error_of(const std::string& source) {
  try {
    il::Compiler compiler(il::interface_symbols());
    compiler.compile(source, "t.il");
  } catch (const il::CompileError& e) {
    return e.what();
  }
  return "";
}

struct Logic {
  const char* name;
  bool (*truth)(bool, bool);
};

class LogicOperator : public testing::TestWithParam<Logic> {};

TEST_P(LogicOperator, HasItsTruthTablePlainAndWithAParenthesis) {
  const auto [name, truth] = GetParam();
  Task plain(std::string("LD R0.0\n") + name + " R0.1\nST R0.2\n");
  Task deferred(std::string("LD R0.0\n") + name + "( R0.1\nAND R0.3\n)\nST R0.2\n");
  for (int bits = 0; bits < 8; ++bits) {
    const bool a = bits & 1, b = bits & 2, c = bits & 4;
    for (auto* task : {&plain, &deferred}) task->put("R0.0", a), task->put("R0.1", b), task->put("R0.3", c);
    EXPECT_EQ(plain.at(0).get("R0.2") != 0, truth(a, b)) << name << " " << a << " " << b;
    EXPECT_EQ(deferred.at(0).get("R0.2") != 0, truth(a, b && c)) << name << "( " << a << " " << b << " " << c;
  }
}

INSTANTIATE_TEST_SUITE_P(All, LogicOperator,
                         testing::Values(Logic{"AND", [](bool a, bool b) { return a && b; }},
                                         Logic{"ANDN", [](bool a, bool b) { return a && !b; }},
                                         Logic{"OR", [](bool a, bool b) { return a || b; }},
                                         Logic{"ORN", [](bool a, bool b) { return a || !b; }},
                                         Logic{"XOR", [](bool a, bool b) { return a != b; }},
                                         Logic{"XORN", [](bool a, bool b) { return a == b; }}),
                         [](const auto& entry) { return std::string(entry.param.name); });

TEST(InstructionList, StoresSetsAndResets) {
  Task task("LD X0.0\nST Y0.0\nSTN Y0.1\nS Y0.2\nR Y0.3\nLDN X0.0\nST Y0.4\nNOT\nST Y0.5\n");
  for (const bool in : {false, true}) {
    task.put("X0.0", in);
    task.put("Y0.2", 0), task.put("Y0.3", 1);
    task.at(0);
    EXPECT_EQ(task.get("Y0.0"), in);
    EXPECT_EQ(task.get("Y0.1"), !in);
    EXPECT_EQ(task.get("Y0.2"), in);   // set by a true result only
    EXPECT_EQ(task.get("Y0.3"), !in);  // reset by a true result only
    EXPECT_EQ(task.get("Y0.4"), !in);
    EXPECT_EQ(task.get("Y0.5"), in);
  }
}

TEST(InstructionList, EveryComparisonOrdersWords) {
  const std::vector<std::pair<const char*, bool (*)(int, int)>> comparisons = {
      {"GT", [](int a, int b) { return a > b; }},  {"GE", [](int a, int b) { return a >= b; }},
      {"EQ", [](int a, int b) { return a == b; }}, {"NE", [](int a, int b) { return a != b; }},
      {"LE", [](int a, int b) { return a <= b; }}, {"LT", [](int a, int b) { return a < b; }}};
  for (const auto& [name, truth] : comparisons) {
    Task task(std::string("LD B0\n") + name + " B1\nST R0.0\n");
    for (const int a : {-5, 0, 7})
      for (const int b : {-5, 0, 7}) {
        task.put("B0", a), task.put("B1", b);
        EXPECT_EQ(task.at(0).get("R0.0") != 0, truth(a, b)) << a << name << b;
      }
  }
}

TEST(InstructionList, ArithmeticSaturatesAndDivisionByZeroIsZero) {
  Task task("LD B0\nMUL B1\nADD 10\nST B2\nST G300\nLD B0\nDIV B3\nST B4\nLD 10\nSUB( 4\nADD 3\n)\nST B5\n");
  task.put("B0", 2000000000), task.put("B1", 2);
  task.at(0);
  EXPECT_EQ(task.get("B2"), 2147483647);
  EXPECT_EQ(task.get("G300"), 65535);
  EXPECT_EQ(task.get("B4"), 0);
  EXPECT_EQ(task.get("B5"), 3);  // 10 - (4 + 3)
  task.put("B1", -2);
  EXPECT_EQ(task.at(0).get("B2"), -2147483638);  // the product saturates at -2147483648, then 10 more
  EXPECT_EQ(task.get("G300"), 0);
}

TEST(InstructionList, BitsOfRegisterBReachUpTo31) {
  Task task("LD B0.31\nST R0.0\nLD X0.0\nST B1.31\n");
  task.put("B0", -1), task.put("X0.0", 1);
  task.at(0);
  EXPECT_EQ(task.get("R0.0"), 1);
  EXPECT_EQ(task.get("B1"), -2147483647 - 1);
}

TEST(InstructionList, MoveHappensOnlyWhileTheResultIsTrue) {
  Task task("LD X0.0\nMOVE 7, G300\nST Y0.0\n");
  EXPECT_EQ(task.at(0).get("G300"), 0);
  task.put("X0.0", 1);
  EXPECT_EQ(task.at(0).get("G300"), 7);
  EXPECT_EQ(task.get("Y0.0"), 1);
}

TEST(InstructionList, AnOnDelayComesAfterItsTimeAndFallsAtOnce) {
  Task task("LD X0.0\nTON 3, 50\nST Y0.0\n");
  task.put("X0.0", 1);
  EXPECT_EQ(task.at(100).get("Y0.0"), 0);
  EXPECT_EQ(next_timer_end(task.blocks(), 100), 150u);
  EXPECT_EQ(task.at(149).get("Y0.0"), 0);
  EXPECT_TRUE(timer_due(task.blocks(), 150));
  EXPECT_EQ(task.at(150).get("Y0.0"), 1);
  EXPECT_FALSE(next_timer_end(task.blocks(), 150).has_value());
  task.put("X0.0", 0);
  EXPECT_EQ(task.at(151).get("Y0.0"), 0);
  task.put("X0.0", 1);  // starts afresh
  EXPECT_EQ(task.at(152).get("Y0.0"), 0);
  EXPECT_EQ(task.at(202).get("Y0.0"), 1);
}

TEST(InstructionList, AnOffDelayHoldsForItsTime) {
  Task task("LD X0.0\nTOF 0, 20\nST Y0.0\n");
  EXPECT_EQ(task.at(0).get("Y0.0"), 0);
  task.put("X0.0", 1);
  EXPECT_EQ(task.at(10).get("Y0.0"), 1);
  task.put("X0.0", 0);
  EXPECT_EQ(task.at(11).get("Y0.0"), 1);
  EXPECT_EQ(task.at(30).get("Y0.0"), 1);
  EXPECT_EQ(task.at(31).get("Y0.0"), 0);
}

TEST(InstructionList, TimersStayRightWhenScansAreSkipped) {
  Task task("LD X0.0\nTON 0, 1000\nST Y0.0\n");
  task.put("X0.0", 1);
  task.at(5);
  EXPECT_EQ(task.at(1004).get("Y0.0"), 0);
  EXPECT_EQ(task.at(99999).get("Y0.0"), 1);
}

TEST(InstructionList, EdgesLastOneScanAndCountersCountThem) {
  Task task(
      "LD X0.0\nR_TRIG 0\nST Y0.0\nLD X0.0\nF_TRIG 1\nST Y0.1\nLD X0.0\nCTU 0, 2\nST Y0.2\nLD X0.1\nCTR 0\n");
  std::string seen;
  for (const char in : std::string("0110010")) {
    task.put("X0.0", in == '1');
    task.at(0);
    seen += static_cast<char>('0' + task.get("Y0.0") + 2 * task.get("Y0.1") + 4 * task.get("Y0.2"));
  }
  // Rising at the second and sixth scan, falling at the fourth and seventh; two rises make the counter true.
  EXPECT_EQ(seen, "0102056");
  task.put("X0.1", 1);
  task.at(0);
  EXPECT_EQ(task.at(0).get("Y0.2"), 0);
}

TEST(InstructionList, JumpsSkipWhatIsBetween) {
  Task task("LD X0.0\nJMPC over\nLD 1\nST B0\nJMP end\nover:\nLD 2\nST B0\nend: LD 3\nST B1\n");
  EXPECT_EQ(task.at(0).get("B0"), 1);
  task.put("X0.0", 1);
  EXPECT_EQ(task.at(0).get("B0"), 2);
  EXPECT_EQ(task.get("B1"), 3);
}

TEST(InstructionList, NamesStandForAddresses) {
  Task task(
      "VAR\n  lamp AT %Y3.1 : BOOL;\nEND_VAR\nLD reset_button // the panel's\nST lamp (* two\nlines *)\n");
  task.put("X0.1", 1);
  EXPECT_EQ(task.at(0).get("Y3.1"), 1);
}

TEST(Compiler, ErrorsSayFileLineColumnAndWhat) {
  using testing::StartsWith;
  EXPECT_THAT(error_of("LD X0.8\n"), StartsWith("t.il:1:4: error: 'X0.8' is neither"));
  EXPECT_THAT(error_of("\n  LDD X0.0\n"), StartsWith("t.il:2:3: error: unknown instruction"));
  EXPECT_THAT(error_of("ST Y0.0\n"), StartsWith("t.il:1:1: error: no current result"));
  EXPECT_THAT(error_of("LD X0.0\nADD 3\n"), StartsWith("t.il:2:1: error: the current result is a bit"));
  EXPECT_THAT(error_of("LD 3\nAND X0.0\n"), StartsWith("t.il:2:1: error: the current result is a word"));
  EXPECT_THAT(error_of("LD X0.0\nAND F1\n"), StartsWith("t.il:2:5: error: the operand must be a bit"));
  EXPECT_THAT(error_of("LD X0.0\nTON 256, 5\n"),
              StartsWith("t.il:2:5: error: the number is outside 0 .. 255"));
  EXPECT_THAT(error_of("LD X0.0\nTON 1, 5\nLD X0.0\nTOF 1, 5\n"),
              StartsWith("t.il:4:5: error: number 1 is used already in t.il:2"));
  EXPECT_THAT(error_of("back:\nLD X0.0\nJMPC back\n"),
              StartsWith("t.il:3:6: error: a jump must lead forward"));
  EXPECT_THAT(error_of("JMP away\n"), StartsWith("t.il:1:5: error: unknown label"));
  EXPECT_THAT(error_of("LD X0.0\nAND( X0.1\n"), StartsWith("t.il:2:1: error: the parenthesis is not closed"));
  EXPECT_THAT(error_of("LD X0.0\n)\n"), StartsWith("t.il:2:1: error: ')' without '('"));
  EXPECT_THAT(error_of("LD X0.0 X0.1\n"), StartsWith("t.il:1:9: error: unexpected 'X0.1'"));
  EXPECT_THAT(error_of("LD 5\nST 6\n"), StartsWith("t.il:2:4: error: a constant cannot be written"));
  EXPECT_THAT(error_of("(* never\nends"), StartsWith("t.il:1:1: error: the comment is not closed"));
  EXPECT_THAT(error_of("LD X0.0\n(* a (* b\n*) ends"),
              StartsWith("t.il:2:1: error: the comment is not closed"));
  EXPECT_THAT(error_of("(* a (* b\n*) *) LD X0.0 X0.1\n"), StartsWith("t.il:2:15: error: unexpected 'X0.1'"));
  EXPECT_THAT(error_of("VAR//"), StartsWith("t.il:1:1: error: VAR without END_VAR"));
  EXPECT_THAT(error_of("VAR\na AT"), StartsWith("t.il:2:5: error:"));
  EXPECT_THAT(error_of("LD"), StartsWith("t.il:1:3: error: expected an operand"));
  EXPECT_THAT(error_of("LD X0.0\nTON"), StartsWith("t.il:2:4: error: expected a number"));
  EXPECT_THAT(error_of("LD 99999999999\n"), StartsWith("t.il:1:4: error: the number is outside"));
  EXPECT_THAT(error_of("VAR\n  a AT X0.0 : INT;\nEND_VAR\n"), StartsWith("t.il:2:15: error: a bit is BOOL"));
}

}  // namespace
}  // namespace trunnion::plc
