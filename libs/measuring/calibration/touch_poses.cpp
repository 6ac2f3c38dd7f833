// SPDX-License-Identifier: Apache-2.0
#include "calibration/touch_sequence.hpp"

namespace trunnion::calibration {

std::vector<TouchedPose> touch_poses(const MeasurementInputs& inputs, const MeasuredMachine& measured,
                                     const MeasurementPlan& plan, const TouchRound& touch,
                                     std::vector<TouchedPose> done, const PoseDone& news) {
  TouchSequence sequence(inputs, measured, plan, std::move(done));
  while (!sequence.finished())
    if (sequence.take(touch(sequence.pose(), sequence.centre(), sequence.name())) && news)
      news(sequence.done());
  return sequence.done();
}

}  // namespace trunnion::calibration
