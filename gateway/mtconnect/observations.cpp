// SPDX-License-Identifier: Apache-2.0
#include "mtconnect/observations.hpp"

#include <algorithm>

namespace trunnion::gateway::mtconnect {

std::vector<const Observation*> State::all() const {
  std::vector<const Observation*> list;
  for (const auto& [key, observation] : newest_) list.push_back(&observation);
  std::ranges::sort(list, {}, &Observation::sequence);
  return list;
}

void State::apply(const Observation& observation, bool is_condition) {
  const auto begin = newest_.lower_bound({observation.item, ""});
  const auto end = newest_.lower_bound({observation.item + 1, ""});
  const bool active = observation.level == Level::warning || observation.level == Level::fault;
  if (!is_condition || observation.code.empty()) {
    newest_.erase(begin, end);
    newest_[{observation.item, ""}] = observation;
    return;
  }
  newest_.erase({observation.item, ""});  // normal or unavailable as a whole
  newest_.erase({observation.item, observation.code});
  if (active) {
    newest_[{observation.item, observation.code}] = observation;
    return;
  }
  const auto left = newest_.lower_bound({observation.item, ""});
  if (left != newest_.end() && left->first.first == observation.item) return;
  auto normal = observation;  // the last active one has gone
  normal.code.clear();
  normal.severity.clear();
  normal.value.clear();
  newest_[{observation.item, ""}] = std::move(normal);
}

void Buffer::add(Observation observation) {
  observation.sequence = next_++;
  const bool is_condition = conditions_.at(observation.item);
  newest_.apply(observation, is_condition);
  kept_.push_back(std::move(observation));
  if (kept_.size() <= size_) return;
  base_.apply(kept_.front(), conditions_[kept_.front().item]);
  kept_.pop_front();
}

State Buffer::state(std::uint64_t sequence) const {
  auto state = base_;
  for (const auto& observation : kept_) {
    if (observation.sequence > sequence) break;
    state.apply(observation, conditions_[observation.item]);
  }
  return state;
}

}  // namespace trunnion::gateway::mtconnect
