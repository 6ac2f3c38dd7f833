// SPDX-License-Identifier: Apache-2.0
// Counts what was recorded, and which cycles of the stream are missing from it.
#pragma once

#include <map>
#include <span>
#include <string>
#include <tuple>

#include "bus/registry.hpp"
#include "recording/cycle_coverage.hpp"

namespace trunnion::recording {

class StreamTally {
 public:
  /// A message of the topic `handle`, as it was written to the file.
  void add(const std::string& handle, std::span<const std::uint8_t> cdr);

  std::uint64_t messages() const { return messages_; }
  const std::map<std::string, std::uint64_t>& messages_by_topic() const { return by_topic_; }
  /// Cycles missing between the batches of a topic, over all channels and epochs; every replica fills the
  /// gaps of the other.
  std::uint64_t lost(const std::string& handle) const;
  std::uint64_t cycles(const std::string& handle) const;
  /// The topics whose messages carry cycles.
  static const std::vector<std::string>& cyclic();

  /// Topic handle, channel and epoch; the drive's feedback is one stream, its channel and epoch are 0.
  using Key = std::tuple<std::string, std::uint16_t, std::uint32_t>;
  const std::map<Key, CycleCoverage>& streams() const { return coverage_; }

 private:
  template <class Batch>
  void add_batch(const std::string& handle, std::span<const std::uint8_t> cdr, Batch& batch);

  std::uint64_t messages_ = 0;
  std::map<std::string, std::uint64_t> by_topic_;
  std::map<Key, CycleCoverage> coverage_;
};

}  // namespace trunnion::recording
