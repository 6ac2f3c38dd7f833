// SPDX-License-Identifier: Apache-2.0
#include "cluster/cluster.hpp"

#include <arpa/inet.h>
#include <sys/socket.h>
#include <unistd.h>

#include <csignal>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <thread>
#include <vector>

#include "cluster/child_process.hpp"
#include "cluster/cluster_locks.hpp"
#include "machine/parameters.hpp"
#include "service/network.hpp"
#include "service/node.hpp"

namespace trunnion::cluster {
namespace fs = std::filesystem;
namespace {

std::vector<std::string> launcher_arguments(const UpOptions& up, const RunningCluster& cluster) {
  std::vector<std::string> args{binary_directory() + "/trunnion-launcher",
                                "--machine",
                                cluster.machine_directory,
                                "--state",
                                cluster.state_directory,
                                "--domain",
                                std::to_string(cluster.run.domain),
                                "--port",
                                std::to_string(cluster.port)};
  args.insert(args.end(), {"--host", cluster.host});
  args.insert(args.end(), {"--clock-offset", std::to_string(cluster.network.clock_offset)});
  args.insert(args.end(), {"--session", std::to_string(cluster.session)});
  for (auto& argument : executable_arguments(up.executables)) args.push_back(std::move(argument));
  if (up.one_host) args.emplace_back("--one-host");
  if (up.keep_faulty) args.emplace_back("--keep-faulty");
  if (up.of_this_process) args.insert(args.end(), {"--owner", std::to_string(getpid())});
  if (!up.vendor.empty()) args.insert(args.end(), {"--vendor", up.vendor});
  if (cluster.virtual_time) args.emplace_back("--virtual-time");
  return args;
}

// Reported before anything is started.
void check_hardware(const machine::MachineConfig& config, bool virtual_time) {
  if (config.hardware != machine::Hardware::hal) return;
  if (virtual_time)
    throw std::runtime_error("machine '" + config.name +
                             "' has 'hardware: hal', whose servo thread is the clock: it needs --time real");
  if (!fs::exists(binary_directory() + "/trunnion-drive-hal"))
    throw std::runtime_error(
        "machine '" + config.name +
        "' has 'hardware: hal' and trunnion-drive-hal is not here: install linuxcnc-uspace and "
        "linuxcnc-uspace-dev, then build again (docs/hal.md)");
}

// `down` and the next start remove what is there.
void check_state_directory(const std::string& directory) {
  const auto state = fs::weakly_canonical(directory), runs = fs::weakly_canonical(run_directory_base());
  const auto relative = state.lexically_relative(runs);
  if (!relative.empty() && *relative.begin() != "..")
    throw std::runtime_error(
        "the state directory " + directory + " is below " + runs.string() +
        ", whose files are removed when a cluster stops: choose another one with --state");
}

std::string numbers_of(const std::vector<int>& pids) {
  std::string text;
  for (const int pid : pids) text += (text.empty() ? "" : ", ") + std::to_string(pid);
  return text;
}

// Throws when another cluster uses the state directory or the domain, or when processes of one that was
// killed still run and are not to be ended.
void check_not_in_use(const RunningCluster& cluster, bool take_over) {
  if (const auto holder = domain_holder(cluster.run.domain, cluster.host))
    throw std::runtime_error("domain " + std::to_string(cluster.run.domain) + " is in use by " + *holder +
                             ": stop it with 'trunnion down' or choose another --domain");
  if (const auto holder = state_holder(cluster.state_directory))
    throw std::runtime_error("the state directory " + cluster.state_directory + " is in use by " + *holder +
                             ": stop it with 'trunnion down' or choose another --state");
  // Services end with their launcher; those that are busy take a moment.
  auto left = leftover_services(cluster.state_directory, cluster.run.domain);
  for (int i = 0; i < 250 && !left.empty() && !take_over; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
    left = leftover_services(cluster.state_directory, cluster.run.domain);
  }
  if (left.empty()) return;
  if (!take_over)
    throw std::runtime_error("processes of a cluster whose launcher was killed still use " +
                             cluster.state_directory + " or domain " + std::to_string(cluster.run.domain) +
                             ": " + numbers_of(left) + ". 'trunnion up --take-over' ends them");
  end_processes(left);
}

}  // namespace

void write_info(const RunningCluster& cluster) {
  const auto file = cluster.run.info_file(), fresh = file + ".new";
  std::ofstream(fresh) << nlohmann::json{{"machine", cluster.machine},
                                         {"machine_directory", cluster.machine_directory},
                                         {"state_directory", cluster.state_directory},
                                         {"virtual_time", cluster.virtual_time},
                                         {"port", cluster.port},
                                         {"host", cluster.host},
                                         {"interface", cluster.network.interface_address},
                                         {"peers", cluster.network.peers},
                                         {"multicast", cluster.network.multicast},
                                         {"security", cluster.network.security},
                                         {"clock_offset", cluster.network.clock_offset},
                                         {"open", cluster.open},
                                         {"session", cluster.session},
                                         {"domain", cluster.run.domain}}
                       << "\n";
  fs::rename(fresh, file);  // who reads it meanwhile finds all of it
}

namespace {

// Nobody listens on it now. Another program may take it before the gateway does, which says so then.
std::uint16_t free_port() {
  const int socket = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  socklen_t size = sizeof address;
  const bool found = socket >= 0 && bind(socket, reinterpret_cast<sockaddr*>(&address), size) == 0 &&
                     getsockname(socket, reinterpret_cast<sockaddr*>(&address), &size) == 0;
  if (socket >= 0) close(socket);
  if (!found) throw std::runtime_error("no TCP port is free: " + std::string(std::strerror(errno)));
  return ntohs(address.sin_port);
}

// The directory that free_domain() has made, unless the start is refused.
class Reservation {
 public:
  Reservation(const RunDirectory& run, bool reserved) : run_(run), reserved_(reserved) {}
  ~Reservation() {
    if (reserved_) run_.remove();
  }
  Reservation(const Reservation&) = delete;
  Reservation& operator=(const Reservation&) = delete;
  void keep() { reserved_ = false; }

 private:
  RunDirectory run_;
  bool reserved_;
};

}  // namespace

RunningCluster start_cluster(const UpOptions& up) {
  const double began = service::monotonic_seconds();
  auto config = machine::load_machine(find_machine(up.machine), up.vendor);
  machine::machine_parameters(config);
  if (up.one_host) machine::forget_hosts(config);
  RunningCluster cluster;
  cluster.host = up.host.empty() ? service::local_host(config) : up.host;
  cluster.network = service::network_of(config, cluster.host);
  cluster.run.domain = up.own_domain ? free_domain() : up.domain.value_or(config.domain);
  cluster.network.domain = cluster.run.domain;
  cluster.network.identity = "deploy";
  cluster.network.clock_offset = bus::wall_clock_offset();
  cluster.session = getsid(0);
  cluster.machine = config.name;
  cluster.machine_directory = config.directory;
  cluster.open = !config.hosts.empty() && config.security.empty();
  cluster.virtual_time = up.virtual_time.value_or(config.virtual_time);
  Reservation reservation(cluster.run, up.own_domain);
  check_hardware(config, cluster.virtual_time);
  if (up.with_gateway) cluster.port = up.port.value_or(up.own_domain ? free_port() : config.port);
  cluster.state_directory = up.state_directory.empty()          ? default_state_directory(config.name)
                            : up.state_directory == "temporary" ? cluster.run.path() + "/state"
                                                                : fs::absolute(up.state_directory).string();
  if (up.state_directory != "temporary") check_state_directory(cluster.state_directory);
  check_not_in_use(cluster, up.take_over);
  cluster.run.make();
  reservation.keep();
  auto args = launcher_arguments(up, cluster);
  if (up.foreground) {
    replace_process(args);
    throw std::runtime_error(args[0] + ": cannot be started");
  }
  // The launcher is a program of its own, not a copy of this process: threads and DDS participants do not
  // survive a fork.
  constexpr int report = 3;
  args.insert(args.end(), {"--report", std::to_string(report)});
  ChildOptions options;
  options.arguments = std::move(args);
  options.log = cluster.run.log_file("launcher");
  options.read_from = report;
  options.detached = true;
  auto answer = ChildProcess(options).read_all();
  while (!answer.empty() && answer.back() == '\n') answer.pop_back();
  constexpr std::string_view faulty = "faulty ";
  if (answer.starts_with(faulty)) {
    cluster.fault = answer.substr(faulty.size());
  } else if (answer != "ready") {
    // Another cluster may have taken the domain meanwhile, and the directory is its own then.
    if (!domain_holder(cluster.run.domain, cluster.host)) {
      for (int i = 0; i < 300 && cluster.run.launcher(); ++i)
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
      cluster.run.remove();
    }
    throw std::runtime_error(answer.rfind("error ", 0) == 0 ? answer.substr(6)
                                                            : "the launcher ended without a word");
  }
  cluster.start_seconds = service::monotonic_seconds() - began;
  return cluster;
}

void stop_cluster(const RunDirectory& run) {
  const auto pid = run.launcher();
  if (!pid) throw std::runtime_error("no cluster is running in domain " + std::to_string(run.domain));
  kill(*pid, SIGTERM);
  for (int i = 0; i < 800 && is_launcher(*pid); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  if (is_launcher(*pid)) throw std::runtime_error("launcher " + std::to_string(*pid) + " does not stop");
  run.remove();
}

bus::NetworkSettings network_in(std::uint32_t domain) {
  bus::NetworkSettings network;
  network.domain = domain;
  network.identity = "deploy";
  std::ifstream in(RunDirectory{domain}.info_file());
  const auto info = nlohmann::json::parse(in, nullptr, false);
  if (!info.is_object()) return network;
  network.interface_address = info.value("interface", network.interface_address);
  network.peers = info.value("peers", network.peers);
  network.multicast = info.value("multicast", false);
  network.security = info.value("security", "");
  network.clock_offset = info.value("clock_offset", std::int64_t{0});
  return network;
}

namespace {

std::optional<RunningCluster> read_info(const RunDirectory& run) {
  std::ifstream in(run.info_file());
  const auto info = nlohmann::json::parse(in, nullptr, false);
  if (!info.is_object()) return std::nullopt;
  RunningCluster cluster;
  cluster.run = run;
  cluster.machine = info.value("machine", "");
  cluster.machine_directory = info.value("machine_directory", "");
  cluster.state_directory = info.value("state_directory", "");
  cluster.virtual_time = info.value("virtual_time", false);
  cluster.port = info.value("port", std::uint16_t{0});
  cluster.host = info.value("host", "");
  cluster.open = info.value("open", false);
  cluster.session = info.value("session", 0);
  cluster.network = network_in(run.domain);
  return cluster;
}

}  // namespace

std::vector<RunningCluster> running_clusters() {
  std::vector<RunningCluster> running;
  for (const auto& run : run_directories())
    if (run.launcher())
      if (auto cluster = read_info(run)) running.push_back(*std::move(cluster));
  return running;
}

RunningCluster find_cluster(std::optional<std::uint32_t> domain) {
  auto found = running_clusters();
  if (domain) std::erase_if(found, [&](const auto& cluster) { return cluster.run.domain != *domain; });
  if (found.size() > 1) throw std::runtime_error("several clusters are running: say which with --domain");
  if (!found.empty()) return found.front();
  for (const auto& run : run_directories())
    if (run.abandoned() && (!domain || run.domain == *domain))
      throw std::runtime_error("the launcher of the cluster in domain " + std::to_string(run.domain) +
                               " was killed and its services ended with it; their logs are in " + run.path() +
                               " until 'trunnion down' or the next 'trunnion up'");
  throw std::runtime_error(domain ? "no cluster is running in domain " + std::to_string(*domain)
                                  : "no cluster is running: start one with 'trunnion up MACHINE'");
}

}  // namespace trunnion::cluster
