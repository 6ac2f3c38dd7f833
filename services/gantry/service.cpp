#include "service.hpp"

#include <cmath>
#include <cstdio>

#include "machine/alarm_constants.hpp"
#include "machine/parameter_constants.hpp"

namespace trunnion::gantry {

GantryService::GantryService(service::Node& node)
    : StageService(node, stream::stage_gantry, topics::compensation_frame, topics::gantry_frame,
                   [] { return std::make_unique<GantryCore>(); }) {}

void GantryService::on_feedback(const idl::stream::FeedbackFrame& feedback) {
  const auto parameters = parameters_.newest();
  if (!parameters || feedback.position.size() != feedback.axis_count) return;
  if (parameters->revision != revision_) {
    pairs_ = read_pairs(*parameters);
    revision_ = parameters->revision;
  }
  for (const auto& pair : pairs_) {
    if (static_cast<std::size_t>(std::max(pair.master_column, pair.slave_column)) >= feedback.axis_count)
      continue;
    const double error = synchronization_error(pair, feedback.position.data());
    const auto supervise = [&](const machine::AlarmDefinition& alarm, const machine::RealParameter& parameter,
                               double limit) {
      if (limit > 0 && std::abs(error) > limit) {
        char text[160];
        const auto number = machine::number_text(parameter.number(pair.slave));
        std::snprintf(text, sizeof text,
                      "Axis %d is %.4f mm off its master axis %d, limit %.4f mm (parameter %s)", pair.slave,
                      error, pair.master, limit, number.c_str());
        if (!node_.alarms().active(alarm, pair.slave))
          node_.alarms().raise(alarm, pair.slave, text, feedback.first);
      } else {
        node_.alarms().release(alarm, pair.slave);
      }
    };
    supervise(alarm::synchronization_warning, parameter::synchronization_warning_limit, pair.warning);
    supervise(alarm::synchronization_error, parameter::synchronization_error_limit, pair.limit);
  }
}

}  // namespace trunnion::gantry
