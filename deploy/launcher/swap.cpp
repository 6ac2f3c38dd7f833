// SPDX-License-Identifier: Apache-2.0
#include "swap.hpp"

#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdio>

#include "bus/contract.hpp"
#include "bus/registry.hpp"
#include "cluster/child_process.hpp"
#include "machine/service_constants.hpp"
#include "service/node.hpp"
#include "storage/file.hpp"
#include "stream/stage_names.hpp"
#include "stream/stage_service.hpp"
#include "swap_journal.hpp"
#include "text/utf8.hpp"

namespace trunnion::launcher {
namespace {

using idl::channel::RunState;
using idl::service::StandbyState;
using idl::service::SwapOutcome;
using idl::service::SwapReply;

bus::Topic<idl::stream::AxisBatch> output_of(const std::string& service) {
  const auto* entry = bus::find_topic(machine::find_service(service)->output);
  return {entry->description.name.c_str(), entry->description.wire_type.c_str(), entry->qos};
}

Comparison comparison_of(const std::string& service) {
  return stream::stage_of(service)               ? Comparison::batches
         : service == machine::service::plc.name ? Comparison::ticks
                                                 : Comparison::once;
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

SwapOutcome outcome_of(SwapFailure failure) {
  switch (failure) {
    case SwapFailure::no_executable:
    case SwapFailure::ended:
      return SwapOutcome::ENDED;
    case SwapFailure::differs:
      return SwapOutcome::DIFFERENT;
    case SwapFailure::may_not_end:
      return SwapOutcome::REFUSED;
    default:
      return SwapOutcome::NOT_READY;
  }
}

}  // namespace

Swap::Swap(bus::Bus& bus, const LaunchOptions& options, ServiceProcess& old,
           const idl::service::SwapRequest& request, std::uint32_t instance, const Announcements& announced,
           double now)
    : options_(options),
      old_(old),
      fresh_(make_fresh(old, request, instance)),
      announced_(announced),
      request_(request),
      comparison_(comparison_of(old.entry.service)),
      feedback_(bus, topics::feedback),
      channels_(bus.reader(topics::channel_state)),
      alarms_(bus),
      promotions_(bus.writer(topics::promotion)),
      began_(now),
      moved_(began_),
      sequence_(comparison_, request.cycles, began_) {
  if (comparison_ == Comparison::batches) {
    auto topic = output_of(old.entry.service);
    originals_.emplace(bus, topic);
    standby_topic_ = stream::standby_name(topic.name);
    topic.name = standby_topic_.c_str();
    standby_.emplace(bus, topic);
  }
  if (access(fresh_.executable.c_str(), X_OK) == 0) fresh_.start(options_, true, now);
}

Swap::~Swap() {
  if (!succeeded_) fresh_.child.kill();
}

void Swap::read(double now) {
  idl::stream::Feedback feedback;
  while (feedback_.take(feedback)) {
    executed_ = std::max(executed_, feedback.first + feedback.count);
    if (comparison_ == Comparison::ticks && feedback.tick > tick_) moved_ = now;
    tick_ = std::max(tick_, feedback.tick);
    masters_.clear();
    for (const auto& spindle : feedback.spindles) masters_.push_back(spindle.master);
  }
  idl::channel::ChannelState state;
  while (channels_.take(state)) run_states_[state.channel] = state.state;
  alarms_.read();
  idl::stream::AxisBatch batch;
  while (standby_ && standby_->take(batch)) batches_.standby(batch);
  while (originals_ && originals_->take(batch)) {
    batches_.original(batch);
    moved_ = now;
  }
}

// Why the service cannot be replaced now; empty when it can.
std::string Swap::why_not_at_rest() const {
  const auto& service = old_.entry.service;
  if (service != "channel" && service != "drive") return "";
  for (const auto& [channel, state] : run_states_)
    if ((service == machine::service::drive.name || channel == old_.entry.channel) &&
        state != RunState::IDLE && state != RunState::HELD)
      return "The " + service + " can be swapped at rest only: channel " + std::to_string(channel) + " is " +
             bus::to_string(state);
  if (service != machine::service::drive.name) return "";
  // While no drive is there, both spindles turn on by themselves, and a part may be in both.
  for (std::size_t i = 0; i < masters_.size(); ++i)
    if (masters_[i] >= 0)
      return "The drive can be swapped only while no spindle follows another one: spindle " +
             std::to_string(i + 1) + " follows spindle " + std::to_string(masters_[i] + 1) +
             "; end the synchronization first";
  return "";
}

std::string Swap::difference() const {
  if (const auto& found = batches_.first_difference())
    return ("cycle " + std::to_string(found->cycle) + ", " + found->values).substr(0, 192);
  return fresh_.standby == StandbyState::DIFFERING ? fresh_.difference : "";
}

SwapView Swap::view(double now) {
  fresh_.ended();
  SwapView view;
  view.now = now;
  view.executable = access(fresh_.executable.c_str(), X_OK) == 0;
  view.new_runs = fresh_.pid != 0;
  view.old_runs = old_.pid != 0;
  if (const auto announced = announced_.find(fresh_.entry.instance); announced != announced_.end()) {
    view.announced = true;
    view.contract_matches = announced->second.contract == bus::contract_of(old_.entry.service);
  }
  view.standby = fresh_.standby;
  view.lifecycle = fresh_.lifecycle;
  view.in_step = fresh_.in_step;
  view.compared = comparison_ == Comparison::batches ? batches_.equal_cycles() : fresh_.compared;
  view.differs = !difference().empty();
  view.moved = moved_;
  view.may_end = why_not_at_rest().empty();
  return view;
}

void Swap::start_new(double now) {
  std::fprintf(stderr, "swap: the new %s %s: it is started again\n", old_.entry.service.c_str(),
               fresh_.pid == 0 ? "ended" : ("does not take part (" + fresh_.detail + ")").c_str());
  fresh_.child.kill();
  alarms_.end(fresh_.entry.instance);
  fresh_.detail.clear();
  batches_ = {};
  fresh_.start(options_, true, now);
}

void Swap::promote_new() {
  promotions_.write({fresh_.entry.instance, fresh_.pid});
  promoted_cycle_ = executed_;
}

void Swap::end_old() {
  old_.retiring = true;
  old_.child.signal(SIGTERM);
}

std::string Swap::reason(SwapFailure failure) const {
  const auto fresh = "The new " + old_.entry.service;
  const auto detail = fresh_.detail.empty() ? "" : ": " + fresh_.detail;
  switch (failure) {
    case SwapFailure::no_executable:
      return fresh_.executable + ": cannot be started";
    case SwapFailure::ended:
      return fresh + " ended: " + cluster::last_line(fresh_.log);
    case SwapFailure::other_contract:
      return fresh + " was built with contract " + announced_.at(fresh_.entry.instance).contract +
             " of its topics, this cluster with " + bus::contract_of(old_.entry.service);
    case SwapFailure::did_not_join:
      return fresh + " did not reach the state of the running one" + detail;
    case SwapFailure::nothing_to_compare:
      return fresh + " does nothing that could be compared";
    case SwapFailure::differs:
      return fresh + " differs in " + difference() + " (the first is the running one's)";
    case SwapFailure::may_not_end:
      return why_not_at_rest();
    case SwapFailure::takes_no_part:
      return fresh + " does not take part" + detail;
    case SwapFailure::none:
      break;
  }
  return "";
}

SwapReply Swap::reply(double now) const {
  SwapReply reply;
  reply.compared = static_cast<std::uint32_t>(sequence_.compared());
  reply.seconds = now - began_;
  return reply;
}

SwapReply Swap::kept(SwapFailure failure, double now) const {
  auto result = reply(now);
  result.outcome = outcome_of(failure);
  result.reason = text::shortened(reason(failure), 256);
  if (failure == SwapFailure::differs) result.difference = difference();
  result.cycle = executed_;
  return result;
}

SwapReply Swap::succeeded(double now) {
  alarms_.end(old_.entry.instance);
  const auto side = [&](const ServiceProcess& process) {
    SwapSide result{process.executable, process.entry.vendor, "", ""};
    const auto announced = announced_.find(process.entry.instance);
    if (announced != announced_.end())
      result.version = announced->second.version, result.contract = announced->second.contract;
    return result;
  };
  auto result = reply(now);
  result.accepted = true;
  result.outcome = SwapOutcome::SWAPPED;
  result.cycle = promoted_cycle_;
  result.gap = sequence_.gap();
  try {
    append_swap(options_.state_directory, swap_line(request_, result, side(old_), side(fresh_)));
  } catch (const storage::StorageError& e) {
    result.reason = text::shortened(e.what(), 256);
  }
  old_ = std::move(fresh_);
  succeeded_ = true;
  return result;
}

std::optional<SwapReply> Swap::step(double now) {
  read(now);
  const auto step = sequence_.step(view(now));
  switch (step.action) {
    case SwapAction::wait:
      break;
    case SwapAction::start_new:
      start_new(now);
      break;
    case SwapAction::promote_new:
      promote_new();
      break;
    case SwapAction::end_old:
      end_old();
      break;
    case SwapAction::kill_old:
      old_.child.signal(SIGKILL);
      break;
    case SwapAction::kill_new:
      fresh_.child.signal(SIGKILL);
      break;
    case SwapAction::start_old:
      old_.retiring = false;
      old_.start(options_, false, now);
      break;
    case SwapAction::succeed:
      return succeeded(now);
    case SwapAction::fail:
      return kept(step.failure, now);
  }
  return std::nullopt;
}

}  // namespace trunnion::launcher
