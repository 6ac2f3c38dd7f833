// SPDX-License-Identifier: Apache-2.0
#include "skip_inputs.hpp"

#include "machine/parameter_constants.hpp"

namespace trunnion::drive {

void SkipInputs::configure(const machine::Parameters& p, const std::vector<machine::AxisInfo>& axes) {
  for (std::uint32_t k = 0; k < inputs_.size(); ++k) {
    const int axis = p.integer(parameter::skip_input_axis, 0, k);
    inputs_[k].column = axis < 0 ? -1 : machine::column_of(axes, static_cast<std::uint16_t>(axis));
    inputs_[k].position = p.get(parameter::skip_input_position, 0, k);
    inputs_[k].side = p.integer(parameter::skip_input_side, 0, k) < 0 ? -1 : 1;
  }
}

void SkipInputs::step(const std::vector<SimulatedAxis>& servos, std::uint64_t number, EncoderRowSink& rows) {
  const bool first = load_.size() != servos.size();
  if (first) {
    load_.resize(servos.size());
    encoder_.resize(servos.size());
  }
  for (std::size_t k = 0; k < inputs_.size() && !first; ++k) {
    const Input& input = inputs_[k];
    if (input.column < 0) continue;
    const auto column = static_cast<std::size_t>(input.column);
    const double before = (load_[column] - input.position) * input.side;
    const double after = (servos[column].load() - input.position) * input.side;
    if (before >= 0 || after < 0) continue;
    const double share = before / (before - after);
    idl::stream::SkipEdge edge;
    edge.input = static_cast<std::uint8_t>(k + 1);
    for (std::size_t i = 0; i < servos.size(); ++i)
      edge.position.push_back(encoder_[i] + share * (servos[i].encoder() - encoder_[i]));
    rows.skip_edge(number + 1, edge);
  }
  for (std::size_t i = 0; i < servos.size(); ++i) {
    load_[i] = servos[i].load();
    encoder_[i] = servos[i].encoder();
  }
}

std::uint8_t SkipInputs::on() const {
  unsigned bits = 0;
  for (std::size_t k = 0; k < inputs_.size(); ++k) {
    const Input& input = inputs_[k];
    if (input.column < 0 || static_cast<std::size_t>(input.column) >= load_.size()) continue;
    if ((load_[static_cast<std::size_t>(input.column)] - input.position) * input.side >= 0) bits |= 1u << k;
  }
  return static_cast<std::uint8_t>(bits);
}

}  // namespace trunnion::drive
