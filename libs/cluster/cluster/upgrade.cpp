// SPDX-License-Identifier: Apache-2.0
#include "cluster/upgrade.hpp"

#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "bus/contract.hpp"
#include "cluster/child_process.hpp"
#include "cluster/instances.hpp"
#include "machine/service_constants.hpp"

namespace trunnion::cluster {
namespace {

// Version of an executable and contract of its service, as it says itself.
std::string version_of(const std::string& executable) {
  ChildOptions options;
  options.arguments = {executable, "--version"};
  options.read_from = 1;
  auto said = ChildProcess(options).read_all();
  while (!said.empty() && said.back() == '\n') said.pop_back();
  return said;
}

std::string other_contract(const std::string& executable, const std::string& said,
                           const std::string& contract) {
  return executable + " is " + (said.empty() ? "of an unknown version" : said) +
         ", this cluster runs with contract " + contract +
         ": stop it and start it with the other build; nothing was replaced";
}

// In reverse order; returns what could not be put back.
std::vector<std::string> put_back(const Swap& swap, const std::vector<Replacement>& replaced) {
  std::vector<std::string> left;
  for (auto it = replaced.rbegin(); it != replaced.rend(); ++it) {
    auto request = it->request;
    request.executable = it->running;
    const auto reply = swap(request);
    if (!reply.accepted) left.push_back(it->shown + " (" + reply.reason + ")");
  }
  return left;
}

}  // namespace

int place_in_order(const std::string& service) {
  static const std::vector<std::string> last = {"parameters", "program", "plc",
                                                "gateway",    "channel", "drive"};
  const auto found = std::find(last.begin(), last.end(), service);
  return found == last.end() ? -1 : static_cast<int>(found - last.begin());
}

std::vector<Replacement> plan_upgrade(const RunningCluster& cluster, const machine::MachineConfig& config,
                                      const idl::service::Cluster& list, const std::string& directory) {
  std::vector<Replacement> all;
  std::map<std::string, std::string> said;
  for (const auto& service : list.services) {
    const auto entry =
        std::ranges::find(config.services, place_of(service.instance), &machine::ServiceEntry::instance);
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
    next.running =
        std::filesystem::read_symlink("/proc/" + std::to_string(service.pid) + "/exe", gone).string();
    all.push_back(std::move(next));
  }
  std::stable_sort(all.begin(), all.end(), [](const Replacement& a, const Replacement& b) {
    return place_in_order(a.request.service) < place_in_order(b.request.service);
  });
  return all;
}

void replace_all(std::vector<Replacement>& all, const Swap& swap,
                 const std::function<void(const Replacement& one, std::size_t count)>& replaced) {
  std::vector<Replacement> done;
  for (auto& next : all) {
    next.reply = swap(next.request);
    if (!next.reply.accepted) {
      const auto left = put_back(swap, done);
      std::string text = next.shown + ": " + next.reply.reason + "; ";
      text += done.empty()   ? "nothing was replaced"
              : left.empty() ? "the " + std::to_string(done.size()) + " services before it were put back"
                             : "these could not be put back: ";
      for (std::size_t i = 0; i < left.size(); ++i) text += (i > 0 ? ", " : "") + left[i];
      throw std::runtime_error(text);
    }
    done.push_back(next);
    replaced(next, done.size());
  }
}

}  // namespace trunnion::cluster
