// SPDX-License-Identifier: Apache-2.0
// What a recording holds: topics, rates, cycles, gaps, contracts, versions.
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "bus/json.hpp"
#include "recording/cycle_coverage.hpp"
#include "recording/mcap_reader.hpp"
#include "verification/stored_recording.hpp"

namespace trunnion::verification {

struct TopicSummary {
  std::string topic, handle, type;
  Known known = Known::unknown_topic;
  std::uint64_t messages = 0, bytes = 0;
  std::uint64_t missing = 0;  ///< messages the recorder counted and did not write
  std::uint64_t undecodable = 0;
  std::uint64_t first_time = 0, last_time = 0;  ///< ns since the epoch
  /// Messages per second between the first and the last; 0 with fewer than two.
  double rate() const;
};

struct StreamSummary {
  std::string handle;
  std::uint16_t channel = 0;
  std::uint32_t epoch = 0;
  std::uint64_t begin = 0, end = 0, cycles = 0, lost = 0, late = 0, repeated = 0;
  std::vector<recording::CycleRange> gaps;  ///< the first ten
};

struct Summary {
  std::map<std::string, std::string> metadata;  ///< machine, contract, version, domain
  bool same_contract = false;                   ///< as this program's
  bool complete = false;
  std::string problem;
  std::vector<recording::Damage> damages;
  std::map<std::string, std::uint64_t> compressions;  ///< chunks by compression: "zstd", "none"
  std::uint64_t messages = 0, first_time = 0, last_time = 0;
  std::vector<TopicSummary> topics;    ///< by handle
  std::vector<StreamSummary> streams;  ///< by topic in the order of the stream, channel and epoch
  std::set<std::string> participants;  ///< "service vendor version contract", as announced
  std::set<std::uint64_t> revisions;   ///< of the parameters
  /// Services that were asked for their state and have not given it, with the reason when they said one.
  std::vector<std::string> without_state;
  double seconds() const { return static_cast<double>(last_time - first_time) * 1e-9; }
};

Summary summarize(recording::Source& source);
std::string text_of(const Summary& summary);
bus::Json json_of(const Summary& summary);

}  // namespace trunnion::verification
