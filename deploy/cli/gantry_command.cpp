// SPDX-License-Identifier: Apache-2.0
// gantry: both sides of each gantry of a cluster, and Auto Offset
#include <CLI/CLI.hpp>
#include <cmath>
#include <iostream>
#include <memory>

#include "bus/json.hpp"
#include "cluster/client.hpp"
#include "cluster/session_cluster.hpp"
#include "commands.hpp"
#include "figures.hpp"
#include "machine/parameter_constants.hpp"
#include "stream/gantry_synchronization.hpp"
#include "stream/stage_core.hpp"

namespace trunnion::cli {
namespace {

using machine::GantryPair;

struct GantryOptions {
  std::string machine;
  bool write = false;
};

const char* state_of(const GantryPair& pair, const idl::stream::FeedbackFrame& f) {
  const auto i = static_cast<std::size_t>(pair.slave_column);
  if (i >= f.enabled.size() || f.enabled[i] == 0) return "drives off";
  if (f.enabled[i] == 3) return "slave taken off";
  if (f.mode == idl::stream::DriveMode::HOMING) return "homing";
  if (f.mode == idl::stream::DriveMode::RETURNING) return "slave is aligned, or axes return to the path";
  return "coupled";
}

void print_limit(const char* what, double value, const char* unit, double limit, std::uint32_t number) {
  if (limit <= 0)
    print("  {:<22} {:>12.4f} {:<7} not supervised (parameter {})", what, value, unit,
          machine::number_text(number));
  else
    print("  {:<22} {:>12.4f} {:<7} limit {:.4f} (parameter {}){}", what, value, unit, limit,
          machine::number_text(number), std::abs(value) > limit ? "  EXCEEDED" : "");
}

bus::Json json_of(double value, const char* unit, double limit, std::uint32_t number) {
  bus::Json j = {{"value", value}, {"unit", unit}, {"parameter", machine::number_text(number)}};
  if (limit > 0) j["limit"] = limit, j["exceeded"] = std::abs(value) > limit;
  return j;
}

int show_gantry(const GantryOptions& o, const Common& common) {
  const cluster::SessionCluster session(o.machine, common.domain);
  cluster::Client client(session.running().run.domain);
  const auto p = machine::parameters_of(client.newest(topics::parameter_set));
  const auto axes = machine::drive_axes(p);
  const auto feedback = client.newest(topics::feedback_frame);
  bus::Json out = {{"machine", session.running().machine}, {"gantries", bus::Json::array()}};
  idl::parameters::ParameterRequest request;
  request.operation = idl::parameters::Operation::IMPORT;
  request.who = "gantry auto offset";
  for (std::uint16_t channel = 0; channel < 10; ++channel) {
    const auto pairs = machine::gantry_pairs(p, channel);
    std::vector<double> offsets(pairs.size(), 0);
    for (const auto& echo : feedback.channels)
      if (const auto* state = stream::find_state(echo.states, idl::stream::Stage::GANTRY);
          echo.channel == channel && state != nullptr)
        offsets = stream::compensated_offsets(pairs.size(), state->values);
    for (std::size_t k = 0; k < pairs.size(); ++k) {
      const auto& pair = pairs[k];
      const auto m = static_cast<std::size_t>(pair.master_column);
      const auto s = static_cast<std::size_t>(pair.slave_column);
      if (std::max(m, s) >= feedback.position.size())
        throw std::runtime_error("the drive does not report axis " + std::to_string(pair.slave));
      const auto d = stream::gantry_difference(pair, feedback, offsets[k]);
      const double shown = p.integer(parameter::slave_display_mode, pair.slave) == 1 ? feedback.position[m]
                                                                                     : feedback.position[s];
      const auto offset = machine::auto_offset(p, pair, d.position);
      const std::string state = state_of(pair, feedback);
      const bool moves = std::any_of(feedback.channels.begin(), feedback.channels.end(),
                                     [](const auto& echo) { return echo.active; });
      if (o.write && (moves || feedback.mode == idl::stream::DriveMode::HOMING))
        throw std::runtime_error(
            "the axes move: Auto Offset takes the positions at rest; nothing was written");
      const bool changes = std::abs(offset.proposal - offset.now) >= 1e-4;  // mm
      if (changes) request.values.push_back({offset.number, offset.proposal, ""});
      const auto number = [&](const auto& key) { return key.number(pair.slave); };
      const auto position_limit = number(parameter::synchronization_error_limit);
      const auto speed_limit = number(parameter::synchronization_speed_limit);
      const auto current_limit = number(parameter::synchronization_current_limit);
      if (common.json) {
        out["gantries"].push_back(
            {{"channel", channel},
             {"master",
              {{"axis", pair.master}, {"name", axes[m].name}, {"position_mm", feedback.position[m]}}},
             {"slave", {{"axis", pair.slave}, {"name", axes[s].name}, {"position_mm", shown}}},
             {"state", state},
             {"synchronization_error", json_of(d.position, "mm", pair.limit, position_limit)},
             {"speed_difference", json_of(d.speed, "mm/min", pair.speed_limit, speed_limit)},
             {"current_difference", json_of(d.current, "A", pair.current_limit, current_limit)},
             {"alignment", {{"on", pair.aligns}, {"limit_mm", pair.alignment_limit}}},
             {"auto_offset",
              {{"parameter", machine::number_text(offset.number)},
               {"now_mm", offset.now},
               {"proposal_mm", offset.proposal}}}});
        continue;
      }
      print("{} (axis {}) with its slave {} (axis {}): {}", axes[m].name, pair.master, axes[s].name,
            pair.slave, state);
      print("  {:<22} {:>12.4f} mm", axes[m].name, feedback.position[m]);
      print("  {:<22} {:>12.4f} mm", axes[s].name, shown);
      print_limit("synchronization error", d.position, "mm", pair.limit, position_limit);
      print_limit("difference of speeds", d.speed, "mm/min", pair.speed_limit, speed_limit);
      print_limit("difference of currents", d.current, "A", pair.current_limit, current_limit);
      if (pair.aligns)
        print("  alignment on: errors up to {:.4f} mm at the release of the emergency stop (10a062)",
              pair.alignment_limit);
      else
        print("  alignment off: the slave keeps its distance (10a062); limit {:.4f} mm",
              pair.alignment_limit);
      if (changes)
        print("  Auto Offset: parameter {} of axis {} {} set to {:.6f} mm (now {:.6f})",
              machine::number_text(offset.number), pair.slave, o.write ? "is" : "would be", offset.proposal,
              offset.now);
    }
  }
  const bool write = o.write && !request.values.empty() && !session.own();
  if (write) client.parameter(std::move(request));
  out["written"] = write;
  if (common.json) {
    std::cout << bus::text_of(out) << "\n";
  } else if (out["gantries"].empty() && machine::gantry_pairs(p).empty()) {
    print("{} has no gantry (parameters 010050, 10a100)", session.running().machine);
  } else if (write) {
    print("written; it acts after a restart, then home axes with an incremental encoder");
  } else {
    print("nothing written{}", o.write ? "" : ": --write sets what Auto Offset proposes");
  }
  return 0;
}

}  // namespace

void add_gantry_command(CLI::App& app, Common& common) {
  auto o = std::make_shared<GantryOptions>();
  auto* command =
      add_command(app, common, "gantry", "Both sides of a gantry: synchronization error, limits, Auto Offset",
                  [o, &common] { return show_gantry(*o, common); });
  command->add_option(
      "machine", o->machine,
      "Name under configs/machines or a directory: a cluster of its own in virtual time; without it "
      "the cluster that runs");
  command->add_flag("--write", o->write, "Set what Auto Offset proposes; only of a cluster that runs");
}

}  // namespace trunnion::cli
