// SPDX-License-Identifier: Apache-2.0
// Starts the processes of a machine, watches them, starts them again, reports what is lost.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "alarms_of_services.hpp"
#include "bus/bus.hpp"
#include "cluster/cluster_locks.hpp"
#include "contracts/topics.hpp"
#include "foreign_services.hpp"
#include "launch_options.hpp"
#include "owner.hpp"
#include "presence.hpp"
#include "service/alarm_board.hpp"
#include "service/notify.hpp"
#include "service/request.hpp"
#include "service/running_time.hpp"
#include "service_process.hpp"
#include "silent_hosts.hpp"
#include "swap.hpp"

namespace trunnion::launcher {

/// How a start has ended. Faulty: every process runs, and one cannot take part until what it names is
/// corrected.
enum class Start { ready, faulty, failed };

/// Runs in a process of its own. `report` is called once, with one line of what is wrong unless the cluster
/// is ready. Returns the exit status.
class Launcher {
 public:
  /// Throws std::runtime_error with one line when another cluster uses the state directory or the domain.
  explicit Launcher(LaunchOptions options);
  ~Launcher();
  int run(void (*report)(Start, const std::string& why));

 private:
  bool must_stop() const;
  void stop_all();
  std::string listen_for_others();
  void update_alarms(double now);
  void add_causes_of_services(double now, std::vector<AlarmCause>& causes);
  std::string refused(const idl::service::SwapRequest& request) const;
  void report_refused(const idl::service::SwapRequest& request, const std::string& why);
  bool collect_ended(std::string& failure);
  void lose(ServiceProcess& process, const std::string& how);
  void listen();
  void watch();
  void hear(ServiceProcess& process, const idl::service::ServiceState& state, double now);
  void follow(ServiceProcess& process, const idl::service::ServiceState& state, double now);
  bool is_candidate(std::uint32_t instance) const;
  void watch_local(ServiceProcess& process, double now);
  void watch_remote(ServiceProcess& process, double now);
  bool all_ready() const;
  bool is_first_host() const;
  bool started() const;
  bool faulty() const;
  std::string not_ready() const;
  void publish();
  bool has_live_twin(const ServiceProcess& process) const;
  Loss loss_of(const ServiceProcess& process) const;
  void serve_swaps();
  ServiceProcess* whom_to_swap(const idl::service::SwapRequest& request);

  LaunchOptions options_;
  cluster::Identity identity_;
  Owner owner_;
  cluster::DomainLock domain_lock_;
  cluster::StateLock state_lock_;
  bus::Bus bus_;
  service::AlarmBoard alarms_;
  Presence presence_;
  ForeignServices foreign_;
  AlarmCauses causes_;
  SilentHosts silent_hosts_;
  std::vector<bus::DiscoveredWriter> writers_;
  bus::Reader<idl::service::ServiceState> states_;
  bus::Reader<idl::service::Announcement> announcements_;
  bus::Reader<idl::service::AlarmReset> resets_;
  AlarmsOfServices alarms_of_services_;
  bus::Writer<idl::service::Cluster> cluster_writer_;
  service::RequestServer<idl::service::SwapRequest, idl::service::SwapReply> swaps_;
  service::Notifier notifier_;
  std::vector<ServiceProcess> processes_;
  std::map<std::uint32_t, idl::service::Announcement> announced_;  // by instance
  std::unique_ptr<Swap> swap_;                                     // the one under way
  idl::service::SwapRequest swap_request_;
  double refusal_written_ = -1;   // when a refused swap was written down last
  std::uint64_t refusals_ = 0;    // since then
  std::uint32_t generation_ = 0;  // swaps that were started on this host
  bool ready_ = false, was_ready_ = false;
  bool runs_on_without_page_ = false;  // machine.yaml names inputs that hold and stop nevertheless
  double last_published_ = 0;
  service::RunningTime time_;  ///< by which silence is measured, and everything of restarts and swaps
};

}  // namespace trunnion::launcher
