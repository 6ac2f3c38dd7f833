// SPDX-License-Identifier: Apache-2.0
#include "launcher.hpp"

#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <random>
#include <thread>

#include "cluster/child_process.hpp"
#include "cluster/cluster.hpp"
#include "cluster/instances.hpp"
#include "machine/alarm_constants.hpp"
#include "machine/gateway_loss.hpp"
#include "machine/service_constants.hpp"
#include "service/node.hpp"

namespace trunnion::launcher {
namespace fs = std::filesystem;
namespace {

constexpr double start_timeout = 15;  // s without another service that is ready until the start has failed
volatile std::sig_atomic_t stop_requested = 0;
void request_stop(int) { stop_requested = 1; }

std::uint32_t instance_on(const LaunchOptions& options) {
  const auto& hosts = options.machine.hosts;
  const auto here =
      std::find_if(hosts.begin(), hosts.end(), [&](const auto& host) { return host.name == options.host; });
  return cluster::launcher_instance +
         static_cast<std::uint32_t>(here == hosts.end() ? 0 : here - hosts.begin());
}

std::vector<std::string> hosts_of(const LaunchOptions& options) {
  std::vector<std::string> names;
  for (const auto& host : options.machine.hosts) names.push_back(host.name);
  return names;
}

// The directories of the locks.
cluster::Identity prepare(const LaunchOptions& options) {
  options.run.make();
  fs::create_directories(options.state_directory);
  return cluster::make_identity(options.machine.name, instance_on(options), options.open());
}

void write_info(const LaunchOptions& options) {
  cluster::RunningCluster cluster;
  cluster.run = options.run;
  cluster.machine = options.machine.name;
  cluster.machine_directory = options.machine.directory;
  cluster.state_directory = options.state_directory;
  cluster.virtual_time = options.virtual_time;
  cluster.port = options.port;
  cluster.host = options.host;
  cluster.network = options.network;
  cluster.open = options.open();
  cluster.session = options.session;
  cluster::write_info(cluster);
}

// Services tell by it whether the cluster was started anew. It is overwritten in place: on a full disk there
// is no space for another one.
void write_boot(const std::string& path) {
  std::random_device random;
  char text[32];
  std::snprintf(text, sizeof text, "%010u%010u\n", random(), random());
  { const std::ofstream created(path, std::ios::app); }
  std::fstream file(path, std::ios::in | std::ios::out);
  file << text << std::flush;
  if (!file) throw std::runtime_error(path + ": cannot be written: " + std::strerror(errno));
  std::error_code ignored;
  std::filesystem::resize_file(path, std::strlen(text), ignored);
}

}  // namespace

Launcher::Launcher(LaunchOptions options)
    : options_(std::move(options)),
      identity_(prepare(options_)),
      owner_(options_.owner),
      domain_lock_(options_.machine.domain, options_.host, identity_),
      state_lock_(options_.state_directory, identity_, options_.machine.domain),
      bus_(bus::Vendor::cyclonedds, options_.network),
      alarms_(bus_, instance_on(options_), "launcher"),
      presence_(bus_, identity_),
      silent_hosts_(hosts_of(options_), options_.host),
      states_(bus_.reader(topics::service_state)),
      announcements_(bus_.reader(topics::announcement)),
      resets_(bus_.reader(topics::alarm_reset)),
      alarms_of_services_(bus_),
      cluster_writer_(bus_.writer(topics::cluster)),
      swaps_(bus_, topics::swap_request, topics::swap_reply) {
  struct sigaction action {};
  action.sa_handler = request_stop;
  sigaction(SIGTERM, &action, nullptr);
  sigaction(SIGINT, &action, nullptr);
  signal(SIGPIPE, SIG_IGN);
  runs_on_without_page_ = machine::load_gateway_loss(options_.machine.directory).has_value();
  // In this order: a directory with the second file and without the first is one that a kill has left.
  std::ofstream(options_.run.pid_file()) << getpid() << "\n";
  write_info(options_);
  write_boot(options_.state_directory + "/cluster.boot");
  for (const auto& entry : options_.machine.services) {
    ServiceProcess process;
    process.entry = entry;
    process.local = entry.host == options_.host;
    process.executable = cluster::binary_directory() + "/" + machine::program_of(options_.machine, entry);
    if (const auto given = options_.executables.find(entry.service); given != options_.executables.end())
      process.executable = given->second;
    process.log = options_.run.log_file(
        entry.service + "-" +
        std::to_string(entry.service == machine::service::channel.name ? entry.channel : entry.replica));
    processes_.push_back(std::move(process));
  }
}

Launcher::~Launcher() { stop_all(); }

bool Launcher::must_stop() const { return stop_requested != 0 || owner_.ended(); }

Loss Launcher::loss_of(const ServiceProcess& process) const {
  if (has_live_twin(process)) return Loss::redundant;
  return runs_on_without_page_ && process.entry.service == machine::service::gateway.name ? Loss::shown
                                                                                          : Loss::holds;
}

bool Launcher::has_live_twin(const ServiceProcess& process) const {
  return std::any_of(processes_.begin(), processes_.end(), [&](const ServiceProcess& other) {
    return &other != &process && other.entry.service == process.entry.service &&
           other.entry.service != "channel" && other.pid != 0 &&
           other.lifecycle == idl::service::Lifecycle::ACTIVE;
  });
}

void Launcher::lose(ServiceProcess& process, const std::string& how) {
  process.lifecycle = idl::service::Lifecycle::UNCONFIGURED;
  process.fault.lose("Service " + process.name() + " " + how, loss_of(process));
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
    alarms_of_services_.end(process.entry.instance);
    const auto& e = process.entry;
    const auto line = cluster::last_line(process.log);
    std::string how = WIFSIGNALED(*status) ? "was ended by signal " + std::to_string(WTERMSIG(*status))
                                           : "ended with status " + std::to_string(WEXITSTATUS(*status));
    if (!was_ready_ && WIFSIGNALED(*status)) {
      ++process.restarts;
      continue;
    }
    if (!was_ready_) {
      failure = line.empty() ? e.service + " " + how : line;
      return false;
    }
    if (WIFEXITED(*status) && WEXITSTATUS(*status) != 0 && !line.empty()) how += ", " + line;
    lose(process, how);
    if (process.policy.gave_up())
      process.fault.give_up("Service " + process.name() + " does not stay up: it ended " +
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
  process.fault = {};
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
    foreign_.heard(state.instance,
                   "Instance " + std::to_string(state.instance) + " is " + process.entry.service +
                       " in this host's machine.yaml, a service " + state.service +
                       " has this number elsewhere",
                   now);
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
  if (pulse != Pulse::beating && !process.fault.lost() && was_ready_) lose(process, "gives no sign of life");
  if (pulse == Pulse::hung) {
    process.child.signal(SIGKILL);  // replaced like one that died
    process.policy.wait(now);
  }
}

// Silence is all that can be seen of another host. Its own launcher reports a process that died.
void Launcher::watch_remote(ServiceProcess& process, double now) {
  if (process.pid == 0) return;
  if (process.policy.pulse(now) == Pulse::beating) return;
  process.pid = 0;
  process.lifecycle = idl::service::Lifecycle::UNCONFIGURED;
  process.detail = "host " + process.entry.host + " is silent";
  if (was_ready_) lose(process, "on host " + process.entry.host + " is silent");
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
    foreign_.announced(announcement, announcements_.info().writer);
  }
  alarms_of_services_.read();
  idl::service::AlarmReset reset;
  while (resets_.take(reset)) {
    if (reset.channel != service::all_channels) continue;  // the launcher's alarms are about services
    for (auto& process : processes_) process.policy.retry();
    alarms_.reset();
    alarms_of_services_.end_of_recorders();
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
    if (process.fault.lost() && process.lifecycle == idl::service::Lifecycle::ACTIVE) process.fault.active();
    if (process.in_step) process.fault.in_step();
  }
  update_alarms(now);
}

void Launcher::add_causes_of_services(double now, std::vector<AlarmCause>& causes) {
  std::vector<RemoteService> remote;
  for (const auto& process : processes_)
    if (process.local)
      process.fault.add_causes(process.entry.instance, causes);
    else
      remote.push_back({process.entry.host, process.name(), process.entry.instance, &process.fault});
  silent_hosts_.add_causes(remote, now, causes);
}

// Alarms about processes belong to what causes them and can be reset when it is gone.
void Launcher::update_alarms(double now) {
  bus_.backend().discover(writers_);
  foreign_.discovered(writers_);
  std::vector<AlarmCause> causes;
  add_causes_of_services(now, causes);
  foreign_.add_causes(now, causes);
  if (const auto other = presence_.other())
    causes.push_back({&alarm::domain_shared, 0,
                      "Domain " + std::to_string(options_.machine.domain) + " is also used by " +
                          cluster::describe(*other, options_.machine.domain) +
                          ": stop one of them, or give one another domain"});
  for (const auto& [alarm, part] : causes_.update(causes)) {
    // That there are two replicas again needs no acknowledgement, nor that a process was replaced by one of
    // this contract.
    if (alarm->number == alarm::redundancy_lost.number)
      alarms_.clear(*alarm, part);
    else
      alarms_.release(*alarm, part);
  }
  for (const auto& cause : causes) alarms_.raise(*cause.alarm, cause.part, cause.text);
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

// On the loopback the lock of the domain excludes others. Elsewhere they are heard; empty when none is.
std::string Launcher::listen_for_others() {
  if (options_.network.interface_address.rfind("127.", 0) == 0) return "";
  const double until = service::monotonic_seconds() + Presence::listening;
  while (service::monotonic_seconds() < until && !must_stop()) {
    presence_.update(service::monotonic_seconds());
    if (const auto other = presence_.other())
      return "domain " + std::to_string(options_.machine.domain) + " is in use by " +
             cluster::describe(*other, options_.machine.domain) +
             ": stop it there, or choose another --domain";
    bus_.signal().wait(0.02);
  }
  return "";
}

// Nothing is left to wait for, and somebody has to correct what keeps a process from taking part.
bool Launcher::faulty() const {
  using idl::service::Lifecycle;
  return std::all_of(processes_.begin(), processes_.end(),
                     [](const ServiceProcess& p) {
                       return p.pid != 0 &&
                              (p.lifecycle == Lifecycle::ACTIVE || p.lifecycle == Lifecycle::FAULT);
                     }) &&
         !all_ready();
}

std::string Launcher::not_ready() const {
  std::string text;
  for (const auto& p : processes_)
    if (p.local && p.lifecycle != idl::service::Lifecycle::ACTIVE)
      text += (text.empty() ? "not ready: " : "; ") + p.entry.service +
              (p.detail.empty() ? "" : " (" + p.detail + ")");
  return text;
}

int Launcher::run(void (*report)(Start, const std::string& why)) {
  if (const auto refusal = listen_for_others(); !refusal.empty()) {
    report(Start::failed, refusal);
    options_.run.remove();
    return 1;
  }
  const double began = time_.advance(service::monotonic_seconds());
  for (auto& process : processes_)
    if (process.local) process.start(options_, false, began);
  std::string failure;
  double progressed = began;
  std::ptrdiff_t most_active = 0;
  while (!must_stop()) {
    bus_.signal().wait(0.02);
    time_.advance(service::monotonic_seconds());
    if (!collect_ended(failure)) break;
    domain_lock_.answer();
    presence_.update(time_.now());
    listen();
    watch();
    serve_swaps();
    publish();
    notifier_.alive(service::monotonic_seconds());
    if (!was_ready_ && (started() || (options_.keep_faulty && faulty()))) {
      was_ready_ = true;
      report(started() ? Start::ready : Start::faulty, not_ready());
      notifier_.ready();
    }
    const auto active = std::count_if(processes_.begin(), processes_.end(), [](const auto& p) {
      return p.local && p.lifecycle == idl::service::Lifecycle::ACTIVE;
    });
    if (active > most_active) most_active = active, progressed = time_.now();
    if (!was_ready_ && (faulty() || time_.now() - progressed > start_timeout)) {
      failure = not_ready();
      break;
    }
  }
  notifier_.stopping();
  stop_all();
  if (!failure.empty()) report(Start::failed, failure);
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
