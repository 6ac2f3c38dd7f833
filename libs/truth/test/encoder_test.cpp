// SPDX-License-Identifier: Apache-2.0
#include "truth/encoder.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

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
        // The reading, counted from the reference, is the position; an inverted scale has its marks in its
        // own direction.
        const double expected = inverted ? *e.reference() : end;
        EXPECT_NEAR(inverted ? *e.reference() : e.reading() + *e.reference(), expected, 2e-4) << start;
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
