// SPDX-License-Identifier: Apache-2.0
#include "machine/pose_lines.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <sstream>
#include <stdexcept>

#include "machine/kinematics.hpp"
#include "machine/parameter_constants.hpp"

namespace trunnion::machine {
namespace {

constexpr char rotary_letters[] = "ABCUVW";

double number(const std::string& word, std::size_t from) {
  double value = 0;
  const char* first = word.data() + from;
  const char* last = word.data() + word.size();
  if (last - first > 1 && *first == '+' && first[1] != '-') ++first;
  const auto [end, error] = std::from_chars(first, last, value);
  if (error != std::errc() || end != last || !std::isfinite(value))
    throw std::runtime_error("'" + word + "' is not a number");
  if (std::abs(value) > 1e9) throw std::runtime_error("'" + word + "' is beyond 1e9");
  return value;
}

void append(std::string& text, double value) {
  char out[340];
  std::snprintf(out, sizeof out, "%.12f", value);
  // No sign on what is zero to 12 decimals.
  const char* shown = std::string_view(out) == "-0.000000000000" ? out + 1 : out;
  if (!text.empty()) text += ' ';
  text += shown;
}

}  // namespace

PoseLines::PoseLines(const Parameters& parameters, std::uint16_t channel, double tool_length)
    : chain_(make_chain(parameters, channel)),
      solver_(chain_),
      travels_(rotary_travels(parameters, channel)),
      tool_length_(tool_length) {
  // The chain counts from the workpiece to the tool: the table from its end to the base, then the head.
  const auto digits = [&](const IntegerParameter& parameter) {
    return std::to_string(parameters.integer(parameter, channel));
  };
  for (const auto& side : {digits(parameter::head_type), digits(parameter::table_type)})
    if (side != "0")
      for (const char digit : side) order_.push_back(static_cast<std::size_t>(digit - '3'));
}

std::string PoseLines::letters() const {
  std::string text;
  for (const auto axis : order_) text += rotary_letters[axis];
  return text;
}

std::vector<double> PoseLines::numbers(const std::string& line, std::size_t fixed, std::size_t rotary,
                                       geometry::Angles& angles) const {
  std::vector<double> values;
  std::vector<bool> given(geometry::angle_count);
  std::size_t count = 0;
  std::istringstream words(line);
  for (std::string word; words >> word; ++count) {
    const auto letter = std::string_view(rotary_letters).find(word[0]);
    if (count < fixed || letter == std::string_view::npos) {
      values.push_back(number(word, 0));
      continue;
    }
    if (std::find(order_.begin(), order_.end(), letter) == order_.end() || given[letter])
      throw std::runtime_error("'" + word + "': the rotary axes are " + letters() + ", each once");
    given[letter] = true;
    angles[letter] = number(word, 1);
  }
  if (count != fixed + rotary)
    throw std::runtime_error("expected " + std::to_string(fixed + rotary) + " numbers" +
                             (rotary > 0 ? " (rotary axes " + letters() + ")" : "") + ", there are " +
                             std::to_string(count));
  std::size_t next = fixed;
  for (const auto axis : order_)
    if (rotary > 0 && !given[axis]) angles[axis] = values[next++];
  return values;
}

PoseLines::Answer PoseLines::orient(const std::string& line) const {
  geometry::OrientationRequest request;
  geometry::Angles none{};
  const auto values = numbers(line, 3, 0, none);
  request.direction = {values[0], values[1], values[2]};
  request.travel = travels_;
  std::vector<geometry::Orientation> solutions(geometry::OrientationSolver::most_solutions);
  geometry::OrientationAnswer found;
  solutions.resize(solver_.all(request, solutions, found));
  if (found.status == geometry::OrientationStatus::not_a_direction)
    throw std::runtime_error("the tool direction is zero");
  Answer answer;
  const double length = request.direction.stableNorm();
  char text[160];
  if (std::abs(length - 1) > 1e-4) {
    std::snprintf(text, sizeof text, "the tool direction is %.6g long and is normalized", length);
    answer.warning = text;
  }
  for (const auto& solution : solutions)
    for (const auto axis : order_) append(answer.text, solution.angles[axis]);
  if (!solutions.empty()) return answer;
  answer.text = "none";
  if (found.status == geometry::OrientationStatus::unreachable) {
    std::snprintf(text, sizeof text,
                  "the machine does not reach this direction; the nearest is %.9f %.9f %.9f",
                  found.nearest.x(), found.nearest.y(), found.nearest.z());
    answer.warning = text;
  } else {
    answer.warning = "a rotary axis would leave its travel";
  }
  return answer;
}

PoseLines::Answer PoseLines::answer(Direction direction, const std::string& line) const {
  if (direction == Direction::orient) return orient(line);
  geometry::Angles angles{};
  const auto values = numbers(line, 3, order_.size(), angles);
  const geometry::Vec3 place(values[0], values[1], values[2]);
  Answer answer;
  const auto add = [&](const geometry::Vec3& v) {
    for (const double value : v) append(answer.text, value);
  };
  if (direction == Direction::inverse) {
    const auto machine = chain_.machine_from_tip(place, angles, tool_length_);
    if (machine == geometry::Vec3::Constant(geometry::Chain::no_position))
      throw std::runtime_error("X, Y and Z lie in one plane at these angles: there is no position");
    add(machine);
  } else {
    add(chain_.tip_from_machine(place, angles, tool_length_));
    add(chain_.tool_direction_in_workpiece(angles));
  }
  return answer;
}

}  // namespace trunnion::machine
