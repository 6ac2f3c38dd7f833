// SPDX-License-Identifier: Apache-2.0
#include "truth/encoder.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace trunnion::truth {
namespace {

Encoder encoder(const EncoderTruth& truth, double at) {
  Encoder e;
  e.configure(truth);
  e.start(at);
  return e;
}

void move(Encoder& e, double from, double to, double step = 0.37) {
  const auto count = static_cast<int>(std::ceil(std::abs(to - from) / step));
  for (int i = 1; i <= count; ++i) e.move(from + (to - from) * i / count);
}

TEST(Encoder, AnAbsoluteOneReadsItsPositionInStepsOfItsResolution) {
  EncoderTruth t;
  t.resolution = 0.01;
  auto e = encoder(t, 12.3449);
  EXPECT_NEAR(e.reading(), 12.34, 1e-12);
  e.move(12.3451);
  EXPECT_NEAR(e.reading(), 12.35, 1e-12);
  EXPECT_EQ(e.reference(), 0.0);
}

TEST(Encoder, MountedTheWrongWayRoundItCountsDown) {
  EncoderTruth t;
  t.inverted = true;
  auto e = encoder(t, 10);
  e.move(11);
  EXPECT_NEAR(e.reading(), -11, 1e-9);
}

TEST(Encoder, AnIncrementalOneCountsFromItsStartAndLatchesTheIndex) {
  EncoderTruth t;
  t.kind = EncoderKind::incremental;
  t.mark_spacing = 10, t.first_mark = 3;
  auto e = encoder(t, 5);
  EXPECT_EQ(e.reading(), 0);
  move(e, 5, 24);
  EXPECT_NEAR(e.reading(), 19, 1e-9);
  EXPECT_EQ(e.marks(), 2u) << "at 13 and 23";
  EXPECT_NEAR(e.mark_latch(), 18, 1e-9);
  EXPECT_FALSE(e.reference());
  move(e, 24, 12);
  EXPECT_NEAR(e.mark_latch(), 8, 1e-9);
}

TEST(Encoder, TwoDistanceCodedMarksGiveThePositionFromAnyPlaceInBothDirections) {
  for (const bool inverted : {false, true}) {
    EncoderTruth t;
    t.kind = EncoderKind::distance_coded;
    t.inverted = inverted;
    t.mark_spacing = 20, t.mark_increment = 0.02, t.first_mark = -600;
    t.resolution = 1e-4;
    for (double start = -560; start < 500; start += 37.3)
      for (const double direction : {1.0, -1.0}) {
        auto e = encoder(t, start);
        EXPECT_FALSE(e.reference());
        // Two marks are at most two gaps, below 2 * 10.6 mm, away.
        const double end = start + direction * 22;
        move(e, start, end);
        ASSERT_TRUE(e.reference()) << start;
        // A scale mounted the wrong way round counts down: its counts are minus the position.
        EXPECT_NEAR((inverted ? -1 : 1) * (e.reading() + *e.reference()), end, 2e-4) << start;
      }
  }
}

TEST(Encoder, EveryGapOfADistanceCodedScaleIsThereOnce) {
  EncoderTruth t;
  t.mark_spacing = 20, t.mark_increment = 0.02, t.first_mark = -600;
  for (long n = 2; n < 900; ++n) {
    const double upper = distance_coded_mark(t, n + 1);
    const auto found = decode_gap(t, upper - distance_coded_mark(t, n));
    ASSERT_TRUE(found) << n;
    EXPECT_NEAR(*found, upper, 1e-9) << n;
  }
  EXPECT_FALSE(decode_gap(t, 10)) << "no gap without an increment";
  EXPECT_FALSE(decode_gap(t, 10.11)) << "5.5 increments: pulses are missing";
}

// The marks that each motion passes, one after the other, by their positions.
TEST(Encoder, EveryMarkIsLatchedOnceWhereverAMotionBeginsOrTurns) {
  for (const auto kind : {EncoderKind::incremental, EncoderKind::distance_coded}) {
    EncoderTruth t;
    t.kind = kind;
    t.mark_spacing = 20, t.mark_increment = 0.02, t.first_mark = -600, t.resolution = 1e-4;
    std::vector<double> marks;
    for (long n = 2; n < 80; ++n)
      marks.push_back(kind == EncoderKind::distance_coded ? distance_coded_mark(t, n)
                                                          : t.first_mark + static_cast<double>(n) * 20);
    double at = -500;
    auto e = encoder(t, at);
    std::uint64_t passed = 0;
    double newest = 0;
    // Steps of up to 15 mm pass no, one or two marks; some end on a mark: it belongs to the way that comes
    // from below and to the one that leaves it downwards.
    for (int i = 0; i < 3000; ++i) {
      double to = i % 7 == 0 ? marks[static_cast<std::size_t>(20 + i % 11)]
                             : at + (i % 13 == 0 ? 15.0 : 0.8) * std::sin(0.1 * i);
      to = std::clamp(to, -550.0, 150.0);
      const auto mark_count = passed;
      for (const double mark : marks)
        if (mark > std::min(at, to) && mark <= std::max(at, to)) {
          // Upwards the highest is the newest one, downwards the lowest.
          if (to > at || mark_count == passed) newest = mark;
          ++passed;
        }
      e.move(to);
      ASSERT_EQ(e.marks(), passed) << i;
      if (passed > 0) {
        ASSERT_NEAR(e.mark_latch(), newest + 500, 1e-4) << i;
      }
      at = to;
    }
    EXPECT_GT(passed, 300u);
  }
}

TEST(Encoder, InterpolationErrorsOfASignalHaveTheirHarmonics) {
  EncoderTruth t;
  t.signal_period = 0.02;
  const double unit = t.signal_period / (2 * std::numbers::pi);
  // To first order an offset of the cosine by 1 % gives -0.01 sin, of the sine +0.01 cos, an amplitude of 1 %
  // half of sin(2 angle), a phase of 1 deg: sin(angle + 1 deg) instead of sin: 1 deg * cos^2.
  for (double share = 0.03; share < 1; share += 0.1) {
    const double x = share * t.signal_period, a = 2 * std::numbers::pi * share;
    auto f = t;
    f.cosine_offset = 0.01;
    EXPECT_NEAR(interpolation_error(f, x), -0.01 * unit * std::sin(a), 1.1e-4 * unit);
    f = t, f.sine_offset = 0.01;
    EXPECT_NEAR(interpolation_error(f, x), 0.01 * unit * std::cos(a), 1.1e-4 * unit);
    f = t, f.amplitude = 0.01;
    EXPECT_NEAR(interpolation_error(f, x), 0.005 * unit * std::sin(2 * a), 1.1e-4 * unit);
    f = t, f.phase = 1;
    EXPECT_NEAR(interpolation_error(f, x), std::numbers::pi / 180 * unit * std::pow(std::cos(a), 2),
                4e-4 * unit);
  }
  EXPECT_NEAR(interpolation_error(t, 1.2345), 0, 1e-15);
}

TEST(Encoder, MissingPulsesAreLostAtEveryPassageAndComeBackInTheOtherDirection) {
  EncoderTruth t;
  t.kind = EncoderKind::incremental;
  t.resolution = 0.001;
  t.lost_at = 50, t.lost_counts = 4;
  auto e = encoder(t, 0);
  move(e, 0, 100);
  EXPECT_NEAR(e.reading(), 100 - 0.004, 1e-9);
  move(e, 100, 0);
  EXPECT_NEAR(e.reading(), 0, 1e-9);
}

}  // namespace
}  // namespace trunnion::truth
