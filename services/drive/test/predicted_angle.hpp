// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace trunnion::drive {

/// As a channel predicts the angle of a spindle: the least squares line through the angles of the 16 cycles
/// up to n - 40, at cycle n. From the middle of these cycles the newest is 7.5 and n is 47.5 cycles; the
/// squares of -7.5, -6.5 .. 7.5 add up to 340.
template <class AngleAt>
double predicted_angle(const AngleAt& angle, std::int64_t n) {
  double mean = 0, slope = 0;
  for (std::int64_t k = 0; k < 16; ++k) {
    const double value = angle(n - 55 + k);
    mean += value / 16;
    slope += (static_cast<double>(k) - 7.5) * value / 340;
  }
  return mean + 47.5 * slope;
}

/// mm of a thread with a lead of 1 mm, `turned` rev behind its start: it takes 2 rev to reach the speed of
/// the spindle, which is 1 mm less than the spindle has turned, and stops within the 2 rev before `length`.
inline double thread_path(double turned, double length) {
  constexpr double run = 2;
  if (turned <= 0) return 0;
  if (turned < run) return turned * turned / (2 * run);
  if (turned < length - run) return turned - run / 2;
  if (turned < length) return length - run - (length - turned) * (length - turned) / (2 * run);
  return length - run;
}

}  // namespace trunnion::drive
