// SPDX-License-Identifier: Apache-2.0
// upgrade: the services of another build in the place of the running ones, one after the other
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <map>
#include <memory>
#include <stdexcept>
#include <vector>

#include "bus/contract.hpp"
#include "bus/json.hpp"
#include "cluster/child_process.hpp"
#include "cluster/client.hpp"
#include "cluster/cluster.hpp"
#include "cluster/instances.hpp"
#include "cluster/swap_ticket.hpp"
#include "commands.hpp"
#include "machine/machine.hpp"
#include "machine/service_constants.hpp"
#include "text/quantity.hpp"

namespace trunnion::cli {
namespace {

namespace fs = std::filesystem;
using idl::service::SwapReply;
using idl::service::SwapRequest;

// One service: what runs now and what is to take its place.
struct Replacement {
  std::string shown;  // as in `status`
  SwapRequest request;
  std::string running;  // path of the executable, to put it back
  std::string version;  // of what is to take its place
  SwapReply reply;
};

// Version of an executable and contract of its service, as it says itself.
std::string version_of(const std::string& executable) {
  cluster::ChildOptions options;
  options.arguments = {executable, "--version"};
  options.read_from = 1;
  auto said = cluster::ChildProcess(options).read_all();
  while (!said.empty() && said.back() == '\n') said.pop_back();
  return said;
}

std::string other_contract(const std::string& executable, const std::string& said,
                           const std::string& contract) {
  return executable + " is " + (said.empty() ? "of an unknown version" : said) +
         ", this cluster runs with contract " + contract +
         ": stop it and start it with the other build; nothing was replaced";
}

void require_rest(cluster::Client& client, const machine::MachineConfig& config) {
  for (std::uint16_t channel = 0; channel < config.channels; ++channel)
    if (const auto now = client.newest(topics::channel_state, channel).state;
        now != idl::channel::RunState::IDLE)
      throw std::runtime_error("channel " + std::to_string(channel) + " is " + bus::to_string(now) +
                               ": upgrade a machine at rest, with no program started");
}

// Stages first: they are compared cycle by cycle where the machine moves. The drive, which holds the axes, is
// last.
int place_in_order(const std::string& service) {
  static const std::vector<std::string> last = {"parameters", "program", "plc",
                                                "gateway",    "channel", "drive"};
  const auto found = std::find(last.begin(), last.end(), service);
  return found == last.end() ? -1 : static_cast<int>(found - last.begin());
}

// The services of this host, with what is to take their place: all of them can be started, or none is
// replaced.
std::vector<Replacement> plan(const cluster::RunningCluster& cluster, const machine::MachineConfig& config,
                              const idl::service::Cluster& list, const std::string& directory) {
  std::vector<Replacement> all;
  std::map<std::string, std::string> said;
  for (const auto& service : list.services) {
    const auto entry = std::ranges::find(config.services, cluster::place_of(service.instance),
                                         &machine::ServiceEntry::instance);
    if (entry == config.services.end() || (!cluster.host.empty() && entry->host != cluster.host)) continue;
    Replacement next;
    next.shown = service.service;
    if (service.service == machine::service::channel.name) next.shown += " " + std::to_string(entry->channel);
    if (service.replica > 0) next.shown += " replica " + std::to_string(service.replica);
    next.request.service = service.service;
    next.request.replica = service.replica;
    next.request.channel = static_cast<std::uint16_t>(entry->channel);
    next.request.cycles = 1;  // at rest nothing comes that could be compared
    next.request.executable = directory + "/" + machine::program_of(config, *entry);
    const auto& executable = next.request.executable;
    if (access(executable.c_str(), X_OK) != 0)
      throw std::runtime_error(executable + ": there is no such executable; nothing was replaced");
    if (!said.contains(executable)) said[executable] = version_of(executable);
    next.version = said[executable];
    const auto contract = bus::contract_of(service.service);
    if (said[executable].find("contract " + contract) == std::string::npos)
      throw std::runtime_error(other_contract(executable, said[executable], contract));
    std::error_code gone;
    next.running = fs::read_symlink("/proc/" + std::to_string(service.pid) + "/exe", gone).string();
    all.push_back(std::move(next));
  }
  std::stable_sort(all.begin(), all.end(), [](const Replacement& a, const Replacement& b) {
    return place_in_order(a.request.service) < place_in_order(b.request.service);
  });
  return all;
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

// In reverse order; returns what could not be put back.
std::vector<std::string> put_back(Swapper& swapper, std::vector<Replacement>& replaced) {
  std::vector<std::string> left;
  for (auto it = replaced.rbegin(); it != replaced.rend(); ++it) {
    auto request = it->request;
    request.executable = it->running;
    const auto reply = swapper.swap(request);
    if (!reply.accepted) left.push_back(it->shown + " (" + reply.reason + ")");
  }
  return left;
}

int upgrade(const Common& common, const std::string& directory, double timeout) {
  const auto cluster = cluster::find_cluster(common.domain);
  const auto config = machine::load_machine(cluster.machine_directory);
  cluster::Client client(cluster.run.domain);
  const auto list = client.newest(topics::cluster);
  if (!list.ready) throw std::runtime_error("the machine is not ready: see 'trunnion status'");
  require_rest(client, config);
  auto all = plan(cluster, config, list, fs::absolute(directory).lexically_normal().string());

  Swapper swapper(cluster, timeout);
  std::vector<Replacement> replaced;
  for (auto& next : all) {
    next.reply = swapper.swap(next.request);
    if (!next.reply.accepted) {
      const auto left = put_back(swapper, replaced);
      std::string text = next.shown + ": " + next.reply.reason + "; ";
      text += replaced.empty() ? "nothing was replaced"
              : left.empty() ? "the " + std::to_string(replaced.size()) + " services before it were put back"
                             : "these could not be put back: ";
      for (std::size_t i = 0; i < left.size(); ++i) text += (i > 0 ? ", " : "") + left[i];
      throw std::runtime_error(text);
    }
    if (!common.json) {
      std::printf("[%zu/%zu] %-24s %s, %s\n", replaced.size() + 1, all.size(), next.shown.c_str(),
                  next.version.c_str(),
                  next.reply.gap > 0 ? ("no service for " + text::quantity(next.reply.gap, "s", 3)).c_str()
                                     : "no gap");
      std::fflush(stdout);
    }
    replaced.push_back(next);
  }
  if (common.json) {
    bus::Json services = bus::Json::array();
    for (const auto& one : replaced)
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
        list.machine.c_str(), replaced.size());
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
