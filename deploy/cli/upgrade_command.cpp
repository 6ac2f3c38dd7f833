// SPDX-License-Identifier: Apache-2.0
// upgrade: the services of another build in the place of the running ones, one after the other
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <memory>
#include <stdexcept>

#include "bus/json.hpp"
#include "cluster/client.hpp"
#include "cluster/cluster.hpp"
#include "cluster/swap_ticket.hpp"
#include "cluster/upgrade.hpp"
#include "commands.hpp"
#include "machine/machine.hpp"
#include "machine/service_constants.hpp"
#include "stream/drive_at_rest.hpp"
#include "text/quantity.hpp"

namespace trunnion::cli {
namespace {

namespace fs = std::filesystem;
using idl::service::SwapReply;
using idl::service::SwapRequest;

void require_rest(cluster::Client& client, const machine::MachineConfig& config) {
  for (std::uint16_t channel = 0; channel < config.channels; ++channel)
    if (const auto now = client.newest(topics::channel_state, channel).state;
        now != idl::channel::RunState::IDLE)
      throw std::runtime_error("channel " + std::to_string(channel) + " is " + bus::to_string(now) +
                               ": upgrade a machine at rest, with no program started");
}

// The launcher refuses the drive, too, but only when the services before it have been replaced.
void require_drive_at_rest(cluster::Client& client, const machine::MachineConfig& config,
                           const std::vector<cluster::Replacement>& all) {
  if (std::ranges::none_of(
          all, [](const auto& one) { return one.request.service == machine::service::drive.name; }))
    return;
  const std::string rest = ": upgrade a machine at rest; nothing was replaced";
  for (std::uint16_t channel = 0; channel < config.channels; ++channel)
    if (const auto tap = stream::tap_in_hole(client.newest(topics::channel_state, channel)); !tap.empty())
      throw std::runtime_error("channel " + std::to_string(channel) + ": " + tap + rest);
  if (const auto spindle = stream::spindle_at_work(client.newest(topics::feedback)); !spindle.empty())
    throw std::runtime_error(spindle + rest);
}

class Swapper {
 public:
  Swapper(const cluster::RunningCluster& cluster, double timeout)
      : run_directory_(cluster.run.path()),
        timeout_(timeout),
        bus_(bus::Vendor::cyclonedds, cluster.network),
        client_(bus_, topics::swap_request, topics::swap_reply) {}

  SwapReply swap(SwapRequest request) {
    cluster::put_ticket(run_directory_, request);
    if (const auto reply = client_.call(request, timeout_)) return *reply;
    SwapReply none;
    none.reason = service::silence("the launcher", timeout_, client_.connected());
    return none;
  }

 private:
  std::string run_directory_;
  double timeout_;
  bus::Bus bus_;
  service::RequestClient<SwapRequest, SwapReply> client_;
};

void print_replaced(const cluster::Replacement& one, std::size_t count, std::size_t of) {
  std::printf(
      "[%zu/%zu] %-24s %s, %s\n", count, of, one.shown.c_str(), one.version.c_str(),
      one.reply.gap > 0 ? ("no service for " + text::quantity(one.reply.gap, "s", 3)).c_str() : "no gap");
  std::fflush(stdout);
}

int upgrade(const Common& common, const std::string& directory, double timeout) {
  const auto cluster = cluster::find_cluster(common.domain);
  const auto config = machine::load_machine(cluster.machine_directory);
  cluster::Client client(cluster.run.domain);
  const auto list = client.newest(topics::cluster);
  if (!list.ready) throw std::runtime_error("the machine is not ready: see 'trunnion status'");
  require_rest(client, config);
  auto all =
      cluster::plan_upgrade(cluster, config, list, fs::absolute(directory).lexically_normal().string());
  require_drive_at_rest(client, config, all);
  Swapper swapper(cluster, timeout);
  cluster::replace_all(
      all, [&](const SwapRequest& request) { return swapper.swap(request); },
      [&](const cluster::Replacement& one, std::size_t count) {
        if (!common.json) print_replaced(one, count, all.size());
      });
  if (common.json) {
    bus::Json services = bus::Json::array();
    for (const auto& one : all)
      services.push_back({{"service", one.request.service},
                          {"replica", one.request.replica},
                          {"channel", one.request.channel},
                          {"executable", one.request.executable},
                          {"replaced", one.running},
                          {"version", one.version},
                          {"gap_seconds", one.reply.gap}});
    std::cout << bus::text_of({{"machine", list.machine}, {"services", services}}, 2) << "\n";
  } else {
    std::printf(
        "%s: %zu services upgraded; the launcher stays until 'trunnion down'. 'trunnion up' of the new build "
        "starts the "
        "new ones\n",
        list.machine.c_str(), all.size());
  }
  return 0;
}

}  // namespace

void add_upgrade_command(CLI::App& app, Common& common) {
  auto directory = std::make_shared<std::string>();
  auto timeout = std::make_shared<double>(60);
  auto* command = add_command(
      app, common, "upgrade",
      "Put the services of another build in the place of the running ones, one after the other, on a machine "
      "at rest. "
      "When one does not take over, those before it are put back; exit status 0 when all have taken over",
      [&common, directory, timeout] { return upgrade(common, *directory, *timeout); });
  command
      ->add_option(
          "directory", *directory,
          "Directory with the executables of the other build, one of swap_directories of machine.yaml")
      ->required()
      ->check(CLI::ExistingDirectory);
  command->add_option("--timeout", *timeout, "Seconds to wait for each service (default 60)")
      ->check(CLI::PositiveNumber);
}

}  // namespace trunnion::cli
