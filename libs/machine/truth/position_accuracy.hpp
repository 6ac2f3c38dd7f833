// SPDX-License-Identifier: Apache-2.0
// Accuracy and repeatability of positioning by ISO 230-2:2014.
#pragma once

#include <vector>

namespace trunnion::truth {

/// Deviations at one target position, one of each run, mm or rad.
struct TargetDeviations {
  double position = 0;           ///< mm or deg
  std::vector<double> up, down;  ///< approached in the positive, in the negative direction
};

/// The figures of the standard's clause 3, mm or rad.
struct PositionAccuracy {
  double reversal = 0;            ///< B
  double mean_reversal = 0;       ///< of all targets, up less down
  double repeatability = 0;       ///< R, bidirectional
  double systematic = 0;          ///< E, bidirectional
  double mean_bidirectional = 0;  ///< M
  double accuracy = 0;            ///< A, bidirectional
};

/// Every target has at least two runs of each direction. Throws std::invalid_argument otherwise.
PositionAccuracy position_accuracy(const std::vector<TargetDeviations>& targets);

}  // namespace trunnion::truth
