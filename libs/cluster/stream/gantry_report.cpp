// SPDX-License-Identifier: Apache-2.0
#include "stream/gantry_report.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "machine/axes.hpp"
#include "machine/parameter_constants.hpp"
#include "stream/stage_core.hpp"

namespace trunnion::stream {
namespace {

constexpr std::uint16_t most_channels = 10;

const char* state_text(const machine::GantryPair& pair, const idl::stream::Feedback& f) {
  const auto i = static_cast<std::size_t>(pair.slave_column);
  if (i >= f.enabled.size() || f.enabled[i] == 0) return "drives off";
  if (f.enabled[i] == 3) return "slave taken off";
  if (f.mode == idl::stream::DriveMode::HOMING) return "homing";
  if (f.mode == idl::stream::DriveMode::RETURNING) return "slave is aligned, or axes return to the path";
  return "coupled";
}

std::vector<double> offsets_of(std::size_t pairs, const idl::stream::Feedback& feedback,
                               std::uint16_t channel) {
  std::vector<double> offsets(pairs, 0);
  for (const auto& echo : feedback.channels)
    if (const auto* state = find_state(echo.states, idl::stream::Stage::GANTRY);
        echo.channel == channel && state != nullptr)
      offsets = compensated_offsets(pairs, state->values);
  return offsets;
}

}  // namespace

bool GantryReport::proposes() const { return std::abs(offset.proposal - offset.now) >= 1e-4; }

std::vector<GantryReport> gantry_reports(const machine::Parameters& parameters,
                                         const idl::stream::Feedback& feedback) {
  const auto axes = machine::drive_axes(parameters);
  std::vector<GantryReport> reports;
  for (std::uint16_t channel = 0; channel < most_channels; ++channel) {
    const auto pairs = machine::gantry_pairs(parameters, channel);
    const auto offsets = offsets_of(pairs.size(), feedback, channel);
    for (std::size_t k = 0; k < pairs.size(); ++k) {
      const auto& pair = pairs[k];
      const auto m = static_cast<std::size_t>(pair.master_column);
      const auto s = static_cast<std::size_t>(pair.slave_column);
      if (std::max(m, s) >= feedback.position.size())
        throw std::runtime_error("the drive does not report axis " + std::to_string(pair.slave));
      auto& report = reports.emplace_back();
      report.channel = channel, report.pair = pair;
      report.master_name = axes[m].name, report.slave_name = axes[s].name;
      report.state = state_text(pair, feedback);
      report.master_position = feedback.position[m];
      const bool as_master = parameters.integer(parameter::slave_display_mode, pair.slave) == 1;
      report.slave_position = feedback.position[as_master ? m : s];
      report.difference = gantry_difference(pair, feedback, offsets[k]);
      report.offset = machine::auto_offset(parameters, pair, report.difference.position);
    }
  }
  return reports;
}

bool axes_move(const idl::stream::Feedback& feedback) {
  return feedback.mode == idl::stream::DriveMode::HOMING ||
         std::any_of(feedback.channels.begin(), feedback.channels.end(),
                     [](const auto& echo) { return echo.active; });
}

}  // namespace trunnion::stream
