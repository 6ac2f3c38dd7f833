// SPDX-License-Identifier: Apache-2.0
#include "launcher.hpp"

#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <random>
#include <thread>

#include "cluster/child_process.hpp"
#include "cluster/instances.hpp"
#include "machine/alarm_constants.hpp"
#include "service/node.hpp"

namespace trunnion::launcher {
namespace fs = std::filesystem;
namespace {

constexpr double start_timeout = 15;  // s until a cluster that is not ready has failed
volatile std::sig_atomic_t stop_requested = 0;
void request_stop(int) { stop_requested = 1; }

std::uint32_t instance_on(const LaunchOptions& options) {
  const auto& hosts = options.machine.hosts;
  const auto here =
      std::find_if(hosts.begin(), hosts.end(), [&](const auto& host) { return host.name == options.host; });
  return cluster::launcher_instance +
         static_cast<std::uint32_t>(here == hosts.end() ? 0 : here - hosts.begin());
}

}  // namespace

Launcher::Launcher(LaunchOptions options)
    : options_(std::move(options)),
      bus_(bus::Vendor::cyclonedds, options_.network),
      alarms_(bus_, instance_on(options_), "launcher"),
      states_(bus_.reader(topics::service_state)),
      announcements_(bus_.reader(topics::announcement)),
      resets_(bus_.reader(topics::alarm_reset)),
      cluster_writer_(bus_.writer(topics::cluster)),
      swaps_(bus_, topics::swap_request, topics::swap_reply) {
  struct sigaction action {};
  action.sa_handler = request_stop;
  sigaction(SIGTERM, &action, nullptr);
  sigaction(SIGINT, &action, nullptr);
  signal(SIGPIPE, SIG_IGN);
  fs::create_directories(options_.run.path());
  fs::create_directories(options_.state_directory);
  std::random_device random;
  std::ofstream(options_.state_directory + "/cluster.boot") << random() << random() << "\n";
  for (const auto& entry : options_.machine.services) {
    ServiceProcess process;
    process.entry = entry;
    process.local = entry.host == options_.host;
    process.executable = cluster::binary_directory() + "/" + machine::program_of(options_.machine, entry);
    process.log = options_.run.log_file(
        entry.service + "-" + std::to_string(entry.service == "channel" ? entry.channel : entry.replica));
    processes_.push_back(std::move(process));
  }
}

Launcher::~Launcher() { stop_all(); }

bool Launcher::has_live_twin(const ServiceProcess& process) const {
  return std::any_of(processes_.begin(), processes_.end(), [&](const ServiceProcess& other) {
    return &other != &process && other.entry.service == process.entry.service &&
           other.entry.service != "channel" && other.pid != 0 &&
           other.lifecycle == idl::service::Lifecycle::ACTIVE;
  });
}

void Launcher::lose(ServiceProcess& process, const std::string& how) {
  process.lost = true;
  process.lifecycle = idl::service::Lifecycle::UNCONFIGURED;
  alarms_.raise(has_live_twin(process) ? alarm::redundancy_lost : alarm::service_lost, process.entry.instance,
                "Service " + process.name() + " " + how);
}

// Before the first readiness a process that ended by itself is a failed start, reported in `failure`; one
// that was ended by a signal is started again as later, while `up` waits.
bool Launcher::collect_ended(std::string& failure) {
  for (auto& process : processes_) {
    const auto status = process.local ? process.ended() : std::nullopt;
    if (!status) continue;
    process.lifecycle = idl::service::Lifecycle::UNCONFIGURED;
    process.policy.ended(time_.now());
    if (process.retiring) continue;
    const auto& e = process.entry;
    const std::string how = WIFSIGNALED(*status)
                                ? "was ended by signal " + std::to_string(WTERMSIG(*status))
                                : "ended with status " + std::to_string(WEXITSTATUS(*status));
    if (!was_ready_ && WIFSIGNALED(*status)) {
      ++process.restarts;
      continue;
    }
    if (!was_ready_) {
      const auto line = cluster::last_line(process.log);
      failure = line.empty() ? e.service + " " + how : line;
      return false;
    }
    lose(process, how);
    if (process.policy.gave_up())
      alarms_.raise(alarm::service_not_staying, e.instance,
                    "Service " + process.name() + " does not stay up: it ended " +
                        std::to_string(process.policy.short_lives()) +
                        " times in a row. A reset of the alarms starts it again");
    ++process.restarts;
  }
  return true;
}

// Another host's launcher has put another process in this one's place, or begins anew with the numbers of
// machine.yaml. One that is only compared does not take part yet.
void Launcher::follow(ServiceProcess& process, const idl::service::ServiceState& state, double now) {
  if (process.local || cluster::place_of(state.instance) != cluster::place_of(process.entry.instance) ||
      state.service != process.entry.service || state.lifecycle != idl::service::Lifecycle::ACTIVE ||
      !state.in_step || (process.pid != 0 && state.instance < process.entry.instance))
    return;
  for (const auto* alarm : {&alarm::service_lost, &alarm::redundancy_lost, &alarm::contract_mismatch})
    alarms_.clear(*alarm, process.entry.instance);
  process.lost = false;
  process.entry.instance = state.instance;
  process.entry.vendor = state.vendor;
  process.pid = state.pid;
  process.policy.started(now);
}

bool Launcher::is_candidate(std::uint32_t instance) const {
  return (swap_ && swap_->is_fresh(instance)) ||
         std::any_of(processes_.begin(), processes_.end(), [&](const ServiceProcess& p) {
           return !p.local && cluster::place_of(instance) == cluster::place_of(p.entry.instance) &&
                  instance != p.entry.instance;
         });
}

void Launcher::hear(ServiceProcess& process, const idl::service::ServiceState& state, double now) {
  if (process.entry.instance != state.instance) follow(process, state, now);
  if (process.entry.instance != state.instance) return;
  if (state.service != process.entry.service) {
    alarms_.raise(alarm::machine_differs, state.instance,
                  "Instance " + std::to_string(state.instance) + " is " + process.entry.service +
                      " in this host's machine.yaml, a service " + state.service +
                      " has this number elsewhere");
    return;
  }
  if (!process.local && process.pid != state.pid) {
    if (process.alive) ++process.restarts;
    process.pid = state.pid;
    process.policy.started(now);
  }
  process.hear(state, now);
}

void Launcher::watch_local(ServiceProcess& process, double now) {
  const auto pulse = process.policy.pulse(now);
  if (pulse != Pulse::beating && !process.lost && was_ready_) lose(process, "gives no sign of life");
  if (pulse == Pulse::hung) {
    process.child.signal(SIGKILL);  // replaced like one that died
    process.policy.wait(now);
  }
}

// Silence is all that can be seen of another host. Its own launcher reports a process that died; the first
// host's reports the others' silence, and they report the first host's.
void Launcher::watch_remote(ServiceProcess& process, double now) {
  if (process.pid == 0) return;
  if (process.policy.pulse(now) == Pulse::beating) return;
  process.pid = 0;
  process.lifecycle = idl::service::Lifecycle::UNCONFIGURED;
  process.detail = "host " + process.entry.host + " is silent";
  const auto& first = options_.machine.hosts.front().name;
  if (was_ready_ && (is_first_host() || process.entry.host == first))
    lose(process, "on host " + process.entry.host + " is silent");
}

void Launcher::listen() {
  const double now = time_.now();
  idl::service::ServiceState state;
  while (states_.take(state)) {
    for (auto& process : processes_) hear(process, state, now);
    if (swap_) swap_->hear(state, now);
  }
  idl::service::Announcement announcement;
  while (announcements_.take(announcement)) {
    announced_[announcement.instance] = announcement;
    if (is_candidate(announcement.instance)) continue;  // it is refused, which is no alarm
    if (announcement.contract != topics::contract_hash)
      alarms_.raise(alarm::contract_mismatch, announcement.instance,
                    "Service " + announcement.service + " (" + announcement.version +
                        ") was built with contract " + announcement.contract + ", this cluster with " +
                        topics::contract_hash);
    else
      alarms_.clear(alarm::contract_mismatch, announcement.instance);
  }
  idl::service::AlarmReset reset;
  while (resets_.take(reset)) {
    if (reset.channel != service::all_channels) continue;  // the launcher's alarms are about services
    for (auto& process : processes_) process.policy.retry();
    alarms_.reset();
  }
}

void Launcher::watch() {
  const double now = time_.now();
  for (auto& process : processes_) {
    if (process.retiring) continue;
    if (!process.local) {
      watch_remote(process, now);
    } else if (process.pid == 0) {
      if (process.policy.due(now)) process.start(options_, false, now);
      continue;
    } else {
      watch_local(process, now);
    }
    if (process.lost && process.lifecycle == idl::service::Lifecycle::ACTIVE) {
      process.lost = false;
      alarms_.release(alarm::service_lost, process.entry.instance);
      alarms_.release(alarm::service_not_staying, process.entry.instance);
    }
    // That there are two again needs no acknowledgement.
    if (!process.lost && process.in_step) alarms_.clear(alarm::redundancy_lost, process.entry.instance);
  }
}

bool Launcher::all_ready() const {
  return std::all_of(processes_.begin(), processes_.end(), [](const ServiceProcess& p) {
    return p.pid != 0 && p.lifecycle == idl::service::Lifecycle::ACTIVE;
  });
}

bool Launcher::is_first_host() const {
  return options_.machine.hosts.empty() || options_.machine.hosts.front().name == options_.host;
}

// What `up` waits for: the whole cluster; of several hosts, which start in any order, that the processes of
// this one are alive.
bool Launcher::started() const {
  if (options_.machine.hosts.empty()) return ready_;
  return std::all_of(processes_.begin(), processes_.end(),
                     [](const ServiceProcess& p) { return !p.local || p.alive; });
}

void Launcher::publish() {
  const double now = service::monotonic_seconds();
  const bool ready = all_ready();
  if (ready == ready_ && now - last_published_ < 0.5) return;
  ready_ = ready;
  last_published_ = now;
  idl::service::Cluster cluster;
  cluster.domain = static_cast<std::uint16_t>(options_.machine.domain);
  cluster.machine = options_.machine.name;
  cluster.ready = ready;
  cluster.virtual_time = options_.virtual_time;
  for (const auto& p : processes_)
    cluster.services.push_back({p.entry.instance, p.entry.service, static_cast<std::uint8_t>(p.entry.replica),
                                p.entry.vendor, p.pid, p.restarts,
                                p.pid != 0 && p.lifecycle == idl::service::Lifecycle::ACTIVE});
  if (is_first_host()) cluster_writer_.write(cluster);
}

ServiceProcess* Launcher::whom_to_swap(const idl::service::SwapRequest& request) {
  const auto found = std::find_if(processes_.begin(), processes_.end(), [&](const ServiceProcess& p) {
    return p.entry.service == request.service && p.entry.replica == request.replica &&
           (p.entry.service != "channel" || p.entry.channel == request.channel);
  });
  return found == processes_.end() ? nullptr : &*found;
}

void Launcher::serve_swaps() {
  idl::service::SwapRequest request;
  while (swaps_.take(request)) {
    const auto refuse = [&](const std::string& why) {
      idl::service::SwapReply reply;
      reply.outcome = idl::service::SwapOutcome::REFUSED;
      reply.reason = why.substr(0, 256);
      swaps_.reply(request, reply);
    };
    auto* process = whom_to_swap(request);
    const bool ours = process != nullptr ? process->local : is_first_host();
    if (!ours) {
      // No other host answers.
      if (process != nullptr && process->pid == 0 && is_first_host())
        refuse("Host " + process->entry.host + ", where the " + request.service + " runs, is silent");
      continue;
    }
    if (swap_)
      refuse("Another service is being swapped");
    else if (process == nullptr)
      refuse("The cluster has no " + request.service + " of this number");
    else if (process->pid == 0 || process->lifecycle != idl::service::Lifecycle::ACTIVE)
      refuse("The " + request.service + " that runs now is not active");
    else {
      swap_request_ = request;
      const auto instance =
          cluster::place_of(process->entry.instance) + ++generation_ * cluster::generation_step;
      swap_ = std::make_unique<Swap>(bus_, options_, *process, request, instance, announced_, time_.now());
    }
  }
  if (!swap_) return;
  if (auto reply = swap_->step(time_.now())) {
    swaps_.reply(swap_request_, std::move(*reply));
    swap_.reset();
  }
}

int Launcher::run(void (*report)(const std::string&)) {
  std::ofstream(options_.run.pid_file()) << getpid() << "\n";
  const double began = time_.advance(service::monotonic_seconds());
  for (auto& process : processes_)
    if (process.local) process.start(options_, false, began);
  std::string failure;
  while (stop_requested == 0) {
    bus_.signal().wait(0.02);
    time_.advance(service::monotonic_seconds());
    if (!collect_ended(failure)) break;
    listen();
    watch();
    serve_swaps();
    publish();
    notifier_.alive(service::monotonic_seconds());
    if (!was_ready_ && started()) {
      was_ready_ = true;
      report("");
      notifier_.ready();
    }
    if (!was_ready_ && time_.now() - began > start_timeout) {
      for (const auto& p : processes_)
        if (p.local && p.lifecycle != idl::service::Lifecycle::ACTIVE)
          failure += (failure.empty() ? "not ready: " : "; ") + p.entry.service +
                     (p.detail.empty() ? "" : " (" + p.detail + ")");
      break;
    }
  }
  notifier_.stopping();
  stop_all();
  if (!failure.empty()) report(failure);
  options_.run.remove();
  return failure.empty() ? 0 : 1;
}

void Launcher::stop_all() {
  swap_.reset();
  for (auto it = processes_.rbegin(); it != processes_.rend(); ++it)
    if (it->local) it->child.signal(SIGTERM);
  const double until = service::monotonic_seconds() + 2;
  const auto alive = [&] {
    for (auto& p : processes_)
      if (p.local) p.ended();
    return std::any_of(processes_.begin(), processes_.end(),
                       [](const ServiceProcess& p) { return p.local && p.pid > 0; });
  };
  while (alive() && service::monotonic_seconds() < until)
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  for (auto& p : processes_)
    if (p.local) {
      p.child.kill();
      p.pid = 0;
    }
}

}  // namespace trunnion::launcher
