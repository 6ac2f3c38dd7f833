// SPDX-License-Identifier: Apache-2.0
#include "verification/gateway_plan.hpp"

#include <algorithm>
#include <stdexcept>

#include "bus/codec.hpp"
#include "bus/json.hpp"
#include "contracts/topics.hpp"
#include "storage/crc32.hpp"
#include "verification/shown_state.hpp"

namespace trunnion::verification {
namespace {

using Asker = std::pair<std::uint64_t, std::uint64_t>;  // client and number
using idl::channel::ChannelRequest;

constexpr std::size_t target_bytes = 256;  // as in gateway.idl: a longer one is cut off
constexpr unsigned not_read_to_its_end = 413;
constexpr unsigned still_unanswered = 202, given_up = 504;  // a reply that came later is none

template <class T, class Act>
bool act_on(const StoredMessage& message, const char* handle, Act act) {
  T value;
  if (message.topic->handle != handle || !bus::decode(message.cdr, value)) return false;
  act(value);
  return true;
}

// What is asked of the journal of the parameters service, a file that is not in a recording.
bool is_of_journal(const OperatorLine& line) { return line.target.starts_with("/api/measurement/undo"); }

// Another sender would have got another answer.
bool is_refused_to_sender(const OperatorLine& line) {
  constexpr unsigned no_login = 401, not_permitted = 403, conflict = 409;
  if (line.status == no_login) return true;
  if (line.status == not_permitted) return line.sender != idl::gateway::Sender::FOREIGN_PAGE;
  return line.status == conflict && line.requests == 0 &&
         line.answer.find(" operates this machine: ") != std::string::npos;
}

template <class Act>
bool act_on_request(const StoredMessage& message, Act act) {
  return act_on<ChannelRequest>(message, "channel_request", act) ||
         act_on<idl::plc::PanelRequest>(message, "panel_request", act) ||
         act_on<idl::parameters::ParameterRequest>(message, "parameter_request", act) ||
         act_on<idl::program::ProgramRequest>(message, "program_request", act) ||
         act_on<idl::service::AlarmReset>(message, "alarm_reset", act) ||
         act_on<idl::service::SwapRequest>(message, "swap_request", act);
}

template <class Act>
bool act_on_reply(const StoredMessage& message, Act act) {
  return act_on<idl::channel::ChannelReply>(message, "channel_reply", act) ||
         act_on<idl::plc::PanelReply>(message, "panel_reply", act) ||
         act_on<idl::parameters::ParameterReply>(message, "parameter_reply", act) ||
         act_on<idl::program::ProgramReply>(message, "program_reply", act) ||
         act_on<idl::service::SwapReply>(message, "swap_reply", act);
}

template <class T>
StoredMessage with(const StoredMessage& message, const T& value) {
  StoredMessage changed{message.topic, message.time, message.sequence, {}};
  bus::encode(value, changed.cdr);
  return changed;
}

// The requests of a recording by who asked, in the order of their numbers; of repetitions the first.
std::map<Asker, const StoredMessage*> requests_of(const std::vector<StoredMessage>& messages) {
  std::map<Asker, const StoredMessage*> requests;
  for (const auto& message : messages)
    if (const auto asker = asker_of(message)) {
      auto& first = requests[*asker];
      if (first == nullptr || message.time < first->time) first = &message;
    }
  return requests;
}

class Plan {
 public:
  Plan(const StoredRecording& recording, std::size_t sample_every)
      : recording_(recording), sample_every_(sample_every), requests_(requests_of(recording.messages)) {}

  GatewayPlan make() {
    plan_.outputs = surroundings(recording_, "gateway");
    for (const auto& topic : bus::all_topics())
      if (std::find(topic.writers.begin(), topic.writers.end(), "gateway") != topic.writers.end() &&
          topic.qos == bus::QosKind::event)
        plan_.outputs.topics.insert(topic.handle);
    // Where the operator sits is not the gateway's doing.
    plan_.outputs.ignored.insert("operator_request.address");
    for (const auto& message : recording_.messages) sort(message);
    if (feeds_.empty()) throw std::runtime_error("the recording has nothing that the gateway shows");
    std::stable_sort(lines_.begin(), lines_.end(),
                     [](const auto& a, const auto& b) { return a.begin < b.begin; });
    std::stable_sort(feeds_.begin(), feeds_.end(),
                     [](const auto* a, const auto* b) { return a->time < b->time; });
    weave();
    std::vector<OperatorLine> lines;
    for (const auto& request : plan_.requests) lines.push_back(request.line);
    plan_.outputs.expected = by_line(recording_.messages, lines, false);
    return std::move(plan_);
  }

 private:
  struct Line {
    std::uint64_t begin = 0, written = 0;
    OperatorRequest request;
  };

  void sort(const StoredMessage& message) {
    OperatorLine line;
    if (is_shown(*message.topic)) {
      if (!is_of_gateway(message)) feeds_.push_back(&message);
      act_on<idl::stream::Feedback>(message, "feedback",
                                    [&](const auto& feedback) { plan_.outputs.cycles += feedback.count; });
    } else if (message.topic->handle == "operator_request" && bus::decode(message.cdr, line)) {
      if (auto request = again(line))
        lines_.push_back({begin_of(line, message.time), message.time, std::move(*request)});
      else
        ++plan_.left_out;
    } else {
      act_on_reply(message, [&](const auto& reply) {
        replies_.try_emplace({reply.client, reply.number}, &message);
      });
    }
  }

  // What the recorded process said of itself.
  bool is_of_gateway(const StoredMessage& message) const {
    bool own = false;
    const auto check_own = [&](const auto& value) { own = value.instance == plan_.outputs.instance; };
    act_on<idl::service::Announcement>(message, "announcement", check_own) ||
        act_on<idl::service::ServiceState>(message, "service_state", check_own) ||
        act_on<idl::service::Alarm>(message, "alarm", check_own);
    return own;
  }

  // A request can be sent again when it was answered and all of it is in the recording.
  std::optional<OperatorRequest> again(const OperatorLine& line) const {
    OperatorRequest request{line, line.body, {}};
    if (is_refused_to_sender(line) || is_of_journal(line)) return std::nullopt;
    if (line.status == 0 || line.status == not_read_to_its_end || line.target.size() >= target_bytes)
      return std::nullopt;
    if (line.body.size() != line.body_size) {
      // The parts of an upload.
      for (std::uint32_t i = 0; i < line.requests; ++i)
        if (const auto part = requests_.find({line.client, line.number + i}); part != requests_.end())
          act_on<idl::program::ProgramRequest>(*part->second, "program_request", [&](const auto& upload) {
            request.body.append(upload.data.begin(), upload.data.end());
          });
      if (request.body.size() != line.body_size || storage::crc32(request.body) != line.body_crc32)
        return std::nullopt;
    }
    return request;
  }

  // When the gateway acted on it: its first request on the bus, or the answer when there was none.
  std::uint64_t begin_of(const OperatorLine& line, std::uint64_t written) const {
    const auto first = requests_.find({line.client, line.number});
    return line.requests > 0 && first != requests_.end() ? std::min(first->second->time, written) : written;
  }

  void weave() {
    auto next = lines_.begin();
    for (const auto* message : feeds_) {
      for (; next != lines_.end() && next->begin < message->time; ++next) ask(std::move(*next));
      const bool apart = is_apart(*message);
      if (apart) sample();
      plan_.steps.push_back({GatewayStep::Kind::feed, message, nullptr});
      seen_ = false;
      if (++fed_ % sample_every_ == 0 || apart) sample();
    }
    for (; next != lines_.end(); ++next) ask(std::move(*next));
    sample();
  }

  void sample() {
    if (seen_) return;
    plan_.steps.push_back({GatewayStep::Kind::sample, nullptr, nullptr});
    seen_ = true;
  }

  // Topics have no common order on the way. It matters whether an alarm came before a heartbeat.
  bool is_apart(const StoredMessage& message) {
    if (message.topic->handle == "alarm") return true;
    bool other = false;
    act_on<idl::service::ServiceState>(message, "service_state", [&](const auto& state) {
      const auto [process, fresh] = processes_.try_emplace(state.instance, state.pid);
      other = !fresh && process->second != state.pid;
      process->second = state.pid;
    });
    return other;
  }

  void ask(Line asked) {
    sample();
    auto& request = asked.request;
    const auto& line = request.line;
    const bool unanswered = line.status == still_unanswered || line.status == given_up;
    for (std::uint32_t i = 0; i < line.requests; ++i) {
      const Asker asker{line.client, line.number + i};
      const auto reply = replies_.find(asker);
      const bool came = reply != replies_.end() && !(unanswered && reply->second->time > asked.written);
      request.replies.push_back(came ? std::optional(*reply->second) : std::nullopt);
    }
    plan_.requests.push_back(std::move(request));
    plan_.steps.push_back({GatewayStep::Kind::ask, nullptr, &plan_.requests.back()});
  }

  const StoredRecording& recording_;
  const std::size_t sample_every_;
  GatewayPlan plan_;
  std::map<Asker, const StoredMessage*> requests_, replies_;
  std::vector<Line> lines_;
  std::vector<const StoredMessage*> feeds_;
  std::map<std::uint32_t, std::int32_t> processes_;
  std::size_t fed_ = 0;
  bool seen_ = false;  // nothing has been fed since the last sample
};

}  // namespace

GatewayPlan plan_gateway(const StoredRecording& recording, std::size_t sample_every) {
  return Plan(recording, sample_every).make();
}

std::vector<StoredMessage> by_line(const std::vector<StoredMessage>& messages,
                                   const std::vector<OperatorLine>& lines, bool strays) {
  const auto* journal = bus::find_topic("operator_request");
  auto requests = requests_of(messages);
  std::vector<StoredMessage> out;
  for (std::size_t l = 0; l < lines.size(); ++l) {
    auto line = lines[l];
    for (std::uint32_t i = 0; i < line.requests; ++i) {
      const auto found = requests.find({line.client, line.number + i});
      if (found == requests.end()) continue;
      act_on_request(*found->second, [&](auto& request) {
        request.client = l + 1;
        request.number = i + 1;
        out.push_back(with(*found->second, request));
      });
      requests.erase(found);
    }
    line.line = l + 1;
    line.client = line.requests > 0 ? l + 1 : 0;
    line.number = line.requests > 0 ? 1 : 0;
    out.push_back(with({journal, 0, 0, {}}, line));
  }
  if (strays)
    for (const auto& [asker, message] : requests)
      act_on_request(*message, [&, &stray = *message](auto& request) {
        request.client = 0;
        out.push_back(with(stray, request));
      });
  return out;
}

std::optional<Asker> asker_of(const StoredMessage& message) {
  std::optional<Asker> asker;
  act_on_request(message, [&](const auto& request) { asker = {request.client, request.number}; });
  return asker;
}

bus::Bytes addressed_to(const StoredMessage& reply, const StoredMessage& request) {
  const auto asker = asker_of(request);
  bus::Bytes bytes = reply.cdr;
  if (asker)
    act_on_reply(reply, [&](auto& value) {
      value.client = asker->first;
      value.number = asker->second;
      bus::encode(value, bytes);
    });
  return bytes;
}

const bus::TopicEntry* reply_topic(const bus::TopicEntry& request) {
  const auto at = request.handle.rfind("_request");
  return at == std::string::npos ? nullptr : bus::find_topic(request.handle.substr(0, at) + "_reply");
}

}  // namespace trunnion::verification
