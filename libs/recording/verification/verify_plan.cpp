// SPDX-License-Identifier: Apache-2.0
#include "verification/verify_plan.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <stdexcept>

#include "bus/codec.hpp"
#include "cluster/instances.hpp"
#include "contracts/topics.hpp"
#include "machine/alarm_constants.hpp"
#include "machine/parameter_constants.hpp"
#include "machine/parameters.hpp"
#include "machine/services.hpp"
#include "verification/stage_plan.hpp"
#include "verification/tick_plan.hpp"

namespace trunnion::verification {
namespace {

// Published by the clock, or saying who is there: two runs never have the same.
const std::set<std::string>& not_compared() {
  static const std::set<std::string> handles = {
      "announcement", "service_state", "stage_progress", "channel_state", "plc_outputs",
      "plc_image",    "plc_input_log", "alarm",          "cluster",       "variables",
      "plc_watched",  "plc_programs",  "online_reply"};
  return handles;
}

bool names(const std::vector<std::string>& services, const std::string& service) {
  return std::find(services.begin(), services.end(), service) != services.end();
}

// While another channel moves, the cycle at which a channel at rest asks the PLC is the one it has just heard
// of: relative phase of free-running channels is recorded, not computed.
bool has_several_channels(const StoredRecording& recording) {
  std::set<std::uint16_t> channels;
  MessageRows rows;
  for (const auto& message : recording.messages)
    if (message.topic->handle == "path_batch" && rows.load(*message.topic, message.cdr))
      channels.insert(rows.span().channel);
  return channels.size() > 1;
}

// Which outputs of all channels' services are this one's.
class Ownership {
 public:
  Ownership(const StoredRecording& recording, const std::string& service, std::uint16_t channel)
      : only_channel_(service == "channel"), channel_(channel) {
    idl::channel::ChannelRequest request;
    for (const auto& message : recording.messages)
      if (message.topic->handle == "channel_request" && bus::decode(message.cdr, request))
        request_channels_[{request.client, request.number}] = request.channel;
  }
  bool owns(const StoredMessage& message) {
    if (!only_channel_) return true;
    const auto& handle = message.topic->handle;
    if (handle == "path_batch")
      return rows_.load(*message.topic, message.cdr) && rows_.span().channel == channel_;
    if (handle == "stream_request") return bus::decode(message.cdr, stream_) && stream_.channel == channel_;
    if (handle == "auxiliary_request")
      return bus::decode(message.cdr, auxiliary_) && auxiliary_.channel == channel_;
    if (handle == "cycle_request") return bus::decode(message.cdr, cycle_) && cycle_.channel == channel_;
    if (handle == "channel_reply") {
      if (!bus::decode(message.cdr, reply_)) return false;
      if (reply_.client == 1u + channel_) return true;  // outputs of the PLC that it has taken
      const auto found = request_channels_.find({reply_.client, reply_.number});
      return found != request_channels_.end() && found->second == channel_;
    }
    return true;
  }

 private:
  bool only_channel_;
  std::uint16_t channel_;
  std::map<std::pair<std::uint64_t, std::uint64_t>, std::uint16_t> request_channels_;
  MessageRows rows_;
  idl::stream::StreamRequest stream_;
  idl::channel::AuxiliaryRequest auxiliary_;
  idl::channel::CycleRequest cycle_;
  idl::channel::ChannelReply reply_;
};

// When the inputs of a channel took effect. It answers a request, and says of outputs of the PLC that changed
// something (as client 1 + its number, with their tick), before it computes the next cycle: by one clock,
// that of its own outputs. Outputs that others replaced before it read them had no effect. Those that it took
// without a change come behind its answer to the ones before them: their writer may have written them before
// that answer, and fed first they would be answered themselves.
class TimesOfEffect {
 public:
  TimesOfEffect(const StoredRecording& recording, std::uint16_t channel) : channel_(channel) {
    std::vector<const StoredMessage*> by_time;
    for (const auto& message : recording.messages) by_time.push_back(&message);
    std::stable_sort(by_time.begin(), by_time.end(),
                     [](const auto* a, const auto* b) { return a->time < b->time; });
    for (const auto* message : by_time) take(*message);
    for (const auto* message : by_time) see(*message);
  }
  std::uint64_t of(const StoredMessage& message) const {
    const auto found = fed_.find(&message);
    return found == fed_.end() ? message.time : std::max(message.time, found->second);
  }
  bool had_none(const StoredMessage& message) const { return replaced_.contains(&message); }

 private:
  using Control = std::pair<bool, idl::plc::ChannelControl>;

  // What the channel says it has taken: of the outputs of that tick the newest then.
  void take(const StoredMessage& message) {
    if (message.topic->handle == "plc_outputs" && bus::decode(message.cdr, outputs_)) {
      newest_[outputs_.tick] = &message;
    } else if (message.topic->handle == "channel_reply" && bus::decode(message.cdr, reply_)) {
      if (reply_.client != 1u + channel_)
        answered_.try_emplace({reply_.client, reply_.number}, message.time);
      else if (const auto outputs = newest_.find(reply_.number); outputs != newest_.end())
        effects_.try_emplace(outputs->second, message.time);
    }
  }
  void see(const StoredMessage& message) {
    if (message.topic->handle == "channel_request" && bus::decode(message.cdr, request_)) {
      const auto found = answered_.find({request_.client, request_.number});
      if (found != answered_.end()) fed_[&message] = found->second - 1;
    } else if (message.topic->handle == "plc_outputs" && bus::decode(message.cdr, outputs_)) {
      Control control(outputs_.feed_hold, channel_ < outputs_.channels.size() ? outputs_.channels[channel_]
                                                                              : idl::plc::ChannelControl{});
      if (!in_force_ || effects_.contains(&message))
        in_force_ = std::move(control);
      else if (control != *in_force_)
        replaced_.insert(&message);
      keep_order(message);
    }
  }
  void keep_order(const StoredMessage& outputs) {
    const bool answered = effects_.contains(&outputs);
    if (answered) newest_effect_ = effects_.at(&outputs);
    fed_[&outputs] = answered ? newest_effect_ - 1 : newest_effect_ + 1;
  }

  std::uint16_t channel_;
  std::map<std::pair<std::uint64_t, std::uint64_t>, std::uint64_t> answered_;
  std::map<std::uint64_t, const StoredMessage*> newest_;  // outputs by their tick
  std::optional<Control> in_force_;
  std::map<const StoredMessage*, std::uint64_t> effects_;  // of outputs: when the channel answered them
  std::uint64_t newest_effect_ = 0;
  std::map<const StoredMessage*, std::uint64_t> fed_;  // not before this time
  std::set<const StoredMessage*> replaced_;
  idl::channel::ChannelReply reply_;
  idl::channel::ChannelRequest request_;
  idl::plc::Outputs outputs_;
};

// In the order of the recording, each input once the service has written what it had written before it.
class OrderedPlan {
 public:
  OrderedPlan(const StoredRecording& recording, const std::string& service, std::uint16_t channel,
              VerifyPlan& plan)
      : recording_(recording),
        service_(service),
        channel_(channel),
        ownership_(recording, service, channel),
        plan_(plan) {}

  void make() {
    std::vector<std::pair<std::uint64_t, const StoredMessage*>> order;
    std::optional<TimesOfEffect> effects;
    if (service_ == "channel") effects.emplace(recording_, channel_);
    for (const auto& message : recording_.messages)
      if ((!plan_.seed || is_to_come(message)) && !(effects && effects->had_none(message)))
        order.emplace_back(effects ? effects->of(message) : message.time, &message);
    if (plan_.seed)
      for (const auto* message : plan_.seed->needed_to_start(recording_, false))
        if (is_input(*message) && !plan_.topics.contains(message->topic->handle))
          plan_.steps.push_back({message, {}, true});
    std::stable_sort(order.begin(), order.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    Progress progress;
    std::map<Track, Place> raised;  // by outputs since the last step
    for (const auto& [time, message] : order) {
      if (plan_.topics.contains(message->topic->handle) && ownership_.owns(*message)) {
        if (plan_.seed && !plan_.seed->covers(*message)) continue;
        plan_.expected.push_back(*message);
        const auto [mark, further] = progress.observe(*message);
        if (further) raised[mark.track] = mark.place;
        if (message->topic->handle == "feedback" || message->topic->handle == "path_batch")
          count_cycles(*message);
      } else if (is_input(*message)) {
        Step step{message, {}, !is_cyclic(*message->topic)};
        for (const auto& [track, place] : raised) step.needs.push_back({track, place});
        raised.clear();
        plan_.steps.push_back(std::move(step));
      }
    }
    for (const auto& [track, place] : raised) plan_.end.push_back({track, place});
  }

 private:
  bool is_to_come(const StoredMessage& message) const {
    return plan_.seed->covers(message) ||
           (!plan_.seed->had_taken(message) && message.time < plan_.seed->until);
  }
  void count_cycles(const StoredMessage& message) {
    if (rows_.load(*message.topic, message.cdr)) plan_.cycles += rows_.rows();
  }
  bool is_input(const StoredMessage& message) {
    const auto& topic = *message.topic;
    if (!names(topic.readers, service_) && !names(topic.readers, "all")) return false;
    if (topic.handle == "snapshot_request") return false;
    // Replies to the recorded process are for nobody: a new one is answered when it asks.
    if (topic.handle == "program_reply") return false;
    if (topic.handle == "alarm") return bus::decode(message.cdr, alarm_) && alarm_.source != service_;
    if (topic.handle == "service_state")
      return bus::decode(message.cdr, state_) && state_.service != service_;
    return true;
  }

  const StoredRecording& recording_;
  const std::string& service_;
  const std::uint16_t channel_;
  Ownership ownership_;
  VerifyPlan& plan_;
  MessageRows rows_;
  idl::service::Alarm alarm_;
  idl::service::ServiceState state_;
};

}  // namespace

VerifyPlan surroundings(const StoredRecording& recording, const std::string& service, std::uint16_t channel) {
  VerifyPlan plan;
  bool found = false;
  idl::parameters::ParameterSet set;
  idl::service::Cluster cluster;
  for (const auto& message : recording.messages) {
    if (message.topic->handle == "parameter_set" && bus::decode(message.cdr, set)) {
      plan.cycle_seconds = machine::parameters_of(set).get(parameter::interpolation_cycle) * 1e-6;
    } else if (message.topic->handle == "cluster" && bus::decode(message.cdr, cluster)) {
      plan.virtual_time = cluster.virtual_time;
      // Channels are listed in their order; of replicas the first is meant.
      std::uint16_t others = service == "channel" ? channel : 0;
      for (const auto& entry : cluster.services)
        if (entry.service == service && others-- == 0) {
          plan.instance = entry.instance;
          found = true;
          break;
        }
      if (!found)
        for (const auto& entry : cluster.services)
          plan.instance = std::max(plan.instance, entry.instance + 1);
    }
  }
  return plan;
}

namespace {

// Who has made it, in words.
std::string origin_of(const StoredRecording& recording) {
  const auto value = [&](const char* name) {
    const auto found = recording.metadata.find(name);
    return found == recording.metadata.end() ? std::string("unknown") : found->second;
  };
  return "version " + value("version") + ", contract " + value("contract");
}

[[noreturn]] void refuse_empty(const StoredRecording& recording, const std::string& service,
                               std::uint16_t channel, const VerifyPlan& plan) {
  const auto what = "the recording has no output of service " + service +
                    (service == "channel" ? " " + std::to_string(channel) : "") +
                    " that follows from its inputs";
  const bool refused = plan.seed && !plan.seed->refused.empty();
  const auto* stage = find_stage(service);
  if (stage != nullptr && std::ranges::any_of(plan.steps, [stage](const Step& step) {
        return step.message->topic->handle == stage->input;
      }))
    throw std::runtime_error(what + ", of which it has some");
  if (!refused && recording.foreign.empty()) throw NothingToVerify(what + ": it had nothing to do");
  throw std::runtime_error(
      what +
      (refused ? " and came behind its state, which it could not give before: " + plan.seed->refused : "") +
      (recording.foreign.empty() ? ""
                                 : "; it was made with another contract, for " + *recording.foreign.begin() +
                                       " at least: the recording is of " + origin_of(recording)));
}

}  // namespace

void require_contract(const StoredRecording& recording, const std::string& service) {
  // plan_verification() says of others what they are.
  const auto* definition = machine::find_service(service);
  if (definition == nullptr || definition->not_verified) return;
  // What every verification reads: kind of time and instance, the cycle, the state at the beginning.
  const std::set<std::string> always = {"cluster", "parameter_set", "service_snapshot"};
  for (const auto& name : recording.foreign) {
    const auto* topic = bus::find_topic(name);
    if (topic == nullptr) continue;
    const bool compared = names(topic->writers, service) && !not_compared().contains(topic->handle) &&
                          topic->qos != bus::QosKind::event;
    const bool read = names(topic->readers, service) ||
                      (names(topic->readers, "all") && topic->handle != "snapshot_request");
    if (!compared && !read && !always.contains(topic->handle)) continue;
    throw std::runtime_error("the recording is of " + origin_of(recording) + ": service " + service +
                             " uses " + topic->handle +
                             ", which has another form in this version (contract " + topics::contract_hash +
                             "); verify it with the services of that version");
  }
}

VerifyPlan plan_verification(const StoredRecording& recording, const std::string& service,
                             std::uint16_t channel) {
  auto plan = surroundings(recording, service, channel);
  bool exists = false;
  for (const auto& topic : bus::all_topics()) {
    if (!names(topic.writers, service)) continue;
    exists = true;
    // Requests are not: who asks numbers them as it likes, and others ask too.
    if (!not_compared().contains(topic.handle) && topic.qos != bus::QosKind::event)
      plan.topics.insert(topic.handle);
  }
  if (!exists) throw std::runtime_error("no service is called '" + service + "'");
  if (plan.topics.empty())
    throw std::runtime_error("service " + service + " writes nothing that can be compared");
  if (const auto* stage = find_stage(service)) {
    plan_stage(recording, *stage, plan);
  } else {
    if (says_when(service) && !plan.virtual_time)
      throw NothingToVerify("service " + service +
                            " cannot be verified: in real time its periods follow the clock");
    const auto seeds = find_seeds(recording, plan.instance);
    if (says_when(service)) {
      plan_by_tick(recording, service, seeds, plan);
    } else {
      if (!seeds.empty()) plan.seed = seeds.front();
      OrderedPlan(recording, service, channel, plan).make();
    }
  }
  if (service == "channel" && has_several_channels(recording)) plan.ignored.insert("auxiliary_request.cycle");
  if (const auto* definition = machine::find_service(service);
      definition != nullptr && definition->not_verified)
    throw std::runtime_error("service " + service +
                             " is not verified: what it writes depends on its own clock");
  if (plan.expected.empty()) refuse_empty(recording, service, channel, plan);
  return plan;
}

std::size_t VerifyPlan::drop_unrecorded(std::vector<StoredMessage>& produced) const {
  std::map<std::pair<Track, std::uint64_t>, std::pair<std::uint64_t, std::uint64_t>>
      recorded;  // begin and end
  MessageRows rows;
  const auto key = [&](const StoredMessage& message) {
    return std::pair(Track{message.topic, rows.span().channel}, std::uint64_t{rows.span().epoch});
  };
  for (const auto& message : expected) {
    if (!is_cyclic(*message.topic) || !rows.load(*message.topic, message.cdr)) continue;
    const auto first = rows.span().first, after = first + rows.span().count;
    const auto [at, news] = recorded.try_emplace(key(message), first, after);
    at->second = {std::min(at->second.first, first), std::max(at->second.second, after)};
  }
  return std::erase_if(produced, [&](const StoredMessage& message) {
    if (!is_cyclic(*message.topic) || !rows.load(*message.topic, message.cdr)) return false;
    const auto found = recorded.find(key(message));
    return found == recorded.end() || rows.span().first >= found->second.second ||
           rows.span().first + rows.span().count <= found->second.first;
  });
}

std::string missing_feedback(const VerifyPlan& plan) {
  MessageRows rows;
  std::uint64_t end = 0;
  for (const auto& step : plan.steps) {
    if (step.message->topic->handle != "feedback" || !rows.load(*step.message->topic, step.message->cdr))
      continue;
    const auto& span = rows.span();
    if (end != 0 && span.first > end)
      return "the recording misses cycles " + std::to_string(end) + " to " + std::to_string(span.first - 1) +
             " of feedback";
    end = span.first + span.count;
  }
  return "";
}

std::string missing_request(const StoredRecording& recording) {
  std::uint64_t begin = 0;
  std::set<std::pair<std::uint64_t, std::uint64_t>> recorded;
  idl::channel::ChannelRequest request;
  for (const auto& message : recording.messages) {
    if (message.topic->handle == "snapshot_request" && (begin == 0 || message.time < begin))
      begin = message.time;
    if (message.topic->handle == "channel_request" && bus::decode(message.cdr, request))
      recorded.insert({request.client, request.number});
  }
  idl::channel::ChannelReply reply;
  for (const auto& message : recording.messages) {
    if (message.topic->handle != "channel_reply" || message.time < begin || !bus::decode(message.cdr, reply))
      continue;
    // A channel that says what it has taken of the PLC's outputs: 1 + its number, and others draw 64 bits.
    if (reply.client <= 1u + std::numeric_limits<std::uint16_t>::max()) continue;
    if (!recorded.contains({reply.client, reply.number}))
      return "the recording has the reply to request " + std::to_string(reply.number) + " of client " +
             std::to_string(reply.client) + ", but not the request: record again";
  }
  return "";
}

std::string interrupted_network(const StoredRecording& recording) {
  idl::service::Alarm alarm;
  for (const auto& message : recording.messages) {
    if (message.topic->handle != "alarm" || !bus::decode(message.cdr, alarm) || !alarm.active) continue;
    // Of a launcher's number: a host, and not one of its services.
    if (alarm.number != alarm::service_lost.number ||
        cluster::place_of(alarm.part) < cluster::launcher_instance)
      continue;
    return "the network was interrupted (" + alarm.text.substr(0, alarm.text.find(':')) +
           "): when the messages of that time arrived is not in the recording";
  }
  return "";
}

std::map<std::pair<std::uint32_t, std::uint32_t>, std::string> raised_alarms(
    const std::vector<StoredMessage>& messages, const std::string& service) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::string> raised;
  idl::service::Alarm alarm;
  for (const auto& message : messages)
    if (message.topic->handle == "alarm" && bus::decode(message.cdr, alarm) && alarm.active &&
        alarm.source == service)
      raised.try_emplace({alarm.number, alarm.part}, alarm.text);
  return raised;
}

std::string unexpected_alarm(const std::vector<StoredMessage>& recorded,
                             const std::vector<StoredMessage>& produced, const std::string& service) {
  const auto known = raised_alarms(recorded, service);
  for (const auto& [key, text] : raised_alarms(produced, service))
    if (!known.contains(key))
      return "alarm " + std::to_string(key.first) + ", which the recording does not have: " + text;
  return "";
}

}  // namespace trunnion::verification
