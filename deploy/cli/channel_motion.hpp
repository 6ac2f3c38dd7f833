// SPDX-License-Identifier: Apache-2.0
// What the axes of one channel did in a motion: of a cluster's drives, or of a recording.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "servo_session.hpp"
#include "true_machine.hpp"

namespace trunnion::cli {

/// Samples of X Y Z A B C U V W at equal intervals; mm or deg, machine coordinates.
struct ChannelMotion {
  double interval = 0.001;                                          ///< s
  std::size_t count = 0;                                            ///< samples
  std::array<double, truth::axis_count> resting{};                  ///< of axes without a trace
  std::array<servo_analysis::AxisTrace, truth::axis_count> traces;  ///< empty: the axis rests

  double commanded(std::size_t axis, std::size_t i) const { return at(axis, traces[axis].setpoint, i); }
  double feedback(std::size_t axis, std::size_t i) const { return at(axis, traces[axis].feedback, i); }
  /// By the load's encoder where there is one.
  double load(std::size_t axis, std::size_t i) const { return at(axis, traces[axis].load, i); }

 private:
  double at(std::size_t axis, const std::vector<double>& values, std::size_t i) const {
    return values.empty() ? resting[axis] : values[i];
  }
};

/// Runs `program` and samples the axes `sampled` (letters) every `decimation` periods of the speed loop while
/// the channel moves; the other axes rest where they are. When this computer loses samples, the program runs
/// again, at last with a quarter of the rate: the interval of the result says which.
ChannelMotion run_sampled(ServoSession& session, const std::string& program, const std::string& sampled,
                          std::uint16_t decimation);

/// From the path (commanded, in machine coordinates, without compensation) and the feedback of a recording,
/// one sample for each cycle that has both. `parameters`: those of the recording. Throws std::runtime_error.
ChannelMotion motion_of_recording(const std::string& file, std::uint16_t channel,
                                  machine::Parameters& parameters);

/// Where the tip truly is at every sample: the geometry of truth.yaml at the positions of the loads; the
/// direction of approach of an axis is that of its newest commanded motion. mm, workpiece frame.
std::vector<truth::Vec3> true_tips(const ChannelMotion& motion, const truth::PoseReport& report);

}  // namespace trunnion::cli
