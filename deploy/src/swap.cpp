#include "swap.hpp"

#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdio>

#include "cluster_files.hpp"
#include "launcher.hpp"
#include "node/node.hpp"
#include "storage/file.hpp"
#include "stream/stage_names.hpp"
#include "stream/stage_service.hpp"
#include "swap_journal.hpp"

namespace trunnion::deploy {
namespace {

using idl::channel::RunState;
using idl::service::Lifecycle;
using idl::service::SwapReply;

// All in seconds.
constexpr double start_patience = 8;      // until the new process has found the cluster
constexpr double compare_patience = 3;    // without a cycle that both have computed
constexpr double rest_patience = 0.5;     // without a frame: the stream does not move
constexpr double promote_patience = 3;    // until the new one is in step as a twin
constexpr double overlap = 0.15;          // both take part: more than two leads in real time
constexpr double end_patience = 2;        // until a process that is told to end is killed
constexpr double take_over_patience = 5;  // until a service that was told to take over is active

const bus::Topic<idl::stream::AxisFrame>& output_of(stream::Stage stage) {
  return stage == stream::Stage::KINEMATICS     ? topics::kinematics_frame
         : stage == stream::Stage::COMPENSATION ? topics::compensation_frame
                                                : topics::gantry_frame;
}

ServiceProcess make_fresh(const ServiceProcess& old, const idl::service::SwapRequest& request,
                          std::uint32_t instance) {
  ServiceProcess fresh;
  fresh.entry = old.entry;
  fresh.entry.instance = instance;
  if (!request.vendor.empty()) fresh.entry.vendor = request.vendor;
  fresh.executable = request.executable.empty() ? old.executable : request.executable;
  fresh.log = old.log;
  fresh.restarts = old.restarts;
  return fresh;
}

std::string where(const stream::FrameDifference& difference) {
  return "cycle " + std::to_string(difference.cycle) + ", " + difference.values;
}

}  // namespace

Swap::Swap(bus::Bus& bus, const LaunchOptions& options, ServiceProcess& old,
           const idl::service::SwapRequest& request, std::uint32_t instance, const Announcements& announced)
    : bus_(bus),
      options_(options),
      old_(old),
      fresh_(make_fresh(old, request, instance)),
      announced_(announced),
      request_(request),
      stage_(stream::stage_of(old.entry.service)),
      counts_ticks_(old.entry.service == "plc"),
      feedback_(bus.reader(topics::feedback_frame)),
      channels_(bus.reader(topics::channel_state)),
      alarms_(bus.reader(topics::alarm)),
      alarm_writer_(bus.writer(topics::alarm)) {
  began_ = entered_ = moved_ = node::monotonic_seconds();
  if (stage_) {
    auto topic = output_of(*stage_);
    originals_.emplace(bus.reader(topic));
    shadow_topic_ = stream::shadow_name(topic.name);
    topic.name = shadow_topic_.c_str();
    shadows_.emplace(bus.reader(topic));
  }
  if (access(fresh_.executable.c_str(), X_OK) == 0)
    fresh_.start(options_, true);
  else
    fresh_ended_ = true;
}

Swap::~Swap() {
  if (taken_over_ || fresh_.pid == 0) return;
  kill(fresh_.pid, SIGKILL);
  waitpid(fresh_.pid, nullptr, 0);
}

bool Swap::ended(int pid) {
  if (taken_over_ || pid != fresh_.pid) return false;
  fresh_.pid = 0;
  fresh_ended_ = true;
  return true;
}

void Swap::enter(Phase phase, double now) {
  phase_ = phase;
  entered_ = now;
}

void Swap::read() {
  const double now = node::monotonic_seconds();
  idl::stream::FeedbackFrame feedback;
  while (feedback_.take(feedback)) {
    executed_ = std::max(executed_, feedback.first + feedback.count);
    if (counts_ticks_ && feedback.tick > tick_) moved_ = now;
    tick_ = std::max(tick_, feedback.tick);
  }
  idl::channel::ChannelState state;
  while (channels_.take(state)) run_states_[state.channel] = state.state;
  idl::service::Alarm alarm;
  while (alarms_.take(alarm)) {
    const std::array key{alarm.instance, alarm.number, alarm.part};
    if (alarm.active)
      active_alarms_[key] = alarm;
    else
      active_alarms_.erase(key);
  }
  idl::stream::AxisFrame frame;
  while (shadows_ && shadows_->take(frame)) comparison_.shadow(frame);
  while (originals_ && originals_->take(frame)) {
    comparison_.original(frame);
    moved_ = now;
  }
}

// Why the service cannot be replaced now; nothing when it can.
std::optional<std::string> Swap::at_rest() const {
  const auto& service = old_.entry.service;
  if (service != "channel" && service != "drive") return std::nullopt;
  for (const auto& [channel, state] : run_states_)
    if ((service == "drive" || channel == old_.entry.channel) && state != RunState::IDLE &&
        state != RunState::HELD)
      return "The " + service + " can be swapped at rest only: channel " + std::to_string(channel) + " is " +
             bus::to_string(state);
  return std::nullopt;
}

std::uint64_t Swap::compared() const {
  if (!counts_ticks_) return comparison_.equal_cycles();
  // Once it takes part the heartbeat counts other things.
  return phase_ == Phase::starting || phase_ == Phase::comparing ? fresh_.frames_out : compared_before_;
}

std::optional<std::string> Swap::difference() const {
  if (const auto& found = comparison_.first_difference()) return where(*found);
  const std::string mark = node::differs_detail;
  if (!stage_ && fresh_.detail.starts_with(mark)) return fresh_.detail.substr(mark.size());
  return std::nullopt;
}

SwapReply Swap::keep(const std::string& reason) {
  SwapReply reply;
  reply.reason = reason.substr(0, 250);
  reply.compared = static_cast<std::uint32_t>(compared());
  reply.cycle = executed_;
  reply.seconds = node::monotonic_seconds() - began_;
  return reply;
}

void Swap::retire(double now) {
  old_.retiring = true;
  if (old_.pid != 0) kill(old_.pid, SIGTERM);
  retired_at_ = now;
  enter(Phase::retiring, now);
}

// What a process that is gone has raised, nobody else would end.
void Swap::clear_alarms(std::uint32_t instance) {
  for (auto& [key, alarm] : active_alarms_) {
    if (alarm.instance != instance) continue;
    alarm.active = false;
    alarm_writer_.write(alarm);
  }
}

std::optional<SwapReply> Swap::after_start(double now) {
  const auto announced = announced_.find(fresh_.entry.instance);
  if (announced != announced_.end() && announced->second.contract != topics::contract_hash)
    return keep("The new " + old_.entry.service + " was built with contract " + announced->second.contract +
                ", this cluster with " + topics::contract_hash);
  const bool there = announced != announced_.end() && fresh_.detail == node::shadow_detail && fresh_.in_step;
  if (!there) {
    if (now - entered_ > start_patience)
      return keep("The new " + old_.entry.service + " does not find its way into the cluster" +
                  (fresh_.detail.empty() ? "" : ": " + fresh_.detail));
    return std::nullopt;
  }
  if (compares()) {
    compared_at_ = now;
    enter(Phase::comparing, now);
    return std::nullopt;
  }
  if (const auto why = at_rest()) return keep(*why);
  retire(now);
  return std::nullopt;
}

std::optional<SwapReply> Swap::after_comparison(double now) {
  const auto equal = compared();
  if (equal > compared_before_) compared_at_ = now;
  compared_before_ = equal;
  const bool rests = now - moved_ > rest_patience && now - entered_ > rest_patience;
  if (equal < request_.cycles && !rests) {
    if (now - compared_at_ > compare_patience)
      return keep("The new " + old_.entry.service + " does nothing that could be compared");
    return std::nullopt;
  }
  if (counts_ticks_) {
    retire(now);
    return std::nullopt;
  }
  kill(fresh_.pid, SIGUSR1);
  promoted_cycle_ = executed_;
  enter(Phase::promoting, now);
  return std::nullopt;
}

std::optional<SwapReply> Swap::after_retirement(double now) {
  if (old_.pid != 0) {
    if (now - retired_at_ > end_patience) kill(old_.pid, SIGKILL);
    return std::nullopt;
  }
  if (stage_) return done(now);
  kill(fresh_.pid, SIGUSR1);
  promoted_cycle_ = executed_;
  enter(Phase::taking_over, now);
  return std::nullopt;
}

SwapReply Swap::done(double now) {
  clear_alarms(old_.entry.instance);
  const auto side = [&](const ServiceProcess& process) {
    SwapSide result{process.executable, process.entry.vendor, "", ""};
    const auto announced = announced_.find(process.entry.instance);
    if (announced != announced_.end())
      result.version = announced->second.version, result.contract = announced->second.contract;
    return result;
  };
  SwapReply reply = keep("");
  reply.accepted = true;
  reply.cycle = promoted_cycle_;
  reply.seconds = now - began_;
  reply.gap = gap_;
  try {
    append_swap(options_.state_directory, swap_line(request_, reply, side(old_), side(fresh_)));
  } catch (const storage::StorageError& e) {
    reply.reason = e.what();
  }
  old_ = fresh_;
  taken_over_ = true;
  return reply;
}

// Until the old one is told to end nobody depends on the new one, so a second try costs nothing: a vendor's
// library may end a process that begins while others of its topics leave (Fast DDS 2.9: an assertion of its
// reader).
bool Swap::start_again(const char* why, double now) {
  if (started_again_) return false;
  std::fprintf(stderr, "swap: the new %s %s (%s): it is started again\n", old_.entry.service.c_str(), why,
               fresh_.detail.c_str());
  started_again_ = true;
  if (fresh_.pid != 0) {
    kill(fresh_.pid, SIGKILL);
    waitpid(fresh_.pid, nullptr, 0);
    clear_alarms(fresh_.entry.instance);
  }
  fresh_ended_ = false;
  fresh_.detail.clear();
  fresh_.start(options_, true);
  comparison_ = {};
  compared_before_ = 0;
  enter(Phase::starting, now);
  return true;
}

std::optional<SwapReply> Swap::step(double now) {
  read();
  if (fresh_ended_ && !old_.retiring && access(fresh_.executable.c_str(), X_OK) == 0 &&
      start_again("ended", now))
    return std::nullopt;
  if (fresh_ended_) {
    // An old one that has ended already is started again like one that died, only at once.
    const bool gone = old_.retiring;
    old_.retiring = false;
    if (gone) old_.start(options_, false);
    return keep(access(fresh_.executable.c_str(), X_OK) != 0
                    ? fresh_.executable + ": cannot be started"
                    : "The new " + old_.entry.service + " ended: " + last_line(fresh_.log));
  }
  if (const auto what = difference(); what && (phase_ == Phase::starting || phase_ == Phase::comparing))
    return keep("The new " + old_.entry.service + " differs in " + *what +
                " (the first is the running one's)");
  switch (phase_) {
    case Phase::starting:
      return after_start(now);
    case Phase::comparing:
      return after_comparison(now);
    case Phase::promoting:
      if (fresh_.lifecycle != Lifecycle::ACTIVE || !fresh_.in_step) {
        active_at_ = now;
        if (now - entered_ > promote_patience && !start_again("does not take part", now))
          return keep("The new " + old_.entry.service + " does not take part" +
                      (fresh_.detail.empty() ? "" : ": " + fresh_.detail));
      } else if (now - active_at_ > overlap) {
        retire(now);
      }
      return std::nullopt;
    case Phase::retiring:
      return after_retirement(now);
    case Phase::taking_over:
      if (fresh_.lifecycle == Lifecycle::ACTIVE) {
        gap_ = now - retired_at_;
        return done(now);
      }
      if (now - entered_ > take_over_patience) {
        kill(fresh_.pid, SIGKILL);
        waitpid(fresh_.pid, nullptr, 0);
        fresh_.pid = 0;
        fresh_ended_ = true;
      }
      return std::nullopt;
  }
  return std::nullopt;
}

}  // namespace trunnion::deploy
