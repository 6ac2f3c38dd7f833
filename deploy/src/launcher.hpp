// Starts the processes of a machine, watches them, starts them again, says what is lost.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "bus/bus.hpp"
#include "cluster_files.hpp"
#include "contracts/topics.hpp"
#include "machine/machine.hpp"
#include "node/alarm_board.hpp"
#include "node/notify.hpp"
#include "restart_policy.hpp"

namespace trunnion::deploy {

struct LaunchOptions {
  machine::MachineConfig machine;
  std::string state_directory;
  bool virtual_time = false;
  std::uint16_t port = 8080;
  RunDirectory run;
  std::string host;  ///< which of the machine's hosts this is; empty when it has none
  bus::NetworkSettings network;
};

/// Runs in a process of its own. `report` is called once: with "" when the cluster is ready, with one line
/// when it could not be started. Returns the exit status.
class Launcher {
 public:
  explicit Launcher(LaunchOptions options);
  ~Launcher();
  int run(void (*report)(const std::string&));

 private:
  struct Process {
    machine::ServiceEntry entry;
    int pid = 0;
    std::uint32_t restarts = 0;
    RestartPolicy policy;
    idl::service::Lifecycle lifecycle = idl::service::Lifecycle::UNCONFIGURED;
    std::string detail;
    bool lost = false;
    bool in_step = false;  ///< of the process that runs now
    std::string log;
    bool alive = false;  ///< has beaten since its start
    bool local = true;   ///< on this host; of the others only their heartbeats are known
  };
  void start(Process& process);
  void stop_all();
  bool reap(std::string& failure);
  void lose(Process& process, const std::string& how);
  void listen();
  void watch();
  void hear(Process& process, const idl::service::ServiceState& state, double now);
  void watch_local(Process& process, double now, bool judge);
  void watch_remote(Process& process, double now, bool judge);
  bool all_ready() const;
  bool is_first_host() const;
  bool begun() const;
  void publish();
  bool has_live_twin(const Process& process) const;

  LaunchOptions options_;
  bus::Bus bus_;
  node::AlarmBoard alarms_;
  bus::Reader<idl::service::ServiceState> states_;
  bus::Reader<idl::service::Announcement> announcements_;
  bus::Reader<idl::service::AlarmReset> resets_;
  bus::Writer<idl::service::Cluster> cluster_writer_;
  node::Notifier notifier_;
  std::vector<Process> processes_;
  std::string start_failure_;
  bool ready_ = false, was_ready_ = false;
  double last_published_ = 0, last_watch_ = 0;
};

/// The last line a service wrote before it ended.
std::string last_line(const std::string& path);

}  // namespace trunnion::deploy
