// SPDX-License-Identifier: Apache-2.0
// One geometric error of an axis as a function of a position: polynomials, harmonics and tables, which may
// differ by the direction of approach.
#pragma once

#include <cstddef>
#include <vector>

namespace trunnion::volumetric {

/// Sum over k of coefficients[k] * ((x - origin) / unit)^k.
struct Polynomial {
  double origin = 0, unit = 1;  ///< mm or deg; unit above zero
  std::vector<double> coefficients;
};

/// amplitude * sin(360 deg * x / period + phase): the pitch of a screw, the teeth of a gear.
struct Harmonic {
  double period = 1;  ///< mm or deg, above zero
  double amplitude = 0;
  double phase = 0;  ///< deg
};

/// Values at ascending positions. Before the first and after the last position the value of that one; with
/// `modulo` the table repeats (its positions are within one period).
struct Table {
  std::vector<double> positions, values;
  double modulo = 0;  ///< mm or deg; 0: the table does not repeat
  bool cubic = false;
  /// Of a cubic table: the derivative at each position. See finish().
  std::vector<double> slopes;

  /// Computes `slopes`: the derivative of the parabola through a point and its neighbours (at an end: of the
  /// line), so that the cubic pieces join with a continuous derivative. Call after a change of the others.
  void finish();
  double value(double x) const;
};

struct ErrorTerms {
  std::vector<Polynomial> polynomials;
  std::vector<Harmonic> harmonics;
  std::vector<Table> tables;

  double value(double x) const;
  bool empty() const { return polynomials.empty() && harmonics.empty() && tables.empty(); }
};

/// Values in mm or rad, positions in mm or deg.
struct ErrorFunction {
  ErrorTerms terms;               ///< of both directions of approach
  ErrorTerms positive, negative;  ///< in addition, after a motion in the positive or negative direction
  /// Value after a positive less value after a negative approach, in addition (ISO 230-2 reversal value).
  double reversal = 0;

  /// `approach`: above zero after a motion in the positive direction, below zero in the negative one, zero:
  /// the mean of both. No allocation.
  double value(double x, int approach) const;
};

}  // namespace trunnion::volumetric
