// SPDX-License-Identifier: Apache-2.0
#include "ball_motion.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "canonical/axes.hpp"
#include "figures.hpp"
#include "identification/true_tips.hpp"
#include "machine/kinematics.hpp"
#include "metrology/axis_of_rotation.hpp"

namespace trunnion::cli {
namespace {

using canonical::axis_letters;
constexpr std::uint16_t turn_decimation = 4, stop_decimation = 40;  // 2 kHz, 200 Hz
constexpr double positioning_feed = 3000;                           // mm/min or deg/min
constexpr double share_of_travel = 0.9;

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
      set_{machine_.outline, chain_of(session, options.channel)} {
  const auto& axis = session_.axis(options_.axis);
  set_.axis = axis_letters.find(axis.letter);
  if (set_.axis == std::string_view::npos || set_.axis < 3 || !set_.model.turns(set_.axis - 3))
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
    if (index == std::string_view::npos || index < 3 || !set_.model.turns(index - 3) || index == set_.axis ||
        used + 1 != word.size())
      throw std::runtime_error("--hold " + word + ": expected another rotary axis and its angle, as A-30");
    held_[index - 3] = value;
  }
  set_.tool_length = session_.tool_length(options_.tool);
  const double low = axis.low, high = axis.high;
  const bool endless = !(high - low < 360);
  set_.sweep = options_.sweep.value_or(endless ? 360 : share_of_travel * (high - low));
  start_ = options_.start.value_or(endless ? 0 : low + (high - low) * (1 - share_of_travel) / 2);
  if (!endless && (start_ < low || start_ > high || start_ + set_.sweep < low || start_ + set_.sweep > high))
    throw std::runtime_error(text("axis %c cannot turn from %.3f to %.3f deg: its travel is %.3f .. %.3f",
                                  axis.letter, start_, start_ + set_.sweep, low, high));
  find_circle();
  check_travel(start_);
  auto report =
      std::make_unique<truth::PoseReport>(machine_.report->geometry(), set_.model, machine_.outline);
  report->tool_length = set_.tool_length;
  report->temperatures = machine_.report->temperatures;
  machine_.report = std::move(report);
  sensor_.emplace(options_.source == "true" ? instrument(machine_, "rtest") : truth::InstrumentTruth{});
}

geometry::Angles BallTest::angles_at(double angle) const {
  auto angles = held_;
  angles[set_.axis - 3] = angle;
  return angles;
}

Vec3 BallTest::place_at(double angle) const {
  return set_.model.machine_from_tip(set_.ball, angles_at(angle), set_.tool_length);
}

// A table's axis carries the ball about it: the ball is at the radius asked for. A head turns about its own
// axis, and its length is the radius.
void BallTest::find_circle() {
  const auto circle = [&] {
    std::vector<metrology::TurnedCentre> places;
    const double range = std::min(std::abs(set_.sweep), 300.0);
    for (int k = 0; k < 7; ++k) places.push_back({start_ + range * k / 6, place_at(start_ + range * k / 6)});
    const auto fit = metrology::fit_axis(places);
    if (const auto* error = std::get_if<metrology::AxisError>(&fit))
      throw std::runtime_error("--axis " + options_.axis +
                               ": the ball has no circle about the axis: " + metrology::to_string(*error));
    const auto& found = std::get<metrology::AxisFit>(fit);
    set_.direction = found.direction, set_.centre = found.centre, set_.radius = found.radius;
  };
  const auto& design = machine_.outline.design;
  Vec3 point = Vec3::Zero();
  std::optional<Vec3> direction;
  // The points of the axes of a table, from the workpiece outwards: v2, v2 + v1, v2 + v1 + v0.
  for (const auto* table : {&design.table_2, &design.table_1, &design.table_0}) {
    if (!*table || direction) continue;
    point += (*table)->offset + (*table)->correction;
    if ((*table)->angle == set_.axis - 3) direction = (*table)->direction.normalized();
  }
  if (!options_.ball.empty()) {
    set_.ball = coordinates("--ball", options_.ball);
  } else if (direction) {
    // Beside an axis along the tool, above an axis across it.
    const Vec3 tool = set_.model.tool_direction(), across = tool - *direction * direction->dot(tool);
    set_.ball = across.norm() > 0.5
                    ? Vec3(point + across.normalized() * options_.radius)
                    : Vec3(point + perpendicular(*direction) * options_.radius + tool * options_.height);
  } else {
    Vec3 here = Vec3::Zero();
    for (const auto& a : session_.axes())
      if (a.letter >= 'X' && a.letter <= 'Z') here[a.letter - 'X'] = a.place;
    set_.ball = set_.model.tip_from_machine(here, angles_at(start_), set_.tool_length);
  }
  circle();
}

void BallTest::check_travel(double start) const {
  for (int k = 0; k <= 72; ++k) {
    const double angle = start + set_.sweep * k / 72;
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
  const double turning = feed / set_.radius * 180 / std::numbers::pi;  // deg/min
  if (turning > axis.highest_feed)
    throw std::runtime_error(text("--feed %g: axis %c would turn with %.0f deg/min, its limit is %.0f", feed,
                                  axis.letter, turning, axis.highest_feed));
  const char letter = axis.letter;
  auto program = opening(start);
  // Incremental: a table that counts modulo 360 would not turn for its own angle.
  program += text("G91 G1 %c%.6f F%.6f\nG4 P500\nG1 %c%.6f\nG90\n", letter, set_.sweep, turning, letter,
                  -set_.sweep);
  const auto motion = sampled(program + closing(), turn_decimation);
  auto predicted = identification::predict_servos(motion, set_.radius);
  const auto samples = read(motion, &predicted);
  const double way = set_.sweep > 0 ? std::abs(set_.sweep) : -std::abs(set_.sweep);
  BallMotion result;
  result.servos = std::move(predicted.servos);
  result.there = turned_by(way, samples, motion.interval);
  result.back = turned_by(-way, samples, motion.interval);
  return result;
}

std::vector<BallSample> BallTest::read(const ChannelMotion& motion,
                                       const identification::PredictedMotion* predicted) {
  const auto tips =
      options_.source == "true" ? identification::true_tips(motion, *machine_.report) : std::vector<Vec3>{};
  return identification::read_ball(set_, motion, tips, *sensor_, predicted);
}

identification::BallTurn BallTest::turned_by(double way, const std::vector<BallSample>& samples,
                                             double interval) const {
  auto turn = identification::turn_between_rests(samples, interval, way);
  if (!turn)
    throw std::runtime_error(
        text("axis %s has not turned by %.1f deg between two rests", options_.axis.c_str(), way));
  return *std::move(turn);
}

std::vector<BallSample> BallTest::stop(std::size_t stops, double start) {
  check_travel(start);
  const char letter = options_.axis[0];
  auto program = opening(start);
  program += "G91\n";
  for (std::size_t k = 0; k < stops; ++k)
    program += text("G1 %c%.6f F%g\nG4 P400\n", letter,
                    k == 0 ? 0.0 : set_.sweep / static_cast<double>(stops), positioning_feed);
  const auto motion = sampled(program + "G90\n" + closing(), stop_decimation);
  const auto samples = read(motion, nullptr);
  auto means = identification::means_at_stops(set_, samples, motion.interval, start, stops);
  if (means.size() != stops) throw std::runtime_error("the axis did not come to rest at every stop");
  return means;
}

}  // namespace trunnion::cli
