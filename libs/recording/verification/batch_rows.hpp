// SPDX-License-Identifier: Apache-2.0
// Messages taken apart into named values: batches of the stream cycle by cycle, everything else whole.
#pragma once

#include <string>
#include <vector>

#include "bus/json.hpp"
#include "bus/registry.hpp"
#include "contracts/types.hpp"

namespace trunnion::verification {

struct Field {
  std::string name;
  bus::Json value;  ///< a number, a text or a boolean
  /// Batches cut otherwise do not have it at this cycle: the state of a stage is told after a batch only.
  bool at_batch_end = false;
};

/// Where in the stream a batch belongs. The drive's feedback is one stream of all channels: channel and epoch
/// are 0.
struct BatchSpan {
  std::uint16_t channel = 0;
  std::uint32_t epoch = 0;
  std::uint64_t first = 0;
  std::uint32_t count = 0;
  std::uint64_t revision = 0;
  bool starts = false, ends = false;
};

/// Messages of this topic carry cycles.
bool is_cyclic(const bus::TopicEntry& topic);

/// Decodes one message at a time and hands out its rows. What it has allocated it uses again.
class MessageRows {
 public:
  /// False when the bytes are not of the topic's type. `cdr` is not kept.
  bool load(const bus::TopicEntry& topic, std::span<const std::uint8_t> cdr);
  /// Of a cyclic topic; all zero otherwise.
  const BatchSpan& span() const { return span_; }
  /// A batch: its setpoints. Anything else: 1.
  std::size_t rows() const { return rows_; }
  /// The values of one row: setpoints are named by their axis, sequences by their index.
  void fields(std::size_t row, std::vector<Field>& out) const;
  /// Appends what comparisons leave out: what a batch of feedback tells of its last row.
  void append_uncompared(std::size_t row, std::vector<Field>& out) const;

 private:
  enum class Kind { path, axis, feedback, other };
  Kind kind_ = Kind::other;
  BatchSpan span_;
  std::size_t rows_ = 0;
  idl::stream::PathBatch path_;
  idl::stream::AxisBatch axis_;
  idl::stream::Feedback feedback_;
  bus::Json other_;
};

}  // namespace trunnion::verification
