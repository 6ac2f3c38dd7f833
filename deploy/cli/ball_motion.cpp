// SPDX-License-Identifier: Apache-2.0
#include "ball_motion.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "canonical/axes.hpp"
#include "figures.hpp"
#include "geometry/angle.hpp"
#include "machine/kinematics.hpp"
#include "metrology/axis_of_rotation.hpp"
#include "servo_analysis/servo_response.hpp"

namespace trunnion::cli {
namespace {

using canonical::axis_letters;
constexpr std::uint16_t turn_decimation = 4, stop_decimation = 40;  // 2 kHz, 200 Hz
constexpr double positioning_feed = 3000;                           // mm/min or deg/min
constexpr double still = 1e-6;                                      // deg between two samples
constexpr double rest_time = 0.2, mean_time = 0.1;                  // s
constexpr double near_ball = 1;  // mm: more than compensations move an axis
constexpr double share_of_travel = 0.9;
constexpr double moves = 0.02;  // of the largest speed of an axis: slower axes have no servo to identify

geometry::Chain chain_of(const ServoSession& session, std::uint16_t channel) {
  return machine::make_chain(session.parameters(), channel);
}

Vec3 perpendicular(const Vec3& axis) {
  const Vec3 x = Vec3::UnitX() - axis * axis.x();
  return x.norm() > 0.5 ? Vec3(x.normalized()) : Vec3((Vec3::UnitY() - axis * axis.y()).normalized());
}

}  // namespace

BallTest::BallTest(ServoSession& session, const BallOptions& options)
    : session_(session),
      options_(options),
      machine_(load_true_machine(session.machine_directory(), options.channel, {})),
      model_(chain_of(session, options.channel)) {
  const auto& axis = session_.axis(options_.axis);
  axis_ = axis_letters.find(axis.letter);
  if (axis_ == std::string_view::npos || axis_ < 3 || !model_.turns(axis_ - 3))
    throw std::runtime_error("--axis " + options_.axis + ": no rotary axis of the transformation");
  for (const auto& a : session_.axes())
    if (const auto index = axis_letters.find(a.letter); index > 2 && index < axis_letters.size())
      held_[index - 3] = a.place;
  for (const auto& word : options_.hold) {
    const auto index = word.empty() ? std::string_view::npos : axis_letters.find(word[0]);
    std::size_t used = 0;
    double value = 0;
    try {
      value = std::stod(word.substr(std::min<std::size_t>(1, word.size())), &used);
    } catch (const std::exception&) {
    }
    if (index == std::string_view::npos || index < 3 || !model_.turns(index - 3) || index == axis_ ||
        used + 1 != word.size())
      throw std::runtime_error("--hold " + word + ": expected another rotary axis and its angle, as A-30");
    held_[index - 3] = value;
  }
  tool_length_ = session_.tool_length(options_.tool);
  const double low = axis.low, high = axis.high;
  const bool endless = !(high - low < 360);
  sweep_ = options_.sweep.value_or(endless ? 360 : share_of_travel * (high - low));
  start_ = options_.start.value_or(endless ? 0 : low + (high - low) * (1 - share_of_travel) / 2);
  if (!endless && (start_ < low || start_ > high || start_ + sweep_ < low || start_ + sweep_ > high))
    throw std::runtime_error(text("axis %c cannot turn from %.3f to %.3f deg: its travel is %.3f .. %.3f",
                                  axis.letter, start_, start_ + sweep_, low, high));
  find_circle();
  check_travel(start_);
  auto report = std::make_unique<truth::PoseReport>(machine_.report->geometry(), model_, machine_.outline);
  report->tool_length = tool_length_;
  report->temperatures = machine_.report->temperatures;
  machine_.report = std::move(report);
  sensor_.emplace(options_.source == "true" ? instrument(machine_, "rtest") : truth::InstrumentTruth{});
}

geometry::Angles BallTest::angles_at(double angle) const {
  auto angles = held_;
  angles[axis_ - 3] = angle;
  return angles;
}

Vec3 BallTest::place_at(double angle) const {
  return model_.machine_from_tip(ball_, angles_at(angle), tool_length_);
}

// A table's axis carries the ball about it: the ball is at the radius asked for. A head turns about its own
// axis, and its length is the radius.
void BallTest::find_circle() {
  const auto circle = [&] {
    std::vector<metrology::TurnedCentre> places;
    const double range = std::min(std::abs(sweep_), 300.0);
    for (int k = 0; k < 7; ++k) places.push_back({start_ + range * k / 6, place_at(start_ + range * k / 6)});
    const auto fit = metrology::fit_axis(places);
    if (const auto* error = std::get_if<metrology::AxisError>(&fit))
      throw std::runtime_error("--axis " + options_.axis +
                               ": the ball has no circle about the axis: " + metrology::to_string(*error));
    const auto& found = std::get<metrology::AxisFit>(fit);
    direction_ = found.direction, centre_ = found.centre, radius_ = found.radius;
  };
  const auto& design = machine_.outline.design;
  Vec3 point = Vec3::Zero();
  std::optional<Vec3> direction;
  // The points of the axes of a table, from the workpiece outwards: v2, v2 + v1, v2 + v1 + v0.
  for (const auto* table : {&design.table_2, &design.table_1, &design.table_0}) {
    if (!*table || direction) continue;
    point += (*table)->offset + (*table)->correction;
    if ((*table)->angle == axis_ - 3) direction = (*table)->direction.normalized();
  }
  if (!options_.ball.empty()) {
    ball_ = coordinates("--ball", options_.ball);
  } else if (direction) {
    // Beside an axis along the tool, above an axis across it.
    const Vec3 tool = model_.tool_direction(), across = tool - *direction * direction->dot(tool);
    ball_ = across.norm() > 0.5
                ? Vec3(point + across.normalized() * options_.radius)
                : Vec3(point + perpendicular(*direction) * options_.radius + tool * options_.height);
  } else {
    Vec3 here = Vec3::Zero();
    for (const auto& a : session_.axes())
      if (a.letter >= 'X' && a.letter <= 'Z') here[a.letter - 'X'] = a.place;
    ball_ = model_.tip_from_machine(here, angles_at(start_), tool_length_);
  }
  circle();
}

void BallTest::check_travel(double start) const {
  for (int k = 0; k <= 72; ++k) {
    const double angle = start + sweep_ * k / 72;
    const Vec3 place = place_at(angle);
    for (int i = 0; i < 3; ++i) {
      const auto& a = session_.axis(std::string(1, static_cast<char>('X' + i)));
      if (place[i] >= a.low && place[i] <= a.high) continue;
      throw std::runtime_error(
          text("axis %c would go to %.3f mm at %c%.1f, its travel is %.3f .. %.3f: choose "
               "--ball, --radius, --start or --sweep",
               a.letter, place[i], options_.axis[0], angle, a.low, a.high));
    }
  }
}

// To the ball with the axes as they stand then, tool tip control on.
std::string BallTest::opening(double start) const {
  const auto angles = angles_at(start);
  const Vec3 place = place_at(start);
  std::string program = "G17 G90 G94\nG53 G1";
  for (const auto& a : session_.axes())
    if (const auto index = axis_letters.find(a.letter); index > 2 && index < axis_letters.size())
      program += text(" %c%.6f", a.letter, angles[index - 3]);
  program += text(" F%g\nG53 G1 X%.6f Y%.6f Z%.6f F%g\nG43.4 H%u\nG4 P500\n", positioning_feed, place[0],
                  place[1], place[2], positioning_feed, options_.tool);
  return program;
}

std::string BallTest::closing() const {
  std::string program = text("G4 P500\nG49\nG53 G1");
  for (const auto& a : session_.axes())
    if (a.letter >= 'X' && a.letter <= 'Z') program += text(" %c%.6f", a.letter, a.place);
  program += text(" F%g\nG53 G1", positioning_feed);
  for (const auto& a : session_.axes())
    if (const auto index = axis_letters.find(a.letter); index > 2 && index < axis_letters.size())
      program += text(" %c%.6f", a.letter, a.place);
  return program + text(" F%g\nM30\n", positioning_feed);
}

ChannelMotion BallTest::sampled(const std::string& program, std::uint16_t decimation) {
  auto motion = run_sampled(session_, program, "XYZ" + options_.axis, decimation);
  std::copy(held_.begin(), held_.end(), motion.resting.begin() + 3);
  return motion;
}

BallMotion BallTest::run(double feed, double start) {
  check_travel(start);
  const auto& axis = session_.axis(options_.axis);
  const double turning = feed / radius_ * 180 / std::numbers::pi;  // deg/min
  if (turning > axis.highest_feed)
    throw std::runtime_error(text("--feed %g: axis %c would turn with %.0f deg/min, its limit is %.0f", feed,
                                  axis.letter, turning, axis.highest_feed));
  const char letter = axis.letter;
  auto program = opening(start);
  // Incremental: a table that counts modulo 360 would not turn for its own angle.
  program += text("G91 G1 %c%.6f F%.6f\nG4 P500\nG1 %c%.6f\nG90\n", letter, sweep_, turning, letter, -sweep_);
  const auto motion = sampled(program + closing(), turn_decimation);
  BallMotion result;
  const auto samples = read(motion, &result.servos);
  result.there = cut(samples, motion.interval, sweep_ > 0 ? 1 : -1);
  result.back = cut(samples, motion.interval, sweep_ > 0 ? -1 : 1);
  return result;
}

// The linear axes have put the tip into the ball: tool tip control has begun.
bool BallTest::at_ball(const ChannelMotion& motion, const BallSample& sample, std::size_t i) {
  for (std::size_t k = 0; k < 3; ++k)
    if (std::abs(motion.commanded(k, i) - sample.place[static_cast<Eigen::Index>(k)]) > near_ball)
      return false;
  return true;
}

std::vector<BallSample> BallTest::read(const ChannelMotion& motion, std::vector<ServoOfAxis>* servos) {
  const auto tips = options_.source == "true" ? true_tips(motion, *machine_.report) : std::vector<Vec3>{};
  std::array<std::vector<double>, truth::axis_count> predicted;
  if (servos != nullptr) {
    double fastest = 0;
    std::array<double, truth::axis_count> speeds{};
    for (std::size_t axis = 0; axis < truth::axis_count; ++axis) {
      for (const double v : motion.traces[axis].speed) speeds[axis] = std::max(speeds[axis], std::abs(v));
      // Of a rotary axis: the speed of the ball on its circle.
      if (axis > 2) speeds[axis] *= radius_ * geometry::radians_per_degree;
      fastest = std::max(fastest, speeds[axis]);
    }
    for (std::size_t axis = 0; axis < truth::axis_count; ++axis) {
      const auto& trace = motion.traces[axis];
      if (trace.size() == 0 || speeds[axis] < moves * fastest) continue;
      ServoOfAxis servo{axis_letters[axis], servo_analysis::fit_servo_response(trace), 0};
      predicted[axis] = servo_analysis::predicted_positions(servo.response, trace.setpoint, trace.interval);
      for (std::size_t i = 0; i < trace.size(); ++i)
        servo.prediction_error += std::pow(predicted[axis][i] - trace.feedback[i], 2);
      servo.prediction_error = std::sqrt(servo.prediction_error / static_cast<double>(trace.size()));
      servos->push_back(servo);
    }
  }
  const auto nest = truth::Nest::at(Vec3::Zero());
  std::vector<BallSample> samples(motion.count);
  double turned = 0;
  for (std::size_t i = 0; i < motion.count; ++i) {
    auto& s = samples[i];
    geometry::Angles real{}, model_angles{};
    Vec3 at, model_at;
    for (std::size_t axis = 0; axis < truth::axis_count; ++axis) {
      const double modelled = predicted[axis].empty() ? motion.commanded(axis, i) : predicted[axis][i];
      if (axis < 3) {
        const auto k = static_cast<Eigen::Index>(axis);
        at[k] = motion.feedback(axis, i), model_at[k] = modelled;
      } else {
        s.angles[axis - 3] = motion.commanded(axis, i);
        real[axis - 3] = motion.feedback(axis, i), model_angles[axis - 3] = modelled;
      }
    }
    if (i > 0) {
      const double step = s.angles[axis_ - 3] - samples[i - 1].angles[axis_ - 3];
      turned += step - 360 * std::round(step / 360);
    }
    s.turned = turned;
    s.place = model_.machine_from_tip(ball_, s.angles, tool_length_);
    const Vec3 tip = tips.empty() ? model_.tip_from_machine(at, real, tool_length_) : tips[i];
    auto sensors = nest.readings(model_.machine_from_tip(tip, s.angles, tool_length_) - s.place);
    for (double& reading : sensors) reading = sensor_->read(reading);
    s.deviation = nest.place(sensors);
    if (servos != nullptr) {
      Vec3 commanded;
      for (std::size_t k = 0; k < 3; ++k) commanded[static_cast<Eigen::Index>(k)] = motion.commanded(k, i);
      const Vec3 lagging = model_.tip_from_machine(model_at, model_angles, tool_length_);
      s.following = model_.machine_from_tip(lagging, s.angles, tool_length_) - commanded;
    }
  }
  return samples;
}

// The first motion of the axis by the whole sweep in this sense, after a rest.
BallTurn BallTest::cut(const std::vector<BallSample>& samples, double interval, int sense) const {
  const auto moves_at = [&](std::size_t i) {
    return i > 0 && std::abs(samples[i].turned - samples[i - 1].turned) > still;
  };
  const auto rest = static_cast<std::size_t>(rest_time / interval);
  std::size_t begin = 0;
  while (begin < samples.size()) {
    while (begin < samples.size() && !moves_at(begin)) ++begin;
    std::size_t end = begin;
    std::size_t quiet = 0;
    while (end < samples.size() && quiet < rest) quiet = moves_at(end) ? 0 : quiet + 1, ++end;
    const std::size_t last = end - quiet;
    if (begin == 0 || last <= begin) break;
    const double way = samples[last - 1].turned - samples[begin - 1].turned;
    if (begin > rest && std::abs(way - sense * std::abs(sweep_)) < 0.01) {
      BallTurn turn;
      turn.interval = interval;
      turn.samples.assign(samples.begin() + static_cast<std::ptrdiff_t>(begin - 1),
                          samples.begin() + static_cast<std::ptrdiff_t>(last));
      const auto middle = turn.samples.size() / 2;
      turn.speed = (turn.samples[middle].turned - turn.samples[middle - 1].turned) / interval *
                   geometry::radians_per_degree;
      Vec3 sum = Vec3::Zero(), squares = Vec3::Zero();
      for (std::size_t i = begin - rest; i < begin - 1; ++i) {
        sum += samples[i].deviation, squares += samples[i].deviation.cwiseAbs2();
      }
      const auto n = static_cast<double>(rest - 1);
      turn.noise = (squares / n - (sum / n).cwiseAbs2()).cwiseMax(0).cwiseSqrt();
      return turn;
    }
    begin = end;
  }
  throw std::runtime_error(text("axis %s has not turned by %.1f deg between two rests", options_.axis.c_str(),
                                sense * std::abs(sweep_)));
}

std::vector<BallSample> BallTest::stop(std::size_t stops, double start) {
  check_travel(start);
  const char letter = options_.axis[0];
  auto program = opening(start);
  program += "G91\n";
  for (std::size_t k = 0; k < stops; ++k)
    program += text("G1 %c%.6f F%g\nG4 P400\n", letter, k == 0 ? 0.0 : sweep_ / static_cast<double>(stops),
                    positioning_feed);
  const auto motion = sampled(program + "G90\n" + closing(), stop_decimation);
  const auto samples = read(motion, nullptr);
  const auto mean = static_cast<std::size_t>(mean_time / motion.interval);
  const auto rest = static_cast<std::size_t>(rest_time / motion.interval);
  std::vector<BallSample> means;
  std::size_t quiet = 0;
  for (std::size_t i = 1; i < samples.size() && means.size() < stops; ++i) {
    const bool moves = std::abs(samples[i].turned - samples[i - 1].turned) > still ||
                       (samples[i].place - samples[i - 1].place).norm() > 0;
    const double wanted = sweep_ * static_cast<double>(means.size()) / static_cast<double>(stops);
    const double at = samples[i].angles[axis_ - 3] - start - wanted;
    quiet = moves || std::abs(at - 360 * std::round(at / 360)) > 1e-3 || !at_ball(motion, samples[i], i)
                ? 0
                : quiet + 1;
    if (quiet < rest) continue;
    BallSample sample = samples[i];
    sample.deviation.setZero();
    for (std::size_t k = i + 1 - mean; k <= i; ++k)
      sample.deviation += samples[k].deviation / static_cast<double>(mean);
    sample.turned = wanted;
    means.push_back(sample);
    quiet = 0;
  }
  if (means.size() != stops) throw std::runtime_error("the axis did not come to rest at every stop");
  return means;
}

}  // namespace trunnion::cli
