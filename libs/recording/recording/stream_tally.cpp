// SPDX-License-Identifier: Apache-2.0
#include "recording/stream_tally.hpp"

#include "bus/codec.hpp"
#include "contracts/types.hpp"

namespace trunnion::recording {

const std::vector<std::string>& StreamTally::cyclic() {
  static const std::vector<std::string> handles = {"path_batch", "kinematics_batch", "compensation_batch",
                                                   "gantry_batch", "feedback"};
  return handles;
}

template <class Batch>
void StreamTally::add_batch(const std::string& handle, std::span<const std::uint8_t> cdr, Batch& batch) {
  if (!bus::decode(cdr, batch)) return;
  coverage_[Key{handle, batch.channel, batch.epoch}].add(batch.first, batch.count, batch.starts, batch.ends);
}

void StreamTally::add(const std::string& handle, std::span<const std::uint8_t> cdr) {
  ++messages_;
  ++by_topic_[handle];
  if (handle == "path_batch") {
    thread_local idl::stream::PathBatch batch;
    add_batch(handle, cdr, batch);
  } else if (handle == "kinematics_batch" || handle == "compensation_batch" || handle == "gantry_batch") {
    thread_local idl::stream::AxisBatch batch;
    add_batch(handle, cdr, batch);
  } else if (handle == "feedback") {
    thread_local idl::stream::Feedback batch;
    if (bus::decode(cdr, batch)) coverage_[Key{handle, 0, 0}].add(batch.first, batch.count, false, false);
  }
}

std::uint64_t StreamTally::lost(const std::string& handle) const {
  std::uint64_t sum = 0;
  for (const auto& [key, coverage] : coverage_)
    if (std::get<0>(key) == handle) sum += coverage.lost();
  return sum;
}

std::uint64_t StreamTally::cycles(const std::string& handle) const {
  std::uint64_t sum = 0;
  for (const auto& [key, coverage] : coverage_)
    if (std::get<0>(key) == handle) sum += coverage.covered();
  return sum;
}

}  // namespace trunnion::recording
