#include "service.hpp"

#include <cmath>
#include <cstdio>

namespace trunnion::gantry {

GantryService::GantryService(node::Node& node)
    : StageService(node, stream::Stage::GANTRY, topics::compensation_frame, topics::gantry_frame,
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
    const auto supervise = [&](const char* alarm, double limit) {
      if (limit > 0 && std::abs(error) > limit) {
        char text[160];
        const auto number = machine::number_text(100000 + pair.slave * 1000u +
                                                 (std::string(alarm) == "synchronization_error" ? 107 : 106));
        std::snprintf(text, sizeof text,
                      "Axis %d is %.4f mm off its master axis %d, limit %.4f mm (parameter %s)", pair.slave,
                      error, pair.master, limit, number.c_str());
        if (!node_.alarms().active(alarm, pair.slave))
          node_.alarms().raise(alarm, pair.slave, text, feedback.first);
      } else {
        node_.alarms().release(alarm, pair.slave);
      }
    };
    supervise("synchronization_warning", pair.warning);
    supervise("synchronization_error", pair.limit);
  }
}

}  // namespace trunnion::gantry
