// SPDX-License-Identifier: Apache-2.0
#include "machine_tests/sampled_motion.hpp"

#include <stdexcept>
#include <string_view>
#include <utility>

#include "canonical/axes.hpp"
#include "identification/circle_test.hpp"
#include "machine_tests/test_requests.hpp"

namespace trunnion::machine_tests {

using canonical::axis_letters;
using servo_analysis::ChannelMotion;

ChannelMotion run_sampled(ServoSession& session, const std::string& program, const std::string& sampled,
                          std::uint16_t decimation) {
  std::vector<std::uint16_t> numbers;
  ChannelMotion motion;
  for (const auto& axis : session.axes()) {
    const auto index = axis_letters.find(axis.letter);
    if (index == std::string_view::npos) continue;
    motion.resting[index] = axis.place;
    if (sampled.find(axis.letter) != std::string::npos) numbers.push_back(axis.number);
  }
  auto result = session.run(samples_of(numbers, decimation), program);
  if (result.traces.size() != numbers.size() || result.traces.front().size() < 2)
    throw std::runtime_error("the drive gave no samples of the motion");
  motion.interval = result.traces.front().interval;
  motion.count = result.traces.front().size();
  for (std::size_t k = 0; k < numbers.size(); ++k)
    for (const auto& axis : session.axes())
      if (axis.number == numbers[k])
        motion.traces[axis_letters.find(axis.letter)] = std::move(result.traces[k]);
  return motion;
}

geometry::Vec3 linear_place(const ServoSession& session) {
  geometry::Vec3 place = geometry::Vec3::Zero();
  for (const auto& axis : session.axes())
    if (axis.letter >= 'X' && axis.letter <= 'Z') place[axis.letter - 'X'] = axis.place;
  return place;
}

std::array<servo_analysis::TestedAxis, 3> linear_axes(const ServoSession& session) {
  return {session.axis("X"), session.axis("Y"), session.axis("Z")};
}

ChannelMotion run_circle(ServoSession& session, const circular_tests::CircleMotion& circle) {
  constexpr std::uint16_t decimation = 8;  // one sample in a cycle of 1 ms
  identification::check_circle(circle, linear_axes(session));
  std::vector<std::pair<char, double>> after;
  for (const auto& axis : session.axes())
    if (axis.letter >= 'X' && axis.letter <= 'Z') after.emplace_back(axis.letter, axis.place);
  return run_sampled(session, circular_tests::circle_program(circle, after), "XYZ", decimation);
}

}  // namespace trunnion::machine_tests
