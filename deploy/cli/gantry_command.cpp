// SPDX-License-Identifier: Apache-2.0
// gantry: both sides of each gantry of a cluster, and Auto Offset
#include <CLI/CLI.hpp>
#include <cmath>
#include <iostream>
#include <memory>
#include <stdexcept>
#include <utility>

#include "bus/json.hpp"
#include "cluster/client.hpp"
#include "cluster/session_cluster.hpp"
#include "commands.hpp"
#include "figures.hpp"
#include "machine/parameter_constants.hpp"
#include "stream/gantry_report.hpp"

namespace trunnion::cli {
namespace {

using stream::GantryReport;

struct GantryOptions {
  std::string machine;
  bool write = false;
};

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

bus::Json json_of(const GantryReport& r) {
  const auto number = [&](const auto& key) { return key.number(r.pair.slave); };
  return {{"channel", r.channel},
          {"master", {{"axis", r.pair.master}, {"name", r.master_name}, {"position_mm", r.master_position}}},
          {"slave", {{"axis", r.pair.slave}, {"name", r.slave_name}, {"position_mm", r.slave_position}}},
          {"state", r.state},
          {"synchronization_error", json_of(r.difference.position, "mm", r.pair.limit,
                                            number(parameter::synchronization_error_limit))},
          {"speed_difference", json_of(r.difference.speed, "mm/min", r.pair.speed_limit,
                                       number(parameter::synchronization_speed_limit))},
          {"current_difference", json_of(r.difference.current, "A", r.pair.current_limit,
                                         number(parameter::synchronization_current_limit))},
          {"alignment", {{"on", r.pair.aligns}, {"limit_mm", r.pair.alignment_limit}}},
          {"auto_offset",
           {{"parameter", machine::number_text(r.offset.number)},
            {"now_mm", r.offset.now},
            {"proposal_mm", r.offset.proposal}}}};
}

void print_report(const GantryReport& r, bool written) {
  const auto number = [&](const auto& key) { return key.number(r.pair.slave); };
  print("{} (axis {}) with its slave {} (axis {}): {}", r.master_name, r.pair.master, r.slave_name,
        r.pair.slave, r.state);
  print("  {:<22} {:>12.4f} mm", r.master_name, r.master_position);
  print("  {:<22} {:>12.4f} mm", r.slave_name, r.slave_position);
  print_limit("synchronization error", r.difference.position, "mm", r.pair.limit,
              number(parameter::synchronization_error_limit));
  print_limit("difference of speeds", r.difference.speed, "mm/min", r.pair.speed_limit,
              number(parameter::synchronization_speed_limit));
  print_limit("difference of currents", r.difference.current, "A", r.pair.current_limit,
              number(parameter::synchronization_current_limit));
  if (r.pair.aligns)
    print("  alignment on: errors up to {:.4f} mm at the release of the emergency stop (10a062)",
          r.pair.alignment_limit);
  else
    print("  alignment off: the slave keeps its distance (10a062); limit {:.4f} mm", r.pair.alignment_limit);
  if (r.proposes())
    print("  Auto Offset: parameter {} of axis {} {} set to {:.6f} mm (now {:.6f})",
          machine::number_text(r.offset.number), r.pair.slave, written ? "is" : "would be", r.offset.proposal,
          r.offset.now);
}

int show_gantry(const GantryOptions& o, const Common& common) {
  const cluster::SessionCluster session(o.machine, common.domain);
  cluster::Client client(session.running().run.domain);
  const auto p = machine::parameters_of(client.newest(topics::parameter_set));
  const auto feedback = client.newest(topics::feedback);
  const auto reports = stream::gantry_reports(p, feedback);
  if (o.write && !reports.empty() && stream::axes_move(feedback))
    throw std::runtime_error("the axes move: Auto Offset takes the positions at rest; nothing was written");
  bus::Json out = {{"machine", session.running().machine}, {"gantries", bus::Json::array()}};
  idl::parameters::ParameterRequest request;
  request.operation = idl::parameters::Operation::IMPORT;
  request.who = "gantry auto offset";
  for (const auto& report : reports) {
    if (report.proposes()) request.values.push_back({report.offset.number, report.offset.proposal, ""});
    if (common.json)
      out["gantries"].push_back(json_of(report));
    else
      print_report(report, o.write);
  }
  const bool write = o.write && !request.values.empty() && !session.own();
  if (write) client.parameter(std::move(request));
  out["written"] = write;
  if (common.json) {
    std::cout << bus::text_of(out) << "\n";
  } else if (machine::gantry_pairs(p).empty()) {
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
