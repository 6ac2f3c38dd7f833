// SPDX-License-Identifier: Apache-2.0
#include "recording/stream_tally.hpp"

#include "bus/codec.hpp"
#include "contracts/types.hpp"

namespace trunnion::recording {

const std::vector<std::string>& StreamTally::cyclic() {
  static const std::vector<std::string> handles = {"path_frame", "kinematics_frame", "compensation_frame",
                                                   "gantry_frame", "feedback_frame"};
  return handles;
}

template <class Frame>
void StreamTally::add_frame(const std::string& handle, std::span<const std::uint8_t> cdr, Frame& frame) {
  if (!bus::decode(cdr, frame)) return;
  coverage_[Key{handle, frame.channel, frame.epoch}].add(frame.first, frame.count, frame.starts, frame.ends);
}

void StreamTally::add(const std::string& handle, std::span<const std::uint8_t> cdr) {
  ++messages_;
  ++by_topic_[handle];
  if (handle == "path_frame") {
    thread_local idl::stream::PathFrame frame;
    add_frame(handle, cdr, frame);
  } else if (handle == "kinematics_frame" || handle == "compensation_frame" || handle == "gantry_frame") {
    thread_local idl::stream::AxisFrame frame;
    add_frame(handle, cdr, frame);
  } else if (handle == "feedback_frame") {
    thread_local idl::stream::FeedbackFrame frame;
    if (bus::decode(cdr, frame)) coverage_[Key{handle, 0, 0}].add(frame.first, frame.count, false, false);
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
