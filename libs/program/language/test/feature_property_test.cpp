// SPDX-License-Identifier: Apache-2.0
// G91 equals G90 and G20 equals scaled G21 with every feature: cycles, compensation, frames, curves.
#include <gtest/gtest.h>

#include <cinttypes>
#include <random>

#include "test_machine.hpp"

namespace trunnion::language::test {
namespace {

/// Writes one program in four ways. Lengths are whole thousandths of 0.127 mm, which is 0.005 inch exactly.
class Writer {
 public:
  Writer(bool inch, bool incremental) : inch_(inch), incremental_(incremental) {}

  void code(const std::string& text) { text_ += text; }
  void end_block() { text_ += "\n"; }
  /// A length that does not depend on G91.
  void length(char letter, std::int64_t units) { number(letter, units); }
  /// A coordinate: absolute, or from the one before.
  void axis(char letter, std::int64_t units) {
    std::int64_t& at = at_[static_cast<std::size_t>(letter - 'X')];
    number(letter, incremental_ ? units - at : units);
    at = units;
  }
  /// A coordinate that counts from `base` in G91 and moves nothing (R and Z of cycles).
  void level(char letter, std::int64_t units, std::int64_t base) {
    number(letter, incremental_ ? units - base : units);
  }
  /// The program has gone to a place by other words.
  void stand(char letter, std::int64_t units) { at_[static_cast<std::size_t>(letter - 'X')] = units; }
  void feed(std::int64_t units) { number('F', units); }
  std::string text() const {
    return std::string(inch_ ? "G20" : "G21") + (incremental_ ? " G91\n" : " G90\n") + text_;
  }

 private:
  // 1 unit = 0.127 mm = 0.005 inch
  void number(char letter, std::int64_t units) {
    const std::int64_t thousandths = units * (inch_ ? 5 : 127);
    char word[40];
    std::snprintf(word, sizeof word, "%c%s%" PRId64 ".%03d", letter, thousandths < 0 ? "-" : "",
                  std::abs(thousandths) / 1000, static_cast<int>(std::abs(thousandths) % 1000));
    text_ += word;
  }
  bool inch_;
  bool incremental_;
  std::string text_;
  std::array<std::int64_t, 3> at_{};
};

std::string program(unsigned seed, bool inch, bool incremental) {
  std::mt19937_64 random(seed);
  const auto below = [&](unsigned limit) { return static_cast<std::int64_t>(random() % limit); };
  const auto coordinate = [&] { return below(4001) - 2000; };
  Writer w(inch, incremental);
  w.code("G1");
  w.feed(1000);
  w.end_block();
  for (int i = 0; i < 12; ++i) {
    switch (random() % 6) {
      case 0:
        w.code("G0");
        w.axis('X', coordinate());
        w.axis('Z', coordinate());
        w.end_block();
        break;
      case 1: {  // an arc that is never more than a half circle
        w.code(random() % 2 == 0 ? "G2" : "G3");
        w.axis('X', coordinate());
        w.axis('Y', coordinate());
        w.length('R', 6000 + below(1000));
        w.end_block();
        break;
      }
      case 2: {  // a cycle from a known level, and one more hole
        w.code("G0");
        w.axis('Z', 500);
        w.end_block();
        static constexpr const char* cycles[] = {"G98 G81", "G99 G73", "G98 G83", "G99 G85"};
        w.code(cycles[random() % 4]);
        const std::int64_t r = 300 - below(100);
        const std::int64_t z = r - 100 - below(300);
        w.axis('X', coordinate());
        w.axis('Y', coordinate());
        w.level('R', r, 500);
        w.level('Z', z, r);
        w.length('Q', 40 + below(40));
        w.end_block();
        w.axis('X', coordinate());
        w.end_block();
        w.code("G80 G98\n");
        // G99 leaves the tool at R: both forms go on from a level they know.
        w.code("G90 G0 ");
        w.code(inch ? "Z2.5" : "Z63.5");
        w.code(incremental ? "\nG91\n" : "\n");
        // The writer's own level is 500 units = 63.5 mm, as before the cycle.
        break;
      }
      case 3: {  // a compensated step with room for the tool
        const std::int64_t x = coordinate();
        const std::int64_t y = coordinate();
        w.code("G0");
        w.axis('X', x);
        w.axis('Y', y);
        w.end_block();
        w.code(random() % 2 == 0 ? "G41 D1 G1" : "G42 D1 G1");
        w.axis('X', x + 300);
        w.end_block();
        w.axis('X', x + 900);
        w.end_block();
        w.axis('Y', y + 700 - 1400 * below(2));
        w.end_block();
        w.code("G40");
        w.axis('X', x + 2000);
        w.end_block();
        break;
      }
      case 4:
        // In a turned frame the position has other coordinates: both forms first go to a place they name.
        for (const std::string& frame :
             {"G68 X0 Y0 R" + std::to_string(below(36) * 10), std::string("G69")}) {
          w.code(frame + "\nG90 G0 X0 Y0");
          w.code(incremental ? "\nG91\n" : "\n");
          w.stand('X', 0);
          w.stand('Y', 0);
          w.code("G1");
          w.axis('X', coordinate());
          w.axis('Y', coordinate());
          w.end_block();
        }
        break;
      default:
        w.code("G1");
        w.axis('X', coordinate());
        w.axis('Y', coordinate());
        w.axis('Z', coordinate());
        w.end_block();
        break;
    }
  }
  return w.text() + "M30\n";
}

void expect_same(const Interpretation& a, const Interpretation& b, const std::string& text) {
  ASSERT_EQ(a.last, Step::end) << a.alarm.text.data() << a.alarm.line << "\n" << text;
  ASSERT_EQ(b.last, Step::end) << b.alarm.text.data() << b.alarm.line << "\n" << text;
  ASSERT_EQ(a.commands.size(), b.commands.size()) << text;
  for (std::size_t i = 0; i < a.commands.size(); ++i) {
    ASSERT_EQ(a.commands[i].kind, b.commands[i].kind) << i << "\n" << text;
    for (std::size_t axis = 0; axis < axis_count; ++axis) {
      // Coordinates up to 500 mm, some hundred sums and one rotation; centres of R up to 20 times that.
      ASSERT_NEAR(a.commands[i].target[axis], b.commands[i].target[axis], 1e-8) << i << "\n" << text;
    }
    for (std::size_t k = 0; k < 3; ++k) {
      ASSERT_NEAR(a.commands[i].arc.centre[k], b.commands[i].arc.centre[k], 1e-7) << i;
    }
    ASSERT_NEAR(a.commands[i].modal.feed, b.commands[i].modal.feed, 1e-9) << i;
  }
}

TEST(FeatureProperty, IncrementalEqualsAbsoluteAndInchesEqualMillimetres) {
  for (unsigned seed = 0; seed < 300; ++seed) {
    TestMachine machine;
    machine.tools[1] = {0, 0, 12.7, 0};
    const std::string text = program(seed, false, false);
    const Interpretation plain = run(machine, text);
    expect_same(plain, run(machine, program(seed, true, false)), text);
    if (HasFatalFailure()) return;
    // A rotation in G91 adds to the angle before; with G69 behind each there is none.
    expect_same(plain, run(machine, program(seed, false, true)), text);
    if (HasFatalFailure()) return;
    expect_same(plain, run(machine, program(seed, true, true)), text);
    if (HasFatalFailure()) return;
  }
}

}  // namespace
}  // namespace trunnion::language::test
