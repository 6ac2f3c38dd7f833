// SPDX-License-Identifier: Apache-2.0
#include "service/node.hpp"

#include <sched.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <csignal>
#include <ctime>
#include <filesystem>

#include "bus/contract.hpp"
#include "machine/alarm_constants.hpp"
#include "machine/services.hpp"
#include "text/instant.hpp"
#include "text/utf8.hpp"
#include "trunnion/version.hpp"

namespace trunnion::service {
namespace {

constexpr double beat_period = 0.25;  // s
volatile std::sig_atomic_t stop_requested = 0;
void request_stop(int) { stop_requested = 1; }

bool real_time_wanted = false;

// Every thread there is by now; those made later inherit from their maker.
void become_real_time() {
  sched_param priority{};
  priority.sched_priority = 20;
  std::error_code ignored;
  for (const auto& task : std::filesystem::directory_iterator("/proc/self/task", ignored))
    sched_setscheduler(std::stoi(task.path().filename()), SCHED_FIFO, &priority);
}

std::string host_name() {
  char name[64] = {};
  gethostname(name, sizeof name - 1);
  return name;
}

}  // namespace

double monotonic_seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

std::string time_of_day() { return text::whole_second(std::time(nullptr)); }

bool use_real_time_scheduling() {
  real_time_wanted = true;
  return mlockall(MCL_CURRENT | MCL_FUTURE) == 0;
}

Node::Node(Options options)
    : options_(std::move(options)),
      bus_(options_.vendor, options_.network),
      alarms_(bus_, options_.instance, options_.service),
      snapshot_desk_(bus_, options_),
      snapshot_(read_snapshot(options_.snapshot)),
      announcement_(bus_.writer(topics::announcement)),
      state_writer_(bus_.writer(topics::service_state)),
      alarm_reset_(bus_.reader(topics::alarm_reset)) {
  stop_requested = 0;
  struct sigaction action {};
  action.sa_handler = request_stop;
  sigaction(SIGTERM, &action, nullptr);
  sigaction(SIGINT, &action, nullptr);
  signal(SIGPIPE, SIG_IGN);
  if (options_.standby) {
    alarms_.mute();
    promotions_.emplace(bus_.reader(topics::promotion));
  }
  if (options_.parent_bound) {
    prctl(PR_SET_PDEATHSIG, SIGTERM);
    if (getppid() == 1) stop_requested = 1;
  }
  started_ = monotonic_seconds();
  state_.instance = options_.instance;
  state_.service = options_.service;
  state_.vendor = bus::to_string(options_.vendor);
  state_.pid = getpid();
  state_.replica = static_cast<std::uint8_t>(options_.replica);
  announce();
}

void Node::announce() {
  announcement_.write({options_.instance, options_.service, bus::to_string(options_.vendor), host_name(),
                       getpid(), bus::contract_of(options_.service), version});
}

void Node::take_promotion() {
  idl::service::Promotion promotion;
  bool promoted = false;
  while (promotions_ && promotions_->take(promotion))
    promoted = promoted || (promotion.instance == options_.instance && promotion.pid == getpid());
  if (!promoted) return;
  options_.standby = false;
  promotions_.reset();
  alarms_.unmute();
}

bool Node::stand_by(Service* standby) {
  Health health;
  health.lifecycle = idl::service::Lifecycle::INACTIVE;
  while (stop_requested == 0 && options_.standby) {
    if (standby != nullptr) standby->pump();
    if (monotonic_seconds() - last_beat_ >= beat_period)
      beat(standby != nullptr ? standby->health() : health);
    bus_.signal().wait(0.005);
    take_promotion();
  }
  return stop_requested == 0;
}

void Node::beat(const Health& health) {
  const double now = monotonic_seconds();
  const double elapsed = now - last_beat_;
  state_.lifecycle = health.lifecycle;
  state_.detail = text::shortened(health.detail, 128);
  state_.messages_in = health.messages_in;
  state_.messages_out = health.messages_out;
  state_.cycles_lost = health.cycles_lost;
  state_.messages_per_second =
      last_beat_ > 0 ? static_cast<double>(health.messages_out - last_messages_) / elapsed : 0;
  state_.revision = health.revision;
  state_.in_step = health.in_step;
  using idl::service::StandbyState;
  state_.standby = !options_.standby            ? StandbyState::TAKES_PART
                   : !health.difference.empty() ? StandbyState::DIFFERING
                   : health.in_step             ? StandbyState::MATCHING
                                                : StandbyState::JOINING;
  state_.compared = health.compared;
  state_.difference = text::shortened(health.difference, 192);
  state_.uptime = now - started_;
  ++state_.beats;
  state_writer_.write(state_);
  if (health.lifecycle == idl::service::Lifecycle::ACTIVE) notifier_.ready();
  last_beat_ = now;
  last_messages_ = health.messages_out;
  bus_.backend().keep_up();
}

void Node::reset_alarms(Service& service, std::uint16_t channel) {
  const auto* definition = machine::find_service(options_.service);
  const bool of_one_channel = definition != nullptr && definition->per_channel;
  if (of_one_channel && channel != all_channels && channel != options_.channel) return;
  service.alarms_reset(channel);
  if (of_one_channel || channel == all_channels) {
    alarms_.reset();
    return;
  }
  alarms_.reset([&](machine::Subject subject, std::uint32_t part) {
    return (subject == machine::Subject::channel && part == channel) ||
           (subject == machine::Subject::axis &&
            service.axis_concerns(static_cast<std::uint16_t>(part), channel));
  });
}

// Counted by the readers, and told here: once for each beat, so that a flood of messages is no flood of
// alarms.
void Node::report_refusals() {
  if (monotonic_seconds() - last_beat_ < beat_period) return;
  std::uint64_t all = 0;
  for (const auto& [topic, refusals] : bus_.refusals()) all += refusals.count;
  if (all == refusals_told_) return;
  std::string text, before;
  for (const auto& [topic, refusals] : bus_.refusals()) {
    auto& told = told_of_[topic];
    if (refusals.count != told) {
      text += (text.empty() ? "" : "; ") + std::to_string(refusals.count - told) + " of " + topic + " from " +
              (refusals.writer == before ? "the same" : refusals.writer) + ", the newest: " + refusals.newest;
      before = refusals.writer;
    }
    told = refusals.count;
  }
  bus_.refusals_told();
  refusals_told_ = all;
  alarms_.raise(alarm::message_refused, options_.instance, options_.service + " refused " + text);
  alarms_.release(alarm::message_refused, options_.instance);
}

int Node::run(Service& service) {
  auto last_lifecycle = idl::service::Lifecycle::UNCONFIGURED;
  while (stop_requested == 0) {
    bus_.signal().wait(std::min(service.period(), beat_period));
    if (stop_requested != 0) break;
    idl::service::AlarmReset reset;
    while (alarm_reset_.take(reset)) reset_alarms(service, reset.channel);
    take_promotion();
    service.pump();
    report_refusals();
    if (!options_.standby) snapshot_desk_.serve(service);
    notifier_.alive(monotonic_seconds());
    if (const double now = monotonic_seconds(); now - last_beat_ >= beat_period) {
      beat(service.health());
    } else if (now - last_beat_ >= 0.02 && service.health().lifecycle != last_lifecycle) {
      last_lifecycle = service.health().lifecycle;
      // Not before: processes that make their participants at the highest priority starve those they wait
      // for.
      if (real_time_wanted && last_lifecycle == idl::service::Lifecycle::ACTIVE) {
        become_real_time();
        real_time_wanted = false;
      }
      beat(service.health());  // a change of lifecycle is news: start-up waits for it
    }
  }
  notifier_.stopping();
  service.end();
  return 0;
}

}  // namespace trunnion::service
