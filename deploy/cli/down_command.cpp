// SPDX-License-Identifier: Apache-2.0
// down
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "bus/json.hpp"
#include "cluster/cluster.hpp"
#include "commands.hpp"

namespace trunnion::cli {
namespace {

using cluster::RunningCluster;

std::string place_of(const RunningCluster& cluster) {
  return cluster.machine + " (domain " + std::to_string(cluster.run.domain) + ")";
}

std::string list_of(const std::vector<RunningCluster>& clusters) {
  std::string list;
  for (const auto& cluster : clusters) list += (list.empty() ? "" : ", ") + place_of(cluster);
  return list;
}

bool has_name(const RunningCluster& cluster, const std::string& name) {
  return cluster.machine == name || (std::filesystem::exists(name + "/machine.yaml") &&
                                     cluster::find_machine(name) == cluster.machine_directory);
}

bool agreed(const RunningCluster& cluster) {
  std::fprintf(stderr, "%s was started in another session. Stop it? [y/N] ", place_of(cluster).c_str());
  std::string answer;
  std::getline(std::cin, answer);
  return answer == "y" || answer == "Y";
}

RunningCluster named(const Common& common, const std::string& name) {
  auto found = cluster::running_clusters();
  std::erase_if(found, [&](const auto& cluster) {
    return !has_name(cluster, name) || (common.domain && *common.domain != cluster.run.domain);
  });
  if (found.size() == 1) return found.front();
  if (!found.empty())
    throw std::runtime_error("several clusters are running: " + list_of(found) + ": say which with --domain");
  const auto others = list_of(cluster::running_clusters());
  throw std::runtime_error("no cluster of a machine '" + name + "' is running" +
                           (others.empty() ? "" : "; running: " + others));
}

// One that this session has not started is stopped by who says so only. Nothing when he does not.
std::optional<RunningCluster> unnamed() {
  const auto all = cluster::running_clusters();
  if (all.empty()) return cluster::find_cluster(std::nullopt);  // says why there is none
  auto own = all;
  std::erase_if(own, [](const auto& cluster) { return cluster.session != getsid(0); });
  if (own.size() == 1) return own.front();
  if (own.empty() && all.size() == 1 && isatty(STDIN_FILENO) != 0)
    return agreed(all.front()) ? std::optional(all.front()) : std::nullopt;
  throw std::runtime_error(own.empty() ? "this session has started no cluster; running: " + list_of(all) +
                                             ": say which with 'trunnion down NAME'"
                                       : "several clusters are running: " + list_of(own) +
                                             ": say which with 'trunnion down NAME' or --domain");
}

// What killed launchers have left; whether there was something.
bool clear_abandoned(const Common& common) {
  bool cleared = false;
  for (const auto& run : cluster::run_directories())
    if (run.abandoned() && (!common.domain || *common.domain == run.domain)) {
      run.remove();
      cleared = true;
      std::fprintf(stderr, "Removed what the killed cluster in domain %u had left\n", run.domain);
    }
  return cleared;
}

int down(const Common& common, const std::string& name) {
  // What a cluster of another machine has left is that one's.
  if (name.empty() && clear_abandoned(common) && cluster::running_clusters().empty()) return 0;
  const auto cluster = !name.empty()   ? named(common, name)
                       : common.domain ? cluster::find_cluster(common.domain)
                                       : unnamed();
  if (!cluster) return 1;
  cluster::stop_cluster(cluster->run);
  if (common.json)
    std::cout << bus::Json{{"stopped", cluster->machine}}.dump() << "\n";
  else
    std::printf("%s is down\n", cluster->machine.c_str());
  return 0;
}

}  // namespace

void add_down_command(CLI::App& app, Common& common) {
  auto name = std::make_shared<std::string>();
  add_command(app, common, "down",
              "Stop a cluster (of several hosts: the part on this one); nothing of it is left but its state",
              [&common, name] { return down(common, *name); })
      ->add_option("machine", *name,
                   "Its machine (default: the cluster that was started in this session; of another one it is "
                   "asked at a terminal)");
}

}  // namespace trunnion::cli
