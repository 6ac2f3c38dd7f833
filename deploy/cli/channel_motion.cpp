// SPDX-License-Identifier: Apache-2.0
#include "channel_motion.hpp"

#include <algorithm>

#include "canonical/axes.hpp"
#include "geometry/types.hpp"
#include "machine/axes.hpp"
#include "machine/kinematics.hpp"
#include "machine/parameter_constants.hpp"
#include "recording/file_stream.hpp"
#include "report/capture.hpp"
#include "servo_test_parts.hpp"

namespace trunnion::cli {
namespace {

using canonical::axis_letters;
// mm or deg: commanded motions that are shorter have no direction.
constexpr double least_motion = 1e-7;

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
  const auto chain = machine::make_chain(parameters, channel);
  const auto axes = machine::channel_axes(parameters, channel);
  const auto drive = machine::drive_axes(parameters);
  ChannelMotion motion;
  motion.interval = parameters.get(parameter::interpolation_cycle, 0) * 1e-6;
  std::size_t next = 0;
  for (const auto& row : capture.path) {
    while (next < capture.actual.cycles.size() && capture.actual.cycles[next] < row.cycle) ++next;
    if (next == capture.actual.cycles.size()) break;
    if (capture.actual.cycles[next] != row.cycle) continue;
    auto commanded = row.position;
    if (row.rtcp) {
      const auto at = chain.machine_from_tip({row.position[0], row.position[1], row.position[2]},
                                             geometry::angles_of(row.position.data()), row.tool_length);
      std::copy_n(at.data(), 3, commanded.begin());
    }
    for (std::size_t k = 0; k < axes.number.size(); ++k) {
      const int column = machine::column_of(drive, axes.number[k]);
      if (column < 0) continue;
      auto& trace = motion.traces[axes.index[k]];
      trace.interval = motion.interval;
      trace.setpoint.push_back(commanded[axes.index[k]]);
      trace.feedback.push_back(capture.actual.row(next)[column]);
      trace.load.push_back(trace.feedback.back());
    }
    ++motion.count;
  }
  return motion;
}

std::vector<truth::Vec3> true_tips(const ChannelMotion& motion, const truth::PoseReport& report) {
  truth::MachinePose pose;
  pose.tool_length = report.tool_length;
  pose.temperatures = report.temperatures;
  std::vector<truth::Vec3> tips;
  tips.reserve(motion.count);
  for (std::size_t i = 0; i < motion.count; ++i) {
    for (std::size_t axis = 0; axis < truth::axis_count; ++axis) {
      pose.positions[axis] = motion.load(axis, i);
      if (i == 0) continue;
      const double moved = motion.commanded(axis, i) - motion.commanded(axis, i - 1);
      if (std::abs(moved) > least_motion) pose.approach[axis] = moved > 0 ? 1 : -1;
    }
    tips.push_back(report.geometry().pose(pose).tip);
  }
  return tips;
}

}  // namespace trunnion::cli
