// SPDX-License-Identifier: Apache-2.0
// Two recordings side by side: batches of the stream by cycle, everything else message by message.
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "bus/json.hpp"
#include "verification/stored_recording.hpp"

namespace trunnion::verification {

struct DiffOptions {
  /// Handles; empty: the stream, and what is published when it changes and not by the clock.
  std::set<std::string> topics;
  /// Largest difference of numbers that still counts as equal, by the beginning of the field's name; the
  /// longest that fits holds. Without one, numbers must be the same bits.
  std::map<std::string, double> tolerances;
  /// Fields that do not count, as topic.field.
  std::set<std::string> ignored;
  /// Compare only what both have: cycles, and as many messages as the shorter of two has.
  bool common = false;
  /// Compare the spindles in the stream, too. Their angles count from the start of the drive: only what
  /// follows from the same inputs has the same.
  bool spindles = false;
  /// Rows before and after the first difference that are kept.
  int around = 3;
};

struct FieldDifference {
  std::uint64_t count = 0;        ///< rows
  std::uint64_t first_index = 0;  ///< cycle of the stream, or number of the message from 0
  double largest = 0;             ///< of numbers
  std::uint64_t largest_index = 0;
};

struct TopicDifference {
  std::string topic;  ///< handle
  bool cyclic = false;
  std::uint64_t compared = 0, only_a = 0, only_b = 0;  ///< rows
  std::uint64_t first_only = 0;                        ///< index of the first row that only one has
  std::map<std::string, FieldDifference> fields;
  bool equal() const { return only_a == 0 && only_b == 0 && fields.empty(); }
};

struct Neighbour {
  std::uint64_t index = 0;
  std::string a, b;  ///< empty where there is no such row
};

struct FirstDifference {
  std::string topic, field, series;  ///< series: "channel 0", or the key of the messages
  std::string meaning;               ///< of a field of a spindle: which one, what, unit; else empty
  bool cyclic = false;
  std::uint64_t index = 0;
  std::vector<Neighbour> around;
};

struct Difference {
  std::vector<TopicDifference> topics;   ///< that were compared, in the order of the stream
  std::optional<FirstDifference> first;  ///< the earliest cycle; of one cycle the earliest stage
  std::uint64_t cycles = 0;              ///< rows of the stream that were compared
  bool equal() const { return !first.has_value(); }
};

/// Messages of one topic that repeat the one before them under the same key are one. Of a cycle written in
/// several epochs the newest counts, of replicas the first to arrive.
Difference difference(const std::vector<StoredMessage>& a, const std::vector<StoredMessage>& b,
                      const DiffOptions& options);

/// `a` and `b` are what the two are called.
std::string text_of(const Difference& difference, const std::string& a, const std::string& b);
bus::Json json_of(const Difference& difference);

/// "1e-9" or "actual=1e-4"; throws std::runtime_error when it is neither.
void add_tolerance(DiffOptions& options, const std::string& text);

}  // namespace trunnion::verification
