// SPDX-License-Identifier: Apache-2.0
// A ball in a fixed place of the workpiece that the control holds at the tip (RTCP) while a rotary axis
// turns, and three displacement sensors that read the tip's deviation from it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "identification/ball_setting.hpp"
#include "identification/true_machine.hpp"
#include "machine_tests/servo_session.hpp"

namespace trunnion::machine_tests {

struct BallOptions {
  std::string axis = "C", source = "true";  ///< true: sensors on the true machine; encoder: position loops
  identification::WantedBall ball;
  std::optional<double> start, sweep;  ///< deg
  std::vector<std::string> hold;       ///< A-30: another rotary axis stands there
  std::uint32_t tool = 1;
  std::uint16_t channel = 0;
};

struct BallMotion {
  identification::BallTurn there, back;
  std::vector<identification::ServoOfAxis> servos;
};

/// The machine and the motion of one test.
class BallTest {
 public:
  /// Throws std::runtime_error with one line: no such axis, a place outside of the travel.
  BallTest(ServoSession& session, const BallOptions& options);

  /// A turn to and one back at `feed` mm/min along the circle from `start` deg, sampled at 2 kHz.
  BallMotion run(double feed, double start);
  /// `stops` stops at equal angles of the turn from `start`, each the mean of 0.1 s.
  std::vector<identification::BallSample> stop(std::size_t stops, double start);

  const identification::TurnedBall& set() const { return set_; }
  double start() const { return start_; }

 private:
  void find_circle();
  void check_travel(double start) const;
  identification::BallProgram program() const { return {session_.axes(), options_.tool}; }
  servo_analysis::ChannelMotion sampled(const std::string& program, std::uint16_t decimation);
  std::vector<identification::BallSample> read(const servo_analysis::ChannelMotion& motion,
                                               const identification::PredictedMotion* predicted);
  identification::BallTurn turned_by(double way, const std::vector<identification::BallSample>& samples,
                                     double interval) const;

  ServoSession& session_;
  BallOptions options_;
  identification::TrueMachine machine_;
  identification::TurnedBall set_;
  double start_ = 0;
  std::optional<truth::Instrument> sensor_;
};

}  // namespace trunnion::machine_tests
