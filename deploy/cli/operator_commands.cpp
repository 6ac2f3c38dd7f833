// SPDX-License-Identifier: Apache-2.0
// mdi, alarms, estop
#include <CLI/CLI.hpp>
#include <cstdio>
#include <iostream>
#include <memory>
#include <optional>

#include "active_alarms.hpp"
#include "bus/json.hpp"
#include "cluster/client.hpp"
#include "cluster/cluster.hpp"
#include "cluster/operating_station.hpp"
#include "commands.hpp"
#include "commands/command_table.hpp"
#include "mdi_line.hpp"

namespace trunnion::cli {
namespace {

struct Line {
  std::string text;
  std::uint16_t channel = 0;
  double timeout = 60;  // s
  bool take_over = false;
};

int mdi(const Common& common, const Line& line) {
  const auto cluster = cluster::find_cluster(common.domain);
  const cluster::OperatingStation station(cluster.run.domain, line.take_over);
  cluster::Client client(cluster.run.domain);
  const auto state = run_line(client, line.channel, line.text, line.timeout);
  if (common.json) {
    std::cout << bus::text_of(bus::to_json(state)) << "\n";
    return 0;
  }
  for (std::size_t i = 0; i < state.letters.size() && i < state.machine.size(); ++i)
    std::printf("%c machine %12.4f  workpiece %12.4f %s\n", state.letters[i], state.machine[i],
                state.workpiece[i], state.letters[i] >= 'A' && state.letters[i] <= 'C' ? "deg" : "mm");
  return 0;
}

// The cycle is that of the stream; what has nothing to do with the stream names none.
void print_alarm(const ActiveAlarm& one) {
  const auto& a = one.alarm;
  const auto cycle = a.cycle == 0 ? "-" : std::to_string(a.cycle);
  std::printf("%4u %-10s %-12s %s cycle %-10s %s\n", a.number, bus::to_string(a.severity), a.source.c_str(),
              one.raised.c_str(), cycle.c_str(), a.text.c_str());
}

int alarms(const Common& common, bool reset, bool take_over) {
  const auto cluster = cluster::find_cluster(common.domain);
  std::optional<cluster::OperatingStation> station;
  if (reset) station.emplace(cluster.run.domain, take_over);
  cluster::Client client(cluster.run.domain);
  if (reset) client.reset_alarms();
  ActiveAlarms active(client);
  active.wait_for_all();
  bus::Json json = bus::Json::array();
  for (const auto& [key, entry] : active.take()) {
    json.push_back(bus::to_json(entry.alarm));
    json.back()["raised"] = entry.raised;
    if (!common.json) print_alarm(entry);
  }
  if (common.json) std::cout << bus::text_of(json, 2) << "\n";
  if (!common.json && json.empty()) std::printf("no alarms\n");
  return 0;
}

int panel(const Common& common, idl::plc::PanelRequestKind kind, bool take_over) {
  const auto cluster = cluster::find_cluster(common.domain);
  std::optional<cluster::OperatingStation> station;
  if (kind != idl::plc::PanelRequestKind::PRESS_EMERGENCY_STOP)
    station.emplace(cluster.run.domain, take_over);
  cluster::Client(cluster.run.domain).panel(kind);
  if (common.json) std::cout << bus::Json{{"accepted", true}}.dump() << "\n";
  return 0;
}

}  // namespace

void add_operator_commands(CLI::App& app, Common& common) {
  auto line = std::make_shared<Line>();
  auto* command = add_command(app, common, "mdi",
                              "Run one line, e.g. trunnion mdi \"G0 X10\", and print where the axes are",
                              [&common, line] { return mdi(common, *line); });
  command->add_option("line", line->text, "The line")->required();
  command->add_option("--channel", line->channel, "Channel number");
  command->add_option("--timeout", line->timeout, "Seconds to wait for its end");
  command->add_flag("--take-right", line->take_over, cluster::take_right_help);

  auto reset = std::make_shared<bool>(false);
  auto take_over = std::make_shared<bool>(false);
  command = add_command(app, common, "alarms",
                        "List the active alarms: when each was raised (UTC), and at which cycle",
                        [&common, reset, take_over] { return alarms(common, *reset, *take_over); });
  command->add_flag("--reset", *reset, "Clear those whose cause is gone first");
  command->add_flag("--take-right", *take_over, cluster::take_right_help);

  auto what = std::make_shared<std::string>();
  command = add_command(
      app, common, "estop",
      "Press or release the emergency stop of the operator panel (no substitute for a hard-wired one)",
      [&common, what, take_over] {
        return panel(common, commands::find_panel_word(*what)->kind, *take_over);
      });
  command->add_flag("--take-right", *take_over, cluster::take_right_help);
  std::vector<std::string> words;
  for (const auto& row : commands::panel_commands()) words.emplace_back(row.word);
  command->add_option("what", *what, "What to do")->required()->check(CLI::IsMember(words));
}

}  // namespace trunnion::cli
