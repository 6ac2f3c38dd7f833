#include "cluster.hpp"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <thread>

#include "launcher.hpp"
#include "machine/parameters.hpp"
#include "node/node.hpp"

namespace trunnion::deploy {
namespace fs = std::filesystem;
namespace {

int report_pipe = -1;

void report_to_parent(const std::string& text) {
  if (report_pipe < 0) return;
  const std::string message = text.empty() ? "ready\n" : "error " + text + "\n";
  if (write(report_pipe, message.data(), message.size()) < 0) return;
  close(report_pipe);
  report_pipe = -1;
}

void report_in_foreground(const std::string& text) {
  if (text.empty())
    std::printf("ready\n");
  else
    std::fprintf(stderr, "%s\n", text.c_str());
  std::fflush(stdout);
}

// The daemon: no terminal, no open files but the pipe to its parent.
[[noreturn]] void run_daemon(LaunchOptions options, int pipe) {
  setsid();
  report_pipe = pipe;
  const int null = open("/dev/null", O_RDWR);
  dup2(null, 0);
  const int log = open(options.run.log_file("launcher").c_str(), O_WRONLY | O_CREAT | O_APPEND, 0644);
  dup2(log, 1);
  dup2(log, 2);
  for (int fd = 3; fd < 256; ++fd)
    if (fd != pipe) close(fd);
  fcntl(pipe, F_SETFD, FD_CLOEXEC);
  int status = 1;
  try {
    Launcher launcher(std::move(options));
    status = launcher.run(report_to_parent);
  } catch (const std::exception& e) {
    report_to_parent(e.what());
  }
  _exit(status);
}

}  // namespace

RunningCluster start_cluster(const UpOptions& up) {
  const double began = node::monotonic_seconds();
  LaunchOptions launch;
  launch.machine = machine::load_machine(find_machine(up.machine), up.vendor);
  machine::read_parameter_file(launch.machine.parameters_file());
  if (!up.with_gateway)
    std::erase_if(launch.machine.services, [](const auto& s) { return s.service == "gateway"; });
  if (up.own_domain)
    launch.machine.domain = free_domain();
  else if (up.domain)
    launch.machine.domain = *up.domain;
  launch.run.domain = launch.machine.domain;
  if (const auto pid = launch.run.launcher())
    throw std::runtime_error("a cluster is already running in domain " + std::to_string(launch.run.domain) + " (launcher " + std::to_string(*pid) +
                             "): stop it with 'trunnion down' or choose another --domain");
  fs::create_directories(launch.run.path());
  launch.virtual_time = up.virtual_time.value_or(launch.machine.virtual_time);
  launch.port = up.port.value_or(launch.machine.port);
  launch.state_directory = up.state_directory.empty()          ? default_state_directory(launch.machine.name)
                           : up.state_directory == "temporary" ? launch.run.path() + "/state"
                                                               : fs::absolute(up.state_directory).string();
  RunningCluster cluster{launch.run, launch.machine.name, launch.machine.directory, launch.state_directory, launch.virtual_time,
                         up.with_gateway ? launch.port : std::uint16_t{0}, 0};
  std::ofstream(launch.run.info_file()) << nlohmann::json{{"machine", cluster.machine}, {"machine_directory", cluster.machine_directory}, {"state_directory", cluster.state_directory},
                                                          {"virtual_time", cluster.virtual_time}, {"port", cluster.port}, {"domain", launch.run.domain}}
                                        << "\n";
  if (up.foreground) {
    Launcher launcher(std::move(launch));
    if (launcher.run(report_in_foreground) != 0) throw std::runtime_error("the cluster did not start");
    return cluster;
  }
  int pipes[2];
  if (pipe(pipes) != 0) throw std::runtime_error("no pipe");
  const int pid = fork();
  if (pid == 0) {
    close(pipes[0]);
    if (fork() == 0) run_daemon(std::move(launch), pipes[1]);
    _exit(0);
  }
  close(pipes[1]);
  waitpid(pid, nullptr, 0);
  std::string answer;
  char buffer[512];
  for (ssize_t n; (n = read(pipes[0], buffer, sizeof buffer)) > 0;) answer.append(buffer, static_cast<std::size_t>(n));
  close(pipes[0]);
  while (!answer.empty() && answer.back() == '\n') answer.pop_back();
  if (answer != "ready") {
    for (int i = 0; i < 300 && cluster.run.launcher(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(10));
    cluster.run.remove();
    throw std::runtime_error(answer.rfind("error ", 0) == 0 ? answer.substr(6) : "the launcher ended without a word");
  }
  cluster.start_seconds = node::monotonic_seconds() - began;
  return cluster;
}

void stop_cluster(const RunDirectory& run) {
  const auto pid = run.launcher();
  if (!pid) throw std::runtime_error("no cluster is running in domain " + std::to_string(run.domain));
  kill(*pid, SIGTERM);
  for (int i = 0; i < 800 && kill(*pid, 0) == 0; ++i) std::this_thread::sleep_for(std::chrono::milliseconds(10));
  if (kill(*pid, 0) == 0) throw std::runtime_error("launcher " + std::to_string(*pid) + " does not stop");
  run.remove();
}

RunningCluster find_cluster(std::optional<std::uint32_t> domain) {
  if (!domain) domain = only_running_domain();
  if (!domain) throw std::runtime_error("no cluster is running: start one with 'trunnion up MACHINE'");
  RunningCluster cluster;
  cluster.run.domain = *domain;
  if (!cluster.run.launcher()) throw std::runtime_error("no cluster is running in domain " + std::to_string(*domain));
  std::ifstream in(cluster.run.info_file());
  const auto info = nlohmann::json::parse(in, nullptr, false);
  if (info.is_discarded()) throw std::runtime_error(cluster.run.info_file() + ": cannot be read");
  cluster.machine = info.value("machine", "");
  cluster.machine_directory = info.value("machine_directory", "");
  cluster.state_directory = info.value("state_directory", "");
  cluster.virtual_time = info.value("virtual_time", false);
  cluster.port = info.value("port", std::uint16_t{0});
  return cluster;
}

}  // namespace trunnion::deploy
