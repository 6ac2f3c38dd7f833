// SPDX-License-Identifier: Apache-2.0
// A ball in a fixed place of the workpiece that the control holds at the tip (RTCP) while a rotary axis
// turns, and three displacement sensors that read the tip's deviation from it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "channel_motion.hpp"
#include "servo_analysis/servo_response.hpp"

namespace trunnion::cli {

using truth::Vec3;

struct BallOptions {
  std::string machine, axis = "C", ball, source = "true", plot;
  double radius = 72.411, height = 50;  ///< mm, of the ball about the axis and along it, without `ball`
  double feed = 2000;                   ///< mm/min along the circle of the ball
  std::optional<double> start, sweep;   ///< deg
  std::vector<std::string> hold;        ///< A-30: another rotary axis stands there
  std::uint32_t tool = 1;
  std::uint16_t channel = 0;
};

/// What the sensors read at one sample, or in the mean of one stop.
struct BallSample {
  geometry::Angles angles{};      ///< deg, as commanded
  double turned = 0;              ///< deg: of the axis since sample 0 of the motion, without jumps at 360
  Vec3 place = Vec3::Zero();      ///< mm: X Y Z that puts the tip of the model into the ball
  Vec3 deviation = Vec3::Zero();  ///< mm: of the tip from the ball, along X Y Z, by the sensors
  Vec3 following = Vec3::Zero();  ///< mm: the part of it that the model of the servos predicts
};

struct ServoOfAxis {
  char letter = 0;
  servo_analysis::ServoResponse response;
  double prediction_error = 0;  ///< mm or deg: root mean square of predicted less real position
};

struct BallTurn {
  std::vector<BallSample> samples;  ///< of the turn
  Vec3 noise = Vec3::Zero();        ///< mm: standard deviation of the readings at rest before it
  double interval = 0.0005;         ///< s
  double speed = 0;                 ///< rad/s of the axis, signed, as commanded in the middle of the turn
};

struct BallMotion {
  BallTurn there, back;
  std::vector<ServoOfAxis> servos;
};

/// The machine and the motion of one test.
class BallTest {
 public:
  /// Throws std::runtime_error with one line: no such axis, a place outside of the travel.
  BallTest(ServoSession& session, const BallOptions& options);

  /// A turn to and one back at `feed` mm/min along the circle from `start` deg, sampled at 2 kHz.
  BallMotion run(double feed, double start);
  /// `stops` stops at equal angles of the turn from `start`, each the mean of 0.1 s.
  std::vector<BallSample> stop(std::size_t stops, double start);

  std::size_t axis() const { return axis_; }  ///< 3 .. 8
  const Vec3& ball() const { return ball_; }  ///< mm, workpiece frame
  double tool_length() const { return tool_length_; }
  double start() const { return start_; }
  double sweep() const { return sweep_; }
  double radius() const { return radius_; }             ///< mm: of the ball's circle
  const Vec3& direction() const { return direction_; }  ///< of the axis, unit vector, machine X Y Z
  const Vec3& centre() const { return centre_; }        ///< mm: of the circle, machine X Y Z
  const geometry::Chain& model() const { return model_; }
  const TrueMachine& machine() const { return machine_; }

 private:
  geometry::Angles angles_at(double angle) const;
  Vec3 place_at(double angle) const;
  void find_circle();
  void check_travel(double start) const;
  std::string opening(double start) const;
  std::string closing() const;
  ChannelMotion sampled(const std::string& program, std::uint16_t decimation);
  static bool at_ball(const ChannelMotion& motion, const BallSample& sample, std::size_t i);
  std::vector<BallSample> read(const ChannelMotion& motion, std::vector<ServoOfAxis>* servos);
  BallTurn cut(const std::vector<BallSample>& samples, double interval, int sense) const;

  ServoSession& session_;
  BallOptions options_;
  TrueMachine machine_;
  geometry::Chain model_;
  std::size_t axis_ = 5;
  geometry::Angles held_{};
  Vec3 ball_ = Vec3::Zero(), direction_ = Vec3::UnitZ(), centre_ = Vec3::Zero();
  double tool_length_ = 0, start_ = 0, sweep_ = 360, radius_ = 0;
  std::optional<truth::Instrument> sensor_;
};

}  // namespace trunnion::cli
