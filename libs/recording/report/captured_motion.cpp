// SPDX-License-Identifier: Apache-2.0
#include "report/captured_motion.hpp"

#include <algorithm>
#include <stdexcept>

#include "geometry/types.hpp"
#include "machine/axes.hpp"
#include "machine/kinematics.hpp"
#include "machine/parameter_constants.hpp"
#include "recording/file_stream.hpp"

namespace trunnion::report {

servo_analysis::ChannelMotion motion_of(const Capture& capture, std::uint16_t channel) {
  const auto& parameters = capture.tables.parameters;
  const auto chain = machine::make_chain(parameters, channel);
  const auto axes = machine::channel_axes(parameters, channel);
  const auto drive = machine::drive_axes(parameters);
  servo_analysis::ChannelMotion motion;
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

servo_analysis::ChannelMotion motion_of_recording(const std::string& file, std::uint16_t channel,
                                                  machine::Parameters& parameters) {
  recording::FileSource source(file);
  const auto capture = read_capture(source, channel);
  if (capture.damaged) throw std::runtime_error(file + ": " + capture.problem);
  if (!capture.has_parameters) throw std::runtime_error(file + ": no parameters: " + capture.problem);
  if (capture.path.empty() || capture.actual.width == 0)
    throw std::runtime_error(file + ": no motion of channel " + std::to_string(channel) +
                             ": record the topics path_batch and feedback");
  parameters = capture.tables.parameters;
  return motion_of(capture, channel);
}

}  // namespace trunnion::report
