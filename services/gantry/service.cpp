// SPDX-License-Identifier: Apache-2.0
#include "service.hpp"

#include <cmath>
#include <cstdio>

#include "machine/alarm_constants.hpp"
#include "machine/parameter_constants.hpp"

namespace trunnion::gantry {

GantryService::GantryService(service::Node& node)
    : StageService(node, stream::Stage::GANTRY, topics::compensation_frame, topics::gantry_frame,
                   [] { return std::make_unique<GantryCore>(); }) {}

void GantryService::on_feedback(const idl::stream::FeedbackFrame& feedback) {
  const auto parameters = parameters_.newest();
  if (!parameters || feedback.position.size() != feedback.axis_count) return;
  if (parameters->revision != revision_) {
    channels_.clear();
    for (std::uint16_t channel = 0; channel < node_.options().machine.channels; ++channel)
      for (const auto& pair : machine::gantry_pairs(*parameters, channel))
        channels_[channel].push_back({pair, 0});
    revision_ = parameters->revision;
  }
  for (const auto& echo : feedback.channels) {
    const auto found = channels_.find(echo.channel);
    const auto* state = stream::find_state(echo.states, stream::Stage::GANTRY);
    if (found == channels_.end() || state == nullptr) continue;
    const auto offsets = compensated_offsets(found->second.size(), state->values);
    for (std::size_t k = 0; k < offsets.size(); ++k) found->second[k].offset = offsets[k];
  }
  for (const auto& [channel, pairs] : channels_)
    for (const auto& supervised : pairs) supervise(supervised, feedback);
}

void GantryService::supervise(const Supervised& supervised, const idl::stream::FeedbackFrame& feedback) {
  const auto& pair = supervised.pair;
  if (std::max(pair.master_column, pair.slave_column) >= static_cast<int>(feedback.axis_count)) return;
  const double error = synchronization_error(pair, feedback.position.data()) - supervised.offset;
  const auto check = [&](const machine::AlarmDefinition& alarm, const machine::RealParameter& parameter,
                         double limit) {
    if (limit <= 0 || std::abs(error) <= limit) {
      node_.alarms().release(alarm, pair.slave);
      return;
    }
    if (node_.alarms().active(alarm, pair.slave)) return;
    char text[160];
    std::snprintf(text, sizeof text,
                  "Axis %d is %.4f mm off its master axis %d, limit %.4f mm (parameter %s)", pair.slave,
                  error, pair.master, limit, machine::number_text(parameter.number(pair.slave)).c_str());
    node_.alarms().raise(alarm, pair.slave, text, feedback.first);
  };
  check(alarm::synchronization_warning, parameter::synchronization_warning_limit, pair.warning);
  check(alarm::synchronization_error, parameter::synchronization_error_limit, pair.limit);
}

}  // namespace trunnion::gantry
