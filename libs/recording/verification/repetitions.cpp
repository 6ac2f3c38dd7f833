// SPDX-License-Identifier: Apache-2.0
#include "verification/repetitions.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "bus/codec.hpp"
#include "contracts/topics.hpp"

namespace trunnion::verification {
namespace {

using Key = std::pair<std::uint64_t, std::uint64_t>;  // client and number

template <class T>
bool is_of(const StoredMessage& message, const bus::Topic<T>& topic) {
  return message.topic->description.name == topic.name;
}

// Source times of the messages that services say they have applied.
std::set<std::uint64_t> applied_times(const std::vector<StoredMessage>& messages) {
  std::set<std::uint64_t> times;
  idl::stream::Feedback feedback;
  idl::stream::InputLog log;
  for (const auto& message : messages) {
    if (is_of(message, topics::feedback) && bus::decode(message.cdr, feedback)) {
      for (const auto& applied : feedback.applied) times.insert(applied.identity);
    } else if (is_of(message, topics::plc_input_log) && bus::decode(message.cdr, log)) {
      for (const auto& applied : log.applied) times.insert(applied.identity);
    }
  }
  return times;
}

template <class Request, class Reply>
void drop(const std::vector<StoredMessage>& messages, const bus::Topic<Request>& request_topic,
          const bus::Topic<Reply>& reply_topic, const std::set<std::uint64_t>& applied,
          std::vector<bool>& dropped) {
  std::map<Key, std::size_t> kept;
  Request request;
  for (std::size_t i = 0; i < messages.size(); ++i) {
    if (!is_of(messages[i], request_topic) || !bus::decode(messages[i].cdr, request)) continue;
    const auto [at, first] = kept.try_emplace({request.client, request.number}, i);
    if (first) continue;
    const bool better = applied.contains(messages[i].time) && !applied.contains(messages[at->second].time);
    dropped[better ? std::exchange(at->second, i) : i] = true;
  }
  std::set<Key> answered;
  Reply reply;
  for (std::size_t i = 0; i < messages.size(); ++i) {
    if (!is_of(messages[i], reply_topic) || !bus::decode(messages[i].cdr, reply)) continue;
    const Key key(reply.client, reply.number);
    if (kept.contains(key) && !answered.insert(key).second) dropped[i] = true;
  }
}

}  // namespace

void drop_repetitions(std::vector<StoredMessage>& messages) {
  const auto applied = applied_times(messages);
  std::vector<bool> dropped(messages.size());
  drop(messages, topics::channel_request, topics::channel_reply, applied, dropped);
  drop(messages, topics::panel_request, topics::panel_reply, applied, dropped);
  drop(messages, topics::online_request, topics::online_reply, applied, dropped);
  drop(messages, topics::parameter_request, topics::parameter_reply, applied, dropped);
  drop(messages, topics::program_request, topics::program_reply, applied, dropped);
  drop(messages, topics::measurement_request, topics::measurement_reply, applied, dropped);
  std::size_t i = 0;
  std::erase_if(messages, [&](const StoredMessage&) { return dropped[i++]; });
}

}  // namespace trunnion::verification
