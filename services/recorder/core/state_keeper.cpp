// SPDX-License-Identifier: Apache-2.0
#include "state_keeper.hpp"

#include "bus/codec.hpp"
#include "contracts/types.hpp"
#include "stream/whole_batch.hpp"

namespace trunnion::recorder {
namespace {
// Of feedback: more than the longest lead, by which a stage looks back.
constexpr std::uint64_t kept_rows = 1024;
constexpr std::size_t kept_feedback = 512;  // messages
}  // namespace

void StateKeeper::see(const Message& message) {
  const auto& topic = *topics_.at(message.topic);
  if (topic.handle == "feedback") see_feedback(message);
  if (topic.qos != bus::QosKind::state) return;
  bus::KeyHash key{};
  // Bytes that are not of the type have no key; they are in the recording all the same.
  if (topic.description.keyed && !topic.description.key_of(message.cdr, key)) return;
  newest_[{message.topic, key}] = message;
}

void StateKeeper::see_feedback(const Message& message) {
  idl::stream::Feedback batch;
  if (!bus::decode(message.cdr, batch) || !stream::fault_of(batch).empty()) return;
  feedback_.push_back({message, batch.count});
  rows_ += batch.count;
  while (feedback_.size() > kept_feedback || rows_ - feedback_.front().rows >= kept_rows) {
    rows_ -= feedback_.front().rows;
    feedback_.pop_front();
  }
}

std::vector<const Message*> StateKeeper::states() const {
  std::vector<const Message*> result;
  for (const auto& [key, message] : newest_) result.push_back(&message);
  for (const auto& feedback : feedback_) result.push_back(&feedback.message);
  return result;
}

}  // namespace trunnion::recorder
