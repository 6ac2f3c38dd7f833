// SPDX-License-Identifier: Apache-2.0
// Rules that hold for any program, on seeded random ones.
#include <gtest/gtest.h>

#include <cinttypes>
#include <random>

#include "language/arc_geometry.hpp"
#include "test_machine.hpp"

namespace trunnion::language::test {
namespace {

constexpr int programs = 200;
constexpr int blocks = 50;

class RandomProgram {
 public:
  explicit RandomProgram(unsigned seed) : random_(seed) {}
  /// A coordinate in whole 1/10000, so that text and arithmetic can be exact.
  std::int64_t coordinate() { return static_cast<std::int64_t>(random_() % 4000001) - 2000000; }
  unsigned below(unsigned limit) { return static_cast<unsigned>(random_() % limit); }
  double real(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }

 private:
  std::mt19937_64 random_;
};

std::string word(char letter, std::int64_t ten_thousandths) {
  char text[40];
  std::snprintf(text, sizeof text, "%c%s%" PRId64 ".%04d", letter, ten_thousandths < 0 ? "-" : "",
                std::abs(ten_thousandths) / 10000, static_cast<int>(std::abs(ten_thousandths) % 10000));
  return text;
}

std::string word(char letter, double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%c%.9f", letter, value);
  return text;
}

void expect_same_moves(const Interpretation& a, const Interpretation& b, double tolerance) {
  ASSERT_EQ(a.last, Step::end) << a.alarm.text.data();
  ASSERT_EQ(b.last, Step::end) << b.alarm.text.data();
  ASSERT_EQ(a.commands.size(), b.commands.size());
  for (std::size_t i = 0; i < a.commands.size(); ++i) {
    ASSERT_EQ(a.commands[i].kind, b.commands[i].kind);
    for (std::size_t axis = 0; axis < axis_count; ++axis) {
      ASSERT_NEAR(a.commands[i].target[axis], b.commands[i].target[axis], tolerance);
    }
    for (std::size_t k = 0; k < 3; ++k) {
      ASSERT_NEAR(a.commands[i].arc.centre[k], b.commands[i].arc.centre[k], tolerance);
    }
    ASSERT_NEAR(a.commands[i].arc.sweep, b.commands[i].arc.sweep, 1e-6);
    ASSERT_NEAR(a.commands[i].modal.feed, b.commands[i].modal.feed, 1e-9 * a.commands[i].modal.feed);
  }
}

TEST(Property, IncrementalEqualsAbsolute) {
  for (int p = 0; p < programs; ++p) {
    RandomProgram random(static_cast<unsigned>(p));
    std::string absolute = "G90 G1 F100\n";
    std::string incremental = "G91 G1 F100\n";
    std::array<std::int64_t, axis_count> at{};
    for (int i = 0; i < blocks; ++i) {
      for (std::size_t axis = 0; axis < axis_count; ++axis) {
        if (random.below(2) == 0) continue;
        const std::int64_t to = random.coordinate();
        absolute += word(axis_letters[axis], to);
        incremental += word(axis_letters[axis], to - at[axis]);
        at[axis] = to;
      }
      absolute += "\n";
      incremental += "\n";
    }
    TestMachine machine;
    // 50 sums of numbers up to 400 add at most 50 * 400 * 2^-53 = 2e-12.
    expect_same_moves(run(machine, absolute), run(machine, incremental), 1e-11);
  }
}

TEST(Property, InchesEqualScaledMillimetres) {
  for (int p = 0; p < programs; ++p) {
    RandomProgram random(1000 + static_cast<unsigned>(p));
    std::string inch = "G20 G1 F10\n";
    std::string metric = "G21 G1 F254\n";
    for (int i = 0; i < blocks; ++i) {
      // 1 inch is 25.4 mm, so 254 times as many ten-thousandths as tenths of them are exact in both.
      const std::int64_t x = random.coordinate();
      const std::int64_t z = random.coordinate();
      const std::int64_t c = random.coordinate();
      const std::int64_t r = 4000001 + random.coordinate();  // 200 to 600 inch, longer than half of any chord
      const bool arc = random.below(3) == 0;
      const std::string code = arc ? "G18 G2" : "G1";
      inch +=
          code + word('X', x * 10) + word('Z', z * 10) + word('C', c) + (arc ? word('R', r * 20) : "") + "\n";
      metric += code + word('X', x * 254) + word('Z', z * 254) + word('C', c) +
                (arc ? word('R', r * 508) : "") + "\n";
    }
    TestMachine machine;
    // Numbers up to 3e5 carry 2^-53 of themselves, 3e-11; a centre far from a short chord amplifies that.
    expect_same_moves(run(machine, inch), run(machine, metric), 1e-5);
  }
}

TEST(Property, ArcByCentreEqualsArcByRadius) {
  for (int p = 0; p < 2000; ++p) {
    RandomProgram random(2000 + static_cast<unsigned>(p));
    const double radius = random.real(1, 300);
    const double begin = random.real(0, 6.28);
    const double sweep = random.real(5, 355);
    const bool clockwise = random.below(2) == 0;
    if (std::abs(sweep - 180) < 5) continue;  // there the centre is ill-conditioned in the R form
    const double end = begin + (clockwise ? -sweep : sweep) * std::numbers::pi / 180;
    static constexpr const char* planes[] = {"G17", "G18", "G19"};
    const unsigned plane = random.below(3);
    const PlaneAxes axes = plane_axes(static_cast<Plane>(plane));
    const char first = axis_letters[axes.first];
    const char second = axis_letters[axes.second];
    const double from_first = radius * std::cos(begin);
    const double from_second = radius * std::sin(begin);
    const std::string start = std::string(planes[plane]) + " G0" + word(first, from_first) +
                              word(second, from_second) + "\n" + (clockwise ? "G2" : "G3") + " F100" +
                              word(first, radius * std::cos(end)) + word(second, radius * std::sin(end));
    const std::string centre = word(static_cast<char>('I' + axes.first), -from_first) +
                               word(static_cast<char>('I' + axes.second), -from_second);
    const std::string by_radius = word('R', sweep > 180 ? -radius : radius);
    TestMachine machine;
    const Interpretation a = run(machine, start + centre + "\n");
    const Interpretation b = run(machine, start + by_radius + "\n");
    // Words carry 5e-10; at 5 degrees from 0 or 180 the centre amplifies that at most about 25 times.
    expect_same_moves(a, b, 1e-7);
    EXPECT_NEAR(a.commands[1].arc.sweep, sweep, 1e-6);
  }
}

TEST(Property, EndOfAnArcIsTheStartTurnedByItsSweep) {
  for (int p = 0; p < 2000; ++p) {
    RandomProgram random(5000 + static_cast<unsigned>(p));
    const bool clockwise = random.below(2) == 0;
    const unsigned turns = 1 + random.below(3);
    const double x = random.real(-100, 100);
    const double y = random.real(-100, 100);
    const double radius = random.real(101, 400) * (random.below(2) == 0 ? -1 : 1) * std::sqrt(2.0);
    const std::string program = std::string(clockwise ? "G2" : "G3") + word('X', x) + word('Y', y) +
                                word('R', radius) + " L" + std::to_string(turns) + " F1\n";
    TestMachine machine;
    const Interpretation result = run(machine, program);
    ASSERT_EQ(result.last, Step::end) << result.alarm.text.data();
    const Command& arc = result.commands[0];
    const double angle = arc.arc.sweep * (clockwise ? -1 : 1) * std::numbers::pi / 180;
    const double from_x = -arc.arc.centre[0];
    const double from_y = -arc.arc.centre[1];
    EXPECT_NEAR(arc.arc.centre[0] + std::cos(angle) * from_x - std::sin(angle) * from_y, arc.target[X], 1e-9);
    EXPECT_NEAR(arc.arc.centre[1] + std::sin(angle) * from_x + std::cos(angle) * from_y, arc.target[Y], 1e-9);
    EXPECT_NEAR(std::hypot(from_x, from_y), std::abs(radius), 1e-8);
    EXPECT_GT(arc.arc.sweep, 360.0 * (turns - 1));
    EXPECT_LE(arc.arc.sweep, 360.0 * turns);
  }
}

TEST(Property, FormOfABlockDoesNotMatter) {
  const std::string plain = "G90\nG1X10.5Y-3F100\nG91X1C5\nG3X1.Y1.I1.\nM8\nG4P10\n";
  for (int p = 0; p < 500; ++p) {
    RandomProgram random(9000 + static_cast<unsigned>(p));
    std::string other;
    for (const char c : plain) {
      // Blanks and comments may stand before a letter, blanks behind it; line ends are any of three.
      const bool letter = c >= 'A' && c <= 'Z';
      if (letter && random.below(3) == 0) other += random.below(2) == 0 ? " \t" : "(G0 X9)";
      if (c == '\n') {
        static constexpr const char* ends[] = {"\n", "\r\n", "\r", ";x\n", " \n\n"};
        other += ends[random.below(5)];
        continue;
      }
      other += letter && random.below(2) == 0 ? static_cast<char>(c - 'A' + 'a') : c;
      if (letter && random.below(4) == 0) other += ' ';
    }
    TestMachine machine;
    expect_same_moves(run(machine, plain), run(machine, other), 0);
  }
}

}  // namespace
}  // namespace trunnion::language::test
