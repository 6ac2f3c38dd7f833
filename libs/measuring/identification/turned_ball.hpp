// SPDX-License-Identifier: Apache-2.0
// A ball in a fixed place of the workpiece that the control holds at the tip (RTCP) while a rotary axis
// turns, and what three displacement sensors read of the tip's deviation from it.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "machine/machine_outline.hpp"
#include "servo_analysis/channel_motion.hpp"
#include "servo_analysis/servo_response.hpp"
#include "truth/instrument.hpp"

namespace trunnion::identification {

/// The machine of a test, and where its ball is by the control's model.
struct TurnedBall {
  machine::MachineOutline machine;
  geometry::Chain model;
  std::size_t axis = 5;                    ///< that turns, 3 .. 8: A .. W
  geometry::Angles held{};                 ///< deg: of the other rotary axes
  truth::Vec3 ball = truth::Vec3::Zero();  ///< mm, workpiece frame
  double tool_length = 0;                  ///< mm
  double sweep = 360;                      ///< deg, signed
  /// The ball's circle about the axis: machine X Y Z, mm; the direction of the axis is a unit vector.
  truth::Vec3 centre = truth::Vec3::Zero(), direction = truth::Vec3::UnitZ();
  double radius = 0;
};

/// What the sensors read at one sample, or in the mean of one stop.
struct BallSample {
  geometry::Angles angles{};                    ///< deg, as commanded
  double turned = 0;                            ///< deg: of the axis since sample 0, without jumps at 360
  truth::Vec3 place = truth::Vec3::Zero();      ///< mm: X Y Z that puts the tip of the model into the ball
  truth::Vec3 deviation = truth::Vec3::Zero();  ///< mm: of the tip from the ball, along X Y Z
  truth::Vec3 following = truth::Vec3::Zero();  ///< mm: the part of it that the model of the servos predicts
  bool at_ball = false;  ///< the linear axes have put the tip into the ball: tool tip control has begun
};

struct ServoOfAxis {
  char letter = 0;
  servo_analysis::ServoResponse response;
  double prediction_error = 0;  ///< mm or deg: root mean square of predicted less real position
};

/// A motion as the models of its servos make it of the commands.
struct PredictedMotion {
  std::vector<ServoOfAxis> servos;
  std::array<std::vector<double>, canonical::axis_count> positions;  ///< empty: as commanded
};

/// The servos of the axes that move, a rotary axis with the speed of a ball at `radius` mm.
PredictedMotion predict_servos(const servo_analysis::ChannelMotion& motion, double radius);

/// `tips`: where the tip truly is at every sample, or empty: by the position loops. `sensor` reads each of
/// the three displacements. Without `predicted` nothing of a deviation is the servos'.
std::vector<BallSample> read_ball(const TurnedBall& set, const servo_analysis::ChannelMotion& motion,
                                  const std::vector<truth::Vec3>& tips, truth::Instrument& sensor,
                                  const PredictedMotion* predicted);

struct BallTurn {
  std::vector<BallSample> samples;          ///< of the turn
  truth::Vec3 noise = truth::Vec3::Zero();  ///< mm: standard deviation of the readings at rest before it
  double interval = 0.0005;                 ///< s
  double speed = 0;  ///< rad/s of the axis, signed, as commanded in the middle of the turn
};

/// The first motion of the axis by `way` deg, signed, between two rests; nothing when there is none.
std::optional<BallTurn> turn_between_rests(const std::vector<BallSample>& samples, double interval,
                                           double way);

/// The means of the first `stops` stops at equal angles of the sweep from `start` deg, as many as there are.
std::vector<BallSample> means_at_stops(const TurnedBall& set, const std::vector<BallSample>& samples,
                                       double interval, double start, std::size_t stops);

}  // namespace trunnion::identification
