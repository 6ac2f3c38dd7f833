// SPDX-License-Identifier: Apache-2.0
#include "service.hpp"

#include "stream/gantry_synchronization.hpp"

namespace trunnion::gantry {

GantryService::GantryService(service::Node& node)
    : StageService(node, stream::Stage::GANTRY, topics::compensation_batch, topics::gantry_batch,
                   [] { return std::make_unique<GantryCore>(); }) {}

void GantryService::on_feedback(const idl::stream::Feedback& feedback) {
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
    const auto offsets = stream::compensated_offsets(found->second.size(), state->values);
    for (std::size_t k = 0; k < offsets.size(); ++k) found->second[k].offset = offsets[k];
  }
  for (const auto& [channel, pairs] : channels_)
    for (const auto& supervised : pairs) supervise(supervised, feedback);
}

void GantryService::supervise(const Supervised& supervised, const idl::stream::Feedback& feedback) {
  const auto& pair = supervised.pair;
  const bool compared = stream::is_coupled(pair, feedback);
  const auto found =
      stream::gantry_findings(pair, compared ? stream::gantry_difference(pair, feedback, supervised.offset)
                                             : stream::GantryDifference{});
  for (const auto& finding : found) {
    if (!finding.text)
      node_.alarms().release(*finding.alarm, pair.slave);
    else if (!node_.alarms().active(*finding.alarm, pair.slave))
      node_.alarms().raise(*finding.alarm, pair.slave, *finding.text, feedback.first);
  }
}

}  // namespace trunnion::gantry
