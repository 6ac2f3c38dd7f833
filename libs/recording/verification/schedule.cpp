// SPDX-License-Identifier: Apache-2.0
#include "verification/schedule.hpp"

#include <algorithm>
#include <map>
#include <tuple>

#include "verification/batch_rows.hpp"

namespace trunnion::verification {

std::vector<Due> schedule(const StoredRecording& recording, const std::set<std::string>& topics,
                          double rate) {
  using Place = std::pair<std::uint32_t, std::uint64_t>;
  using Lane = std::pair<const bus::TopicEntry*, std::uint16_t>;
  struct Slots {
    std::vector<std::size_t> at;  // in `order`
    std::vector<std::pair<Place, const StoredMessage*>> batches;
  };
  std::vector<const StoredMessage*> order;
  for (const auto& message : recording.messages)
    if (topics.empty() || topics.contains(message.topic->handle)) order.push_back(&message);
  std::stable_sort(order.begin(), order.end(),
                   [](const auto* a, const auto* b) { return a->time < b->time; });
  std::vector<std::uint64_t> times;
  for (const auto* message : order) times.push_back(message->time);

  // Batches that came out of order change places among themselves.
  std::map<Lane, Slots> lanes;
  MessageRows rows;
  for (std::size_t i = 0; i < order.size(); ++i) {
    if (!is_cyclic(*order[i]->topic) || !rows.load(*order[i]->topic, order[i]->cdr)) continue;
    auto& lane = lanes[{order[i]->topic, rows.span().channel}];
    lane.at.push_back(i);
    lane.batches.push_back({{rows.span().epoch, rows.span().first}, order[i]});
  }
  for (auto& [key, lane] : lanes) {
    std::stable_sort(lane.batches.begin(), lane.batches.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    for (std::size_t i = 0; i < lane.at.size(); ++i) order[lane.at[i]] = lane.batches[i].second;
  }

  // A state that was there before was written long ago; the recording begins with what was written after it.
  std::uint64_t begin = times.empty() ? 0 : times.back();
  for (std::size_t i = 0; i < order.size(); ++i)
    if (is_cyclic(*order[i]->topic) || order[i]->topic->qos == bus::QosKind::event)
      begin = std::min(begin, times[i]);
  std::vector<Due> result;
  for (std::size_t i = 0; i < order.size(); ++i)
    result.push_back({order[i], times[i] <= begin ? 0 : static_cast<double>(times[i] - begin) * 1e-9 / rate});
  return result;
}

}  // namespace trunnion::verification
