// SPDX-License-Identifier: Apache-2.0
// Properties of macros over random programs: precedence against a tree, loops and calls against what they
// stand for.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "test_machine.hpp"

namespace trunnion::language::test {
namespace {

/// A random expression as text and as what it means.
struct Expression {
  std::string text;
  double value = 0;
  int binding = 0;  ///< of its outermost operator; 9 for an operand
};

class Generator {
 public:
  explicit Generator(std::uint32_t seed) : random_(seed) {}

  Expression any(int depth) {
    if (depth == 0 || pick(5) == 0) return operand(depth);
    struct Form {
      const char* sign;
      int binding;
      double (*apply)(double, double);
    };
    static constexpr Form forms[] = {
        {"*", 5, [](double a, double b) { return a * b; }},
        {"+", 4, [](double a, double b) { return a + b; }},
        {"-", 4, [](double a, double b) { return a - b; }},
        {" EQ ", 3, [](double a, double b) { return a == b ? 1.0 : 0.0; }},
        {"GT", 3, [](double a, double b) { return a > b ? 1.0 : 0.0; }},
        {"<=", 3, [](double a, double b) { return a <= b ? 1.0 : 0.0; }},
        {"!=", 3, [](double a, double b) { return a != b ? 1.0 : 0.0; }},
        {"&&", 2, [](double a, double b) { return a != 0 && b != 0 ? 1.0 : 0.0; }},
        {"||", 1, [](double a, double b) { return a != 0 || b != 0 ? 1.0 : 0.0; }},
    };
    const Form& form = forms[pick(std::size(forms))];
    const Expression left = any(depth - 1);
    const Expression right = any(depth - 1);
    // Brackets where the tree needs them, and sometimes where it does not: operators of one level go from the
    // left.
    const auto written = [&](const Expression& part, bool needed) {
      return needed || pick(6) == 0 ? "[" + part.text + "]" : part.text;
    };
    return {written(left, left.binding < form.binding) + form.sign +
                written(right, right.binding <= form.binding),
            form.apply(left.value, right.value), form.binding};
  }

 private:
  std::size_t pick(std::size_t count) { return random_() % count; }

  Expression operand(int depth) {
    const int number = static_cast<int>(pick(7));
    switch (pick(depth > 0 ? 5 : 3)) {
      case 0:
        return {"#" + std::to_string(number), number / 2.0, 9};  // set so before
      case 1:
        return {"-" + std::to_string(number), -static_cast<double>(number), 9};
      case 2:
        return {std::to_string(number) + ".5", number + 0.5, 9};
      case 3: {
        const Expression inner = any(depth - 1);
        return {"ABS[" + inner.text + "]", std::abs(inner.value), 9};
      }
      default: {
        const Expression inner = any(depth - 1);
        return {"FIX[" + inner.text + "]", std::trunc(inner.value), 9};
      }
    }
  }

  std::mt19937 random_;
};

TEST(MacroProperty, ExpressionsMeanTheirTrees) {
  TestMachine machine;
  Interpreter interpreter(machine);
  for (std::uint32_t seed = 1; seed <= 3000; ++seed) {
    const Expression expression = Generator(seed).any(6);
    const std::string text = "#0=0 #1=0.5 #2=1 #3=1.5 #4=2 #5=2.5 #6=3\n#100=" + expression.text + "\n";
    StringSource source(text);
    interpreter.start(source, {}, {});
    Command command;
    Step step = interpreter.next(command);
    while (step == Step::command) step = interpreter.next(command);
    ASSERT_EQ(step, Step::end) << expression.text << ": " << interpreter.alarm().text.data();
    // The same operations in the same order: bit for bit.
    ASSERT_EQ(interpreter.variables().common[50].number, expression.value) << expression.text;
  }
}

/// The commands without what tells where they stand in the text.
std::vector<std::string> meaning(const std::string& program) {
  TestMachine machine;
  return stream(run(machine, program));
}

TEST(MacroProperty, LoopsMeanTheirUnrolledBlocks) {
  std::mt19937 random(7);
  for (int i = 0; i < 200; ++i) {
    const int turns = static_cast<int>(random() % 6);
    const int inner = static_cast<int>(random() % 4);
    const double step = 0.25 * static_cast<double>(random() % 9);
    const std::string n = std::to_string(turns);
    const std::string m = std::to_string(inner);
    const std::string s = std::to_string(step);
    std::string unrolled = "G91 G1 F100\n";
    for (int a = 0; a < turns; ++a) {
      unrolled += "X" + std::to_string(step * (a + 1)) + "\n";
      for (int b = 0; b < inner; ++b)
        unrolled += (a + b) % 2 == 0 ? "Y1\n" : "Z" + std::to_string(b + 1) + "\n";
    }
    unrolled += "M30\n";
    const std::string body_hnc = "IF [#1-1+#2-1] MOD 2 EQ 0\nY1\nELSE\nZ#2\nENDIF\n";
    const std::string body_fanuc = "IF[[[#1-1+#2-1]MOD 2]EQ 0]GOTO 5\nZ#2\nGOTO 6\nN5 Y1\nN6\n";
    const std::string hnc = "G91 G1 F100\nWHILE #1 LT " + n + "\n#1=#1+1\nX[#1*" + s +
                            "]\n#2=0\nWHILE #2 LT " + m + "\n#2=#2+1\n" + body_hnc + "ENDW\nENDW\nM30\n";
    const std::string fanuc = "G91 G1 F100\nWHILE[#1LT" + n + "]DO1\n#1=#1+1\nX[#1*" + s +
                              "]\n#2=0\nWHILE[#2LT" + m + "]DO2\n#2=#2+1\n" + body_fanuc +
                              "END2\nEND1\nM30\n";
    const std::string jumps = "G91 G1 F100\nN1 IF[#1GE" + n + "]GOTO 9\n#1=#1+1\nX[#1*" + s +
                              "]\n#2=0\nN2 IF[#2GE" + m + "]GOTO 1\n#2=#2+1\n" + body_fanuc +
                              "GOTO 2\nN9 M30\n";
    const auto expected = meaning(unrolled);
    ASSERT_EQ(meaning(hnc), expected) << hnc;
    ASSERT_EQ(meaning(fanuc), expected) << fanuc;
    ASSERT_EQ(meaning(jumps), expected) << jumps;
  }
}

TEST(MacroProperty, CallsMeanTheBlocksTheyCall) {
  std::mt19937 random(11);
  for (int i = 0; i < 200; ++i) {
    const int repetitions = 1 + static_cast<int>(random() % 4);
    const std::string x = std::to_string(static_cast<int>(random() % 200) - 100);
    const std::string y = std::to_string(static_cast<int>(random() % 100) / 8.0);
    std::string written = "G91 G0\n";
    for (int k = 0; k < repetitions; ++k) written += "X" + x + "\nY" + y + "\n";
    written += "M30\n";
    const std::string l = std::to_string(repetitions);
    const auto expected = meaning(written);
    ASSERT_EQ(meaning("G91 G0\n#24=" + x + "\n#25=" + y + "\nM98 P7 L" + l + "\nM30\nO7\nX#24\nY#25\nM99\n"),
              expected);
    ASSERT_EQ(meaning("G91 G0\nG65 P7 X" + x + " Y" + y + " L" + l + "\nM30\nO7\nX#24\nY#25\nM99\n"),
              expected);
    ASSERT_EQ(meaning("G91 G0\nG65 P7 I" + x + " I1 J" + y + " L" + l + "\nM30\nO7\nX#4\nY#8\nM99\n"),
              expected);
  }
}

}  // namespace
}  // namespace trunnion::language::test
