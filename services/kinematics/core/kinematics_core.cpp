// SPDX-License-Identifier: Apache-2.0
#include "kinematics_core.hpp"

namespace trunnion::kinematics {

void KinematicsCore::configure(const machine::Parameters& parameters, std::uint16_t channel) {
  axes_ = machine::channel_axes(parameters, channel);
  chain_ = machine::make_chain(parameters, channel);
}

bool KinematicsCore::process(const idl::stream::PathBatch& in, const stream::FeedbackWindow&,
                             idl::stream::AxisBatch& out) {
  constexpr std::size_t width = 9;
  const std::size_t rows = std::min<std::size_t>(in.count, in.setpoints.size() / width);
  out.axes = axes_.number;
  out.setpoints.resize(rows * axes_.number.size());
  double* to = out.setpoints.data();
  for (std::size_t row = 0; row < rows; ++row) {
    double position[width];
    std::copy_n(&in.setpoints[row * width], width, position);
    if (in.transformation == idl::stream::Transformation::RTCP) {
      const auto machine = chain_->machine_from_tip({position[0], position[1], position[2]},
                                                    geometry::angles_of(position), in.tool_length);
      position[0] = machine[0], position[1] = machine[1], position[2] = machine[2];
    }
    for (const auto index : axes_.index) *to++ = position[index];
  }
  return true;
}

}  // namespace trunnion::kinematics
