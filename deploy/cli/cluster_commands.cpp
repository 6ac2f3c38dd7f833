// SPDX-License-Identifier: Apache-2.0
// up, status
#include <CLI/CLI.hpp>
#include <cstdio>
#include <iostream>
#include <memory>

#include "bus/contract.hpp"
#include "bus/json.hpp"
#include "cluster/client.hpp"
#include "cluster/cluster.hpp"
#include "cluster/instances.hpp"
#include "commands.hpp"
#include "machine/alarm_constants.hpp"
#include "machine/gateway_settings.hpp"
#include "machine/service_constants.hpp"
#include "machine_check/machine_check.hpp"
#include "stream/replica_watch.hpp"
#include "stream/stage_names.hpp"

namespace trunnion::cli {
using bus::Json;

CLI::App* add_command(CLI::App& app, Common& common, const std::string& name, const std::string& about,
                      std::function<int()> action) {
  auto* command = app.add_subcommand(name, about);
  command->add_flag("--json", common.json, "Print JSON");
  command->add_option("--domain", common.domain, "DDS domain of the cluster (default: the one that runs)")
      ->check(CLI::Range(0, 100));
  command->callback([&common, action] { common.action = action; });
  return command;
}

namespace {

// It runs with its drives off. What is wrong can be corrected only where it runs.
int report_fault(const cluster::RunningCluster& cluster) {
  std::fprintf(stderr,
               "trunnion: %s runs in domain %u with its drives off, %s\n"
               "Correct what is named, a parameter with 'trunnion param set' and 'trunnion channel reset'; "
               "'trunnion down' stops the machine\n",
               cluster.machine.c_str(), cluster.run.domain, cluster.fault.c_str());
  return 1;
}

int up(const Common& common, cluster::UpOptions options, const std::string& time) {
  if (common.domain && options.own_domain)
    throw std::runtime_error("--domain and --free-domain exclude each other: give one of them");
  options.domain = common.domain;
  if (!time.empty()) options.virtual_time = time == "virtual";
  options.keep_faulty = true;
  machine_check::require_good(cluster::find_machine(options.machine));
  const auto cluster = cluster::start_cluster(options);
  if (options.foreground) return 0;
  if (common.json) {
    std::cout << Json{{"machine", cluster.machine},
                      {"domain", cluster.run.domain},
                      {"ready_seconds", cluster.start_seconds},
                      {"state", cluster.state_directory},
                      {"port", cluster.port},
                      {"fault", cluster.fault}}
                     .dump()
              << "\n";
  } else if (cluster.fault.empty()) {
    std::printf("%s %s in %.2f s, domain %u, state in %s\n", cluster.machine.c_str(),
                cluster.host.empty() ? "is ready" : ("runs what host " + cluster.host + " has").c_str(),
                cluster.start_seconds, cluster.run.domain, cluster.state_directory.c_str());
    const bool tls = machine::load_gateway_settings(cluster.machine_directory).tls.on;
    if (cluster.port != 0)
      std::printf("Operate it at %s://localhost:%u\n", tls ? "https" : "http", cluster.port);
  }
  return cluster.fault.empty() ? 0 : report_fault(cluster);
}

// Host and, of a channel, its number.
void add_place(Json& row, const machine::MachineConfig& config, std::uint32_t instance) {
  row["host"] = "";
  for (const auto& entry : config.services) {
    if (entry.instance != cluster::place_of(instance)) continue;
    row["host"] = entry.host;
    if (entry.service == machine::service::channel.name) row["channel"] = entry.channel;
  }
}

std::string name_in_table(const Json& row) {
  const auto service = row["service"].get<std::string>();
  return row.contains("channel") ? service + " " + std::to_string(row["channel"].get<int>()) : service;
}

// Behind the columns: the host, where there are several, and what the service publishes of itself.
std::string remark(const Json& row) {
  const auto host = row["host"].get<std::string>();
  return (host.empty() ? "" : "on " + host + "  ") + row["detail"].get<std::string>();
}

// Of a replica of a stage: in step, joining, or dropped by a channel; empty for other services.
std::string replica_state(const idl::service::ClusterService& service, bool in_step,
                          const std::map<std::array<std::uint32_t, 3>, idl::service::Alarm>& alarms) {
  const auto stage = stream::stage_of(service.service);
  if (!stage || service.pid == 0) return "";
  const auto part = stream::replica_part(*stage, service.replica);
  const auto number = alarm::redundancy_lost.number;
  for (const auto& [key, alarm] : alarms)
    if (alarm.active && alarm.number == number && alarm.part == part &&
        alarm.source == stream::stage_name(stream::Stage::CHANNEL))
      return "dropped";
  return in_step ? "in step" : "joining";
}

// What the PLC's programs keep the channels from doing.
Json inhibits_of(const std::optional<idl::plc::Outputs>& outputs) {
  auto list = Json::array();
  for (std::size_t channel = 0; outputs && channel < outputs->channels.size(); ++channel) {
    const auto& control = outputs->channels[channel];
    if (control.start_inhibit || control.manual_inhibit)
      list.push_back({{"channel", channel},
                      {"start_inhibit", control.start_inhibit},
                      {"manual_inhibit", control.manual_inhibit},
                      {"reason", control.reason}});
  }
  return list;
}

void print_inhibits(const Json& inhibits) {
  if (!inhibits.empty()) std::printf("\ninhibited by the PLC\n");
  for (const auto& one : inhibits) {
    const bool start = one["start_inhibit"], manual = one["manual_inhibit"];
    const auto reason = one["reason"].get<std::string>();
    std::printf("  channel %d: %s%s%s: %s\n", one["channel"].get<int>(), start ? "cycle start" : "",
                start && manual ? " and " : "", manual ? "manual motion" : "",
                reason.empty() ? "the programs give no reason" : reason.c_str());
  }
}

int show_status(const Common& common) {
  const auto cluster = cluster::find_cluster(common.domain);
  cluster::Client client(cluster.run.domain);
  auto announcements = client.bus().reader(topics::announcement);
  auto states = client.bus().reader(topics::service_state);
  auto alarms = client.bus().reader(topics::alarm);
  auto plc = client.bus().reader(topics::plc_outputs);
  const auto list = client.newest(topics::cluster);
  std::map<std::uint32_t, idl::service::Announcement> announced;
  std::map<std::uint32_t, idl::service::ServiceState> state;
  std::map<std::array<std::uint32_t, 3>, idl::service::Alarm> alarm;
  std::optional<idl::plc::Outputs> outputs;
  const double until = service::monotonic_seconds() + 1.5;
  do {
    idl::service::Announcement a;
    while (announcements.take(a)) announced[a.instance] = a;
    idl::service::ServiceState s;
    while (states.take(s)) state[s.instance] = s;
    idl::service::Alarm l;
    while (alarms.take(l)) alarm[{l.instance, l.number, l.part}] = l;
    idl::plc::Outputs o;
    while (plc.take(o)) outputs = o;
    bool all = announced.size() >= list.services.size() && outputs;
    for (const auto& service : list.services) all = all && state.count(service.instance) != 0;
    if (all && service::monotonic_seconds() > until - 1.2) break;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  } while (service::monotonic_seconds() < until);
  const auto config = machine::load_machine(cluster.machine_directory);
  Json services = Json::array();
  for (const auto& service : list.services) {
    Json row = bus::to_json(service);
    const auto s = state.find(service.instance);
    const auto a = announced.find(service.instance);
    row["state"] = s != state.end() && s->second.pid == service.pid ? bus::to_string(s->second.lifecycle)
                   : service.pid == 0                               ? "NOT RUNNING"
                                                                    : "NO HEARTBEAT";
    row["detail"] = s != state.end() ? s->second.detail : "";
    row["uptime_seconds"] = s != state.end() ? s->second.uptime : 0;
    row["messages_per_second"] = s != state.end() ? s->second.messages_per_second : 0;
    row["cycles_lost"] = s != state.end() ? s->second.cycles_lost : 0;
    row["in_step"] = s != state.end() && s->second.pid == service.pid && s->second.in_step;
    row["replica_state"] = replica_state(service, row["in_step"].get<bool>(), alarm);
    const auto contract = bus::contract_of(service.service);
    row["contract_matches"] = a != announced.end() && a->second.contract == contract;
    if (a != announced.end() && a->second.contract != contract)
      row["state"] = "CONTRACT " + a->second.contract + ", expected " + contract;
    add_place(row, config, service.instance);
    services.push_back(row);
  }
  Json active = Json::array();
  for (const auto& [key, a] : alarm)
    if (a.active) active.push_back(bus::to_json(a));
  const auto inhibits = inhibits_of(outputs);
  if (common.json) {
    std::cout << Json{{"machine", list.machine}, {"domain", cluster.run.domain},
                      {"ready", list.ready},     {"virtual_time", list.virtual_time},
                      {"services", services},    {"alarms", active},
                      {"inhibits", inhibits},    {"open", cluster.open}}
                     .dump(2)
              << "\n";
  } else {
    std::printf("%s, domain %u, %s time, %s\n\n", list.machine.c_str(), cluster.run.domain,
                list.virtual_time ? "virtual" : "real", list.ready ? "ready" : "NOT READY");
    if (cluster.open)
      std::printf("open: no security, every computer in the network of the hosts can move this machine\n\n");
    std::printf("%-14s %-7s %-11s %8s %-14s %-8s %10s %10s %8s  %s\n", "service", "replica", "vendor", "pid",
                "state", "in step", "uptime s", "messages/s", "restarts", "");
    for (const auto& row : services)
      std::printf("%-14s %-7d %-11s %8d %-14s %-8s %10.1f %10.1f %8d  %s\n", name_in_table(row).c_str(),
                  row["replica"].get<int>(), row["vendor"].get<std::string>().c_str(), row["pid"].get<int>(),
                  row["state"].get<std::string>().c_str(), row["replica_state"].get<std::string>().c_str(),
                  row["uptime_seconds"].get<double>(), row["messages_per_second"].get<double>(),
                  row["restarts"].get<int>(), remark(row).c_str());
    if (!active.empty()) std::printf("\nalarms\n");
    for (const auto& a : active)
      std::printf("  %u %s (%s): %s\n", a["number"].get<unsigned>(), a["severity"].get<std::string>().c_str(),
                  a["source"].get<std::string>().c_str(), a["text"].get<std::string>().c_str());
    print_inhibits(inhibits);
  }
  return list.ready ? 0 : 1;
}

}  // namespace

void add_cluster_commands(CLI::App& app, Common& common) {
  auto options = std::make_shared<cluster::UpOptions>();
  auto time = std::make_shared<std::string>();
  auto port = std::make_shared<int>(0);
  auto executables = std::make_shared<std::vector<std::string>>();
  auto* command = add_command(app, common, "up", "Start the cluster of a machine and wait until it is ready",
                              [&common, options, time, port, executables] {
                                options->executables = cluster::read_executables(*executables);
                                if (*port != 0) options->port = static_cast<std::uint16_t>(*port);
                                return up(common, *options, *time);
                              });
  command
      ->add_option("machine", options->machine,
                   "Name under configs/machines, or a directory with machine.yaml")
      ->required();
  command->add_option("--vendor", options->vendor, "DDS vendor of every service, instead of machine.yaml's")
      ->check(CLI::IsMember({"fastdds", "cyclonedds", "mixed"}));
  command->add_option("--time", *time, "real or virtual, instead of machine.yaml's")
      ->check(CLI::IsMember({"real", "virtual"}));
  command->add_option("--exec", *executables, exec_help);
  command->add_flag("--free-domain", options->own_domain,
                    "Take a DDS domain that no cluster of this computer uses, 80 .. 99, and a free port");
  command->add_option("--port", *port, "Port of the gateway")->check(CLI::Range(1, 65535));
  command->add_option("--state", options->state_directory,
                      "Directory for what must survive (default: under ~/.local/state/trunnion)");
  command->add_option(
      "--host", options->host,
      "Which host of machine.yaml this is (default: the one with an address of this computer)");
  command->add_flag("--take-over", options->take_over,
                    "After a crash: end processes that a killed launcher has left in this state directory or "
                    "domain");
  command->add_flag("--foreground", options->foreground, "Stay in the foreground until Ctrl-C");
  add_command(app, common, "status",
              "Table of the services: vendor, pid, state, uptime, rates; the alarms; what the PLC inhibits. "
              "Exit status "
              "0 when ready",
              [&common] { return show_status(common); });
}

}  // namespace trunnion::cli
