// SPDX-License-Identifier: Apache-2.0
#include "channel_motion.hpp"

#include <stdexcept>

#include "canonical/axes.hpp"
#include "recording/file_stream.hpp"
#include "report/captured_motion.hpp"
#include "servo_test_parts.hpp"

namespace trunnion::cli {
namespace {

using canonical::axis_letters;

}  // namespace

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

ChannelMotion motion_of_recording(const std::string& file, std::uint16_t channel,
                                  machine::Parameters& parameters) {
  recording::FileSource source(file);
  const auto capture = report::read_capture(source, channel);
  if (capture.damaged) throw std::runtime_error(file + ": " + capture.problem);
  if (!capture.has_parameters) throw std::runtime_error(file + ": no parameters: " + capture.problem);
  if (capture.path.empty() || capture.actual.width == 0)
    throw std::runtime_error(file + ": no motion of channel " + std::to_string(channel) +
                             ": record the topics path_frame and feedback_frame");
  parameters = capture.tables.parameters;
  return report::motion_of(capture, channel);
}

}  // namespace trunnion::cli
