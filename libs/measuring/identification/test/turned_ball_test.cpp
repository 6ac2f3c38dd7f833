// SPDX-License-Identifier: Apache-2.0
// What sensors about a ball read while a rotary axis turns, and what an R-test finds in it.
#include "identification/turned_ball.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "ac_machine.hpp"
#include "identification/r_test_evaluation.hpp"
#include "identification/true_tips.hpp"
#include "truth/truth_file.hpp"

namespace trunnion::identification {
namespace {

using servo_analysis::ChannelMotion;
using truth::Vec3;

constexpr double one_degree = std::numbers::pi / 180;
constexpr std::size_t c_angle = 2;  // of A B C

// On the table of the AC trunnion machine, whose C has the direction -Z and passes through X0 Y0.
TurnedBall ball_on_table() {
  const auto parameters = DrawnMachine::parameters_of("ac-table");
  TurnedBall set{machine::outline_of(parameters, 0), machine::make_chain(parameters, 0)};
  set.axis = 3 + c_angle;
  set.ball = Vec3(72.411, 0, -350);
  set.tool_length = 100;
  set.direction = -Vec3::UnitZ();
  set.radius = 72.411;
  return set;
}

// A motion of C from 350 over 360 to 370 deg in steps of 1 deg: the position loops are `off` mm from the
// place of the ball.
ChannelMotion over_the_turn(const TurnedBall& set, const Vec3& off) {
  ChannelMotion motion;
  motion.count = 21;
  for (std::size_t i = 0; i < motion.count; ++i) {
    geometry::Angles angles{};
    angles[c_angle] = i < 10 ? 350.0 + static_cast<double>(i) : static_cast<double>(i) - 10.0;
    const Vec3 place = set.model.machine_from_tip(set.ball, angles, set.tool_length);
    for (std::size_t k = 0; k < 3; ++k) {
      const auto index = static_cast<Eigen::Index>(k);
      motion.traces[k].setpoint.push_back(place[index]);
      motion.traces[k].feedback.push_back(place[index] + off[index]);
    }
    motion.traces[3 + c_angle].setpoint.push_back(angles[c_angle]);
    motion.traces[3 + c_angle].feedback.push_back(angles[c_angle]);
  }
  return motion;
}

TEST(TurnedBall, IsReadByThePositionLoops) {
  const auto set = ball_on_table();
  const Vec3 off(0.01, -0.02, 0.03);
  truth::Instrument sensor(truth::InstrumentTruth{});
  const auto samples = read_ball(set, over_the_turn(set, off), {}, sensor, nullptr);
  ASSERT_EQ(samples.size(), 21u);
  EXPECT_NEAR(samples.back().turned, 20, 1e-9) << "not -340";
  for (const auto& sample : samples) {
    EXPECT_LT((sample.deviation - off).norm(), 1e-9);
    EXPECT_EQ(sample.following.norm(), 0);
    EXPECT_TRUE(sample.at_ball);
  }
}

TEST(TurnedBall, IsReadWhereTheTipTrulyIs) {
  const auto set = ball_on_table();
  const auto motion = over_the_turn(set, Vec3::Zero());
  const Vec3 off(0, 0, 0.02);
  std::vector<Vec3> tips;
  for (std::size_t i = 0; i < motion.count; ++i) {
    geometry::Angles angles{};
    angles[c_angle] = motion.commanded(3 + c_angle, i);
    const Vec3 place = set.model.machine_from_tip(set.ball, angles, set.tool_length);
    tips.push_back(set.model.tip_from_machine(place + off, angles, set.tool_length));
  }
  truth::Instrument sensor(truth::InstrumentTruth{});
  for (const auto& sample : read_ball(set, motion, tips, sensor, nullptr))
    EXPECT_LT((sample.deviation - off).norm(), 1e-9);
}

TEST(TurnedBall, KnowsWhatTheServosPredict) {
  const auto set = ball_on_table();
  const auto motion = over_the_turn(set, Vec3::Zero());
  PredictedMotion predicted;
  for (const double y : motion.traces[1].setpoint) predicted.positions[1].push_back(y - 0.004);
  truth::Instrument sensor(truth::InstrumentTruth{});
  for (const auto& sample : read_ball(set, motion, {}, sensor, &predicted))
    EXPECT_LT((sample.following - Vec3(0, -0.004, 0)).norm(), 1e-9);
}

TEST(TurnedBall, IsNotAtTheTipWhileAnAxisIsOnItsWay) {
  const auto set = ball_on_table();
  auto motion = over_the_turn(set, Vec3::Zero());
  motion.traces[2].setpoint[0] += 5;  // mm
  truth::Instrument sensor(truth::InstrumentTruth{});
  const auto samples = read_ball(set, motion, {}, sensor, nullptr);
  ASSERT_GE(samples.size(), 2u);
  EXPECT_FALSE(samples[0].at_ball);
  EXPECT_TRUE(samples[1].at_ball);
}

// X follows a cosine of 10 mm in a second by a servo that is known; Y moves with a thousandth of its speed.
TEST(PredictServos, IdentifiesTheAxesThatMove) {
  const servo_analysis::ServoResponse servo{150, 0.8, 0.004, 60, 0, 0};
  ChannelMotion motion;
  motion.interval = 0.0005, motion.count = 2000;
  auto &x = motion.traces[0], &y = motion.traces[1];
  x.interval = y.interval = motion.interval;
  for (std::size_t i = 0; i < motion.count; ++i)
    x.setpoint.push_back(5 - 5 * std::cos(2 * std::numbers::pi * motion.interval * static_cast<double>(i)));
  x.feedback = servo_analysis::predicted_positions(servo, x.setpoint, motion.interval);
  for (std::size_t i = 0; i < motion.count; ++i) {
    x.speed.push_back(i == 0 ? 0 : (x.feedback[i] - x.feedback[i - 1]) / motion.interval);
    x.speed_set.push_back(servo.position_gain * (x.setpoint[i] - x.feedback[i]));
    x.excitation.push_back(0);
    y.setpoint.push_back(x.setpoint[i] / 1000), y.feedback.push_back(x.feedback[i] / 1000);
    y.speed.push_back(x.speed[i] / 1000), y.speed_set.push_back(x.speed_set[i] / 1000);
    y.excitation.push_back(0);
  }
  const auto predicted = predict_servos(motion, 100);
  ASSERT_EQ(predicted.servos.size(), 1u);
  EXPECT_EQ(predicted.servos[0].letter, 'X');
  EXPECT_NEAR(predicted.servos[0].response.position_gain, servo.position_gain, 1);
  // At 31 mm/s the axis lags by 0.5 mm; its speed is the mean of half a sample before, 0.25 ms or 8 um.
  EXPECT_LT(predicted.servos[0].prediction_error, 0.05);
  EXPECT_EQ(predicted.positions[0].size(), motion.count);
  EXPECT_TRUE(predicted.positions[1].empty());
}

// Samples in which the axis rests, in which it turns by `step` deg each, and so on.
class Samples {
 public:
  void rest(int count, double deviation, bool at_ball = true) {
    for (int i = 0; i < count; ++i) add(0, i % 2 == 0 ? deviation : -deviation, at_ball);
  }
  void constant(int count, double deviation, bool at_ball = true) {
    for (int i = 0; i < count; ++i) add(0, deviation, at_ball);
  }
  void turn(int count, double step) {
    for (int i = 0; i < count; ++i) add(step, 1, true);
  }
  std::vector<BallSample> all;

 private:
  void add(double step, double deviation, bool at_ball) {
    BallSample sample;
    turned_ += step;
    sample.turned = sample.angles[c_angle] = turned_;
    sample.deviation = Vec3(deviation, 0, 0);
    sample.at_ball = at_ball;
    all.push_back(sample);
  }
  double turned_ = 0;
};

TEST(BallTurn, IsTheMotionByTheWholeWayBetweenTwoRests) {
  Samples samples;
  samples.rest(500, 1e-3);
  samples.turn(100, 0.1);
  samples.rest(400, 2e-3);
  samples.turn(100, -0.1);
  samples.rest(400, 1e-3);
  const auto there = turn_between_rests(samples.all, 0.001, 10);
  ASSERT_TRUE(there);
  EXPECT_EQ(there->samples.size(), 101u) << "with the last one at rest";
  EXPECT_NEAR(there->samples.back().turned, 10, 1e-9);
  // 0.1 deg in 1 ms.
  EXPECT_NEAR(there->speed, 100 * one_degree, 1e-6);
  EXPECT_NEAR(there->noise.x(), 1e-3, 1e-5);
  EXPECT_EQ(there->interval, 0.001);
  const auto back = turn_between_rests(samples.all, 0.001, -10);
  ASSERT_TRUE(back);
  EXPECT_NEAR(back->speed, -100 * one_degree, 1e-6);
  EXPECT_NEAR(back->noise.x(), 2e-3, 2e-5);
  EXPECT_FALSE(turn_between_rests(samples.all, 0.001, 20));
}

// Before the first stop the linear axes go to the ball at the angle of the start.
TEST(BallStops, AreTheMeansOfTheRestsAtTheirAngles) {
  Samples samples;
  samples.constant(60, 9, false);
  samples.constant(100, 0);
  for (int stop = 1; stop < 4; ++stop) {
    samples.turn(10, 9);
    samples.constant(100, stop * 1e-3);
  }
  auto set = ball_on_table();
  set.sweep = 360;
  const auto means = means_at_stops(set, samples.all, 0.005, 0, 4);
  ASSERT_EQ(means.size(), 4u);
  for (std::size_t stop = 0; stop < 4; ++stop) {
    EXPECT_NEAR(means[stop].deviation.x(), static_cast<double>(stop) * 1e-3, 1e-12);
    EXPECT_EQ(means[stop].turned, 90.0 * static_cast<double>(stop));
  }
  samples.all.resize(samples.all.size() - 100);
  EXPECT_EQ(means_at_stops(set, samples.all, 0.005, 0, 4).size(), 3u);
}

// The tip of an axis that is displaced by `shift`, as the workpiece sees it (axis_location_test).
Vec3 displaced(double angle, const Vec3& shift) {
  return Eigen::AngleAxisd(-angle * one_degree, Vec3::UnitZ()) * shift - shift;
}

// A turn in 3.6 s: the axis is displaced, has a pitch error of twelve periods, and the servos follow late.
BallTurn turn_of_c(const TurnedBall& set, const Vec3& shift, double pitch, const Vec3& following) {
  constexpr int steps = 7200;
  BallTurn turn;
  turn.speed = 2 * std::numbers::pi / (steps * turn.interval);
  for (int i = 0; i <= steps; ++i) {
    BallSample sample;
    sample.turned = sample.angles[c_angle] = 360.0 * i / steps;
    sample.place = set.model.machine_from_tip(set.ball, sample.angles, set.tool_length);
    const Vec3 tangent = Eigen::AngleAxisd(-sample.turned * one_degree, Vec3::UnitZ()) * Vec3(0, -1, 0);
    sample.following = following;
    sample.deviation = displaced(sample.turned, shift) + following +
                       tangent * pitch * std::sin(12 * sample.turned * one_degree);
    turn.samples.push_back(sample);
  }
  return turn;
}

double located(const AxisLocation& location, const std::string& name) {
  for (const auto& error : location.errors)
    if (error.name == name) return error.value;
  ADD_FAILURE() << name << " is not among the results";
  return 0;
}

TEST(RTest, FindsTheAxisInATurnLessTheServos) {
  const auto set = ball_on_table();
  const Vec3 shift(12e-3, -7e-3, 0), following(3e-3, 0, 1e-3);
  const auto turn = turn_of_c(set, shift, 0, following);
  const auto result = evaluate_turn(set, turn, {});
  ASSERT_EQ(result.cleaned.size(), turn.samples.size());
  for (std::size_t i = 0; i < result.cleaned.size(); i += 100)
    EXPECT_LT((result.cleaned[i] - displaced(result.angles[i], shift)).norm(), 1e-5) << i;
  EXPECT_TRUE(result.pitch.empty());
  EXPECT_NEAR(located(result.location, "XOC"), 12e-3, 1e-5);
  EXPECT_NEAR(located(result.location, "YOC"), -7e-3, 1e-5);
  // The circle of the deviations has the shift as its radius.
  EXPECT_NEAR(span_of(result.read).x(), 2 * shift.norm(), 1e-5);
  EXPECT_EQ(span_of({}).norm(), 0);
}

// Twelve periods in 3.6 s are 3.3 Hz: a filter of 20 Hz leaves 1 / sqrt(1 + (3.3 / 20)^2) = 0.987 of 2 um.
TEST(RTest, FindsThePitchErrorOfAWholeTurn) {
  const auto set = ball_on_table();
  const Vec3 shift(12e-3, -7e-3, 0);
  const auto result = evaluate_turn(set, turn_of_c(set, shift, 2e-3, Vec3::Zero()), {});
  const auto twelfth =
      std::find_if(result.pitch.begin(), result.pitch.end(), [](const auto& h) { return h.order == 12; });
  ASSERT_NE(twelfth, result.pitch.end());
  EXPECT_NEAR(twelfth->amplitude, 1.97e-3, 0.2e-3);
  EXPECT_NEAR(located(result.location, "XOC"), 12e-3, 0.5e-3);
}

TEST(RTest, FindsTheAxisAtStops) {
  const auto set = ball_on_table();
  const Vec3 shift(12e-3, -7e-3, 0);
  std::vector<BallSample> stops(72);
  for (std::size_t k = 0; k < stops.size(); ++k) {
    stops[k].angles[c_angle] = 5.0 * static_cast<double>(k);
    stops[k].deviation = displaced(stops[k].angles[c_angle], shift);
  }
  const auto location = locate_from_stops(set, stops);
  EXPECT_NEAR(located(location, "XOC"), 12e-3, 1e-6);
  EXPECT_NEAR(located(location, "YOC"), -7e-3, 1e-6);
}

// Static less dynamic is 0, 1 and 2 um, whose standard deviation is 1 um.
TEST(RTest, ComparesWithStopsBetweenTheSamples) {
  std::vector<double> angles;
  std::vector<Vec3> dynamic;
  for (int i = 0; i <= 10; ++i) {
    angles.push_back(i);
    dynamic.emplace_back(1e-3 * i, 0, 0);
  }
  std::vector<BallSample> stops(3);
  for (std::size_t k = 0; k < stops.size(); ++k) {
    stops[k].turned = 2.5 * static_cast<double>(k + 1);
    stops[k].deviation = Vec3(1e-3 * stops[k].turned + 1e-3 * static_cast<double>(k), 0, 0);
  }
  EXPECT_LT((dynamic_less_static(angles, dynamic, stops) - Vec3(1e-3, 0, 0)).norm(), 1e-9);
  stops.resize(1);
  EXPECT_EQ(dynamic_less_static(angles, dynamic, stops).norm(), 0);
}

// The reversal error is what differs between the approaches.
TEST(TrueTips, DependOnTheDirectionOfTheNewestMotion) {
  const auto parameters = DrawnMachine::parameters_of("ac-table");
  const auto outline = machine::outline_of(parameters, 0);
  const auto errors =
      truth::parse_truth("axes:\n  X: {EXX: [{reversal_um: -4}]}\n", "truth.yaml", outline).geometry;
  const truth::PoseReport report(truth::make_geometry(errors, outline, "truth.yaml"),
                                 machine::make_chain(parameters, 0), outline);
  ChannelMotion motion;
  motion.traces[0].setpoint = motion.traces[0].load = {0, 1, 2, 2, 1};
  motion.count = motion.traces[0].setpoint.size();
  const auto tips = true_tips(motion, report);
  ASSERT_EQ(tips.size(), 5u);
  EXPECT_NEAR(std::abs(tips[1].x() - tips[4].x()), 4e-3, 1e-9);
  EXPECT_NEAR(tips[2].x(), tips[3].x(), 1e-12) << "at rest the direction stays";
}

}  // namespace
}  // namespace trunnion::identification
