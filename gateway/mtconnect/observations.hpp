// SPDX-License-Identifier: Apache-2.0
// What an MTConnect agent keeps: observations by sequence number in a ring, and the newest of every item at
// any sequence that is still in it (MTConnect Standard 2.4, part 1, section 5).
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <string>
#include <vector>

namespace trunnion::gateway::mtconnect {

enum class Level { normal, warning, fault, unavailable };

struct Observation {
  std::uint64_t sequence = 0;
  std::uint32_t item = 0;  ///< index of the data item in the device
  std::string time;        ///< ISO 8601, UTC, with milliseconds
  std::string value;       ///< of a sample or an event; text of a condition
  // Of a condition alone:
  Level level = Level::normal;
  std::string code;      ///< identifies one of several that are active together; empty = all of the item
  std::string severity;  ///< of the control
};

/// Newest observation of each item; of a condition one for each active code.
class State {
 public:
  /// Ascending by sequence.
  std::vector<const Observation*> all() const;
  void apply(const Observation& observation, bool is_condition);

 private:
  std::map<std::pair<std::uint32_t, std::string>, Observation> newest_;
};

class Buffer {
 public:
  /// `conditions[i]`: item i is a condition. At least one observation fits.
  Buffer(std::size_t size, std::vector<bool> conditions) : size_(size), conditions_(std::move(conditions)) {}
  /// Gives it the next sequence number.
  void add(Observation observation);
  std::size_t size() const { return size_; }
  std::uint64_t first() const { return kept_.empty() ? next_ : kept_.front().sequence; }
  std::uint64_t next() const { return next_; }
  /// The last one that was given; 0 = none.
  std::uint64_t last() const { return next_ - 1; }
  /// `sequence` from first() to last().
  const Observation& at(std::uint64_t sequence) const { return kept_[sequence - first()]; }
  /// After the observation `sequence`, from first() to last().
  State state(std::uint64_t sequence) const;
  const State& newest() const { return newest_; }

 private:
  std::size_t size_;
  std::vector<bool> conditions_;
  std::deque<Observation> kept_;
  State base_;    ///< before the first kept one
  State newest_;  ///< after the last
  std::uint64_t next_ = 1;
};

}  // namespace trunnion::gateway::mtconnect
