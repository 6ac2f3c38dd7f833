// SPDX-License-Identifier: Apache-2.0
// The largest number of statements of a program, against programs that run.
#include <gmock/gmock.h>

#include <random>

#include "translated.hpp"

namespace trunnion::st {
namespace {

std::int64_t most(const Compilation& compilation) { return compilation.tasks.at(0).most.value_or(-1); }

TEST(StatementCount, IsReachedByTheLongestWay) {
  struct Row {
    const char *statements, *why;
    std::int64_t most;
  };
  for (const auto& row : {
           Row{"", "nothing", 0},
           Row{"n := 1; n := 2;", "one for each statement", 2},
           Row{"IF yes THEN n := 1; n := 2; ELSE n := 3; END_IF;", "IF and its longer branch", 3},
           Row{"IF NOT yes THEN n := 1; ELSIF yes THEN n := 1; n := 2; n := 3; END_IF;", "IF and three", 4},
           Row{"CASE k OF 1: n := 1; 2: n := 1; n := 2; ELSE n := 0; END_CASE;", "CASE and two", 3},
           Row{"FOR i := 1 TO 10 DO n := i; END_FOR;", "FOR, ten times one and the way back", 1 + 10 * 2},
           Row{"FOR i := 10 TO 1 BY -4 DO n := i; END_FOR;", "10, 6, 2", 1 + 3 * 2},
           Row{"FOR i := 3 TO 2 DO n := i; END_FOR;", "never", 1},
           Row{"FOR i := 1 TO 3 DO FOR j := 1 TO 4 DO n := j; END_FOR; n := i; END_FOR;",
               "FOR, three times: FOR with four times two, one, the way back", 1 + 3 * (1 + 4 * 2 + 1 + 1)},
           Row{"FOR i := 1 TO 5 DO IF i = 5 THEN n := 1; n := 2; n := 3; EXIT; END_IF; END_FOR;",
               "FOR, four times IF and the way back, IF with three and EXIT", 1 + 4 * 2 + 5},
           Row{"FOR i := 1 TO 5 DO IF i = 5 THEN n := 1; n := 2; n := 3; RETURN; END_IF; END_FOR; n := 9;",
               "the way out by RETURN is the longest", 1 + 4 * 2 + 5},
           Row{"b(x := 1);", "the call, its entry, two statements of the block", 1 + 1 + 2},
           Row{"n := f(2) + f(3);", "the assignment, twice the entry and one statement", 1 + 2 * 2},
           Row{"a := c;", "the assignment, 40 cells in 40 / 16 steps", 1 + 2},
           Row{"p := ADR(n); p^ := 1;", "two, and one more for the writing through a pointer", 2 + 1},
       }) {
    Translated program(
        "VAR n : INT; i, j : INT; k : INT := 2; yes : BOOL := TRUE; b : Twice; a, c : ARRAY[1..40] OF INT; "
        "p : POINTER TO INT; END_VAR",
        row.statements,
        "FUNCTION_BLOCK Twice\nVAR_INPUT x : INT; END_VAR\nVAR y : INT; END_VAR\ny := x; y := y + x;\n"
        "END_FUNCTION_BLOCK\nFUNCTION f : INT\nVAR_INPUT x : INT; END_VAR\nf := x;\nEND_FUNCTION\n");
    EXPECT_EQ(program.scan(), "") << row.statements;
    EXPECT_EQ(program.run.machine().statements(), row.most) << row.statements << ": " << row.why;
    EXPECT_EQ(most(program.compilation), row.most) << row.statements << ": " << row.why;
  }
}

TEST(StatementCount, NamesTheLoopWithoutLimit) {
  for (const auto& [statements, place] : {std::pair{"n := 1;\nWHILE n < 9 DO n := n + 1; END_WHILE;", "6:1"},
                                          {"REPEAT n := n + 1; UNTIL n > 9 END_REPEAT;", "5:1"},
                                          {"FOR i := 1 TO n DO\nb(x := i);\nEND_FOR;", "5:1"},
                                          {"b(x := 1);\nc();", "2:1"}}) {
    Translated program(
        "VAR n, i : INT; b : Plain; c : Search; END_VAR", statements,
        "FUNCTION_BLOCK Plain VAR_INPUT x : INT; END_VAR END_FUNCTION_BLOCK FUNCTION_BLOCK Search "
        "VAR n : INT; END_VAR\nWHILE n < 9 DO n := n + 1; END_WHILE; END_FUNCTION_BLOCK\n");
    const auto& task = program.compilation.tasks.at(0);
    EXPECT_FALSE(task.most.has_value());
    EXPECT_EQ(std::to_string(task.unbounded.line) + ":" + std::to_string(task.unbounded.column), place)
        << statements;
  }
}

TEST(StatementCount, WarnsOfWhatThePlcStops) {
  const auto lines =
      compile(
          {{"t.st",
            "PROGRAM main\nVAR i, j, n : DINT; END_VAR\nFOR i := 1 TO 1000 DO\nFOR j := 1 TO 100 DO n := j; "
            "END_FOR;\nEND_FOR;\nEND_PROGRAM\n"}},
          interface_registers())
          .lines();
  // 1 + 1000 * (1 + 100 * 2 + 1)
  EXPECT_THAT(lines,
              testing::ElementsAre("t.st:3:1: warning: the program main can execute 202001 statements in one "
                                   "run; the PLC stops it after 100000"));
}

// Statements with every way into and out of loops whose limits are constant.
class RandomProgram {
 public:
  explicit RandomProgram(unsigned seed) : random_(seed) {}

  std::string statements(int depth, bool in_loop) {
    std::string text;
    for (int count = number(1, 4); count > 0; --count) text += statement(depth, in_loop);
    return text;
  }

 private:
  int number(int low, int high) {
    return static_cast<int>(random_() % static_cast<unsigned>(high - low + 1)) + low;
  }
  std::string variable() { return "v[" + std::to_string(number(0, 7)) + "]"; }
  std::string condition() {
    return variable() + (number(0, 1) != 0 ? " > " : " = ") + std::to_string(number(-2, 6));
  }
  std::string statement(int depth, bool in_loop) {
    const auto body = [&](bool loop) { return statements(depth - 1, loop); };
    switch (depth > 0 ? number(0, 8) : number(0, 3)) {
      case 0:
        return variable() + " := " + variable() + " + " + std::to_string(number(-3, 3)) + ";\n";
      case 1:
        return "n := Sum(n);\n";
      case 2:
        return "block(x := " + variable() + ");\n";
      case 3:
        if (!in_loop)
          return number(0, 3) == 0 ? "IF " + condition() + " THEN RETURN; END_IF;\n" : "n := n + 1;\n";
        return "IF " + condition() + " THEN " + (number(0, 1) != 0 ? "EXIT" : "CONTINUE") + "; END_IF;\n";
      case 4:
        return "IF " + condition() + " THEN\n" + body(in_loop) + "ELSIF " + condition() + " THEN\n" +
               body(in_loop) + "END_IF;\n";
      case 5:
        return "IF " + condition() + " THEN\n" + body(in_loop) + "ELSE\n" + body(in_loop) + "END_IF;\n";
      case 6:
        return "CASE " + variable() + " OF 0, 3: " + body(in_loop) + " 1..2: " + body(in_loop) + " ELSE " +
               body(in_loop) + "END_CASE;\n";
      default: {
        const auto i = "i" + std::to_string(depth);
        const bool down = number(0, 3) == 0;
        const int from = number(0, 3), to = from + (down ? -1 : 1) * number(-1, 5);
        return "FOR " + i + " := " + std::to_string(from) + " TO " + std::to_string(to) +
               (down ? " BY -" : " BY ") + std::to_string(number(1, 2)) + " DO\n" + body(true) + "END_FOR;\n";
      }
    }
  }

  std::mt19937 random_;
};

TEST(StatementCount, IsNeverExceededByRandomPrograms) {
  std::size_t reached = 0;
  constexpr unsigned programs = 300;
  for (unsigned seed = 1; seed <= programs; ++seed) {
    RandomProgram source(seed);
    const auto inner = source.statements(2, false), outer = source.statements(3, false);
    Translated program(
        "VAR v : ARRAY[0..7] OF DINT; n, i1, i2, i3 : DINT; block : Part; END_VAR", outer,
        "FUNCTION Sum : DINT\nVAR_INPUT x : DINT; END_VAR\nSum := x + 1;\nEND_FUNCTION\n"
        "FUNCTION_BLOCK Inner\nVAR_INPUT x : DINT; END_VAR\nVAR y : DINT; END_VAR\ny := x;\n"
        "END_FUNCTION_BLOCK\n"
        "FUNCTION_BLOCK Part\nVAR_INPUT x : DINT; END_VAR\nVAR v : ARRAY[0..7] OF DINT; n, i1, i2 : DINT; "
        "block : Inner; END_VAR\n" +
            inner + "END_FUNCTION_BLOCK\n");
    const auto limit = most(program.compilation);
    ASSERT_GE(limit, 0) << outer;
    std::mt19937 values(seed);
    std::int64_t longest = 0;
    for (int run = 0; run < 40; ++run) {
      for (int i = 0; i < 8; ++i)
        program.set("v[" + std::to_string(i) + "]", std::to_string(static_cast<int>(values() % 9) - 2));
      ASSERT_EQ(program.scan(), "");
      longest = std::max(longest, program.run.machine().statements());
      ASSERT_LE(longest, limit) << outer << inner;
    }
    reached += longest == limit ? 1u : 0u;
  }
  EXPECT_GT(reached, programs / 10);  // it is a limit that can be reached, not only a large number
}

}  // namespace
}  // namespace trunnion::st
