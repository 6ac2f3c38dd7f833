// SPDX-License-Identifier: Apache-2.0
// Messages taken apart into named values: batches of the stream cycle by cycle, everything else whole.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "bus/json.hpp"
#include "bus/registry.hpp"
#include "contracts/types.hpp"

namespace trunnion::verification {

/// When a batch of feedback was written: the drive may have lived through further periods behind its last
/// row, or have taken inputs.
struct Moment {
  std::uint64_t tick = 0;
  std::size_t taken = 0;  ///< inputs at that tick
  bool operator==(const Moment&) const = default;
};

struct Field {
  std::string name;
  bus::Json value;  ///< a number, a text or a boolean
  /// Batches cut otherwise do not have it at this cycle: the state of a stage is told after a batch only.
  bool at_batch_end = false;
  /// Of what was so when the batch was written: values of different moments are not compared.
  Moment moment{};
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
  /// Appends what it has of spindles: angles cycle by cycle, the rest with the last row of the feedback.
  void append_spindles(std::size_t row, std::vector<Field>& out) const;
  /// Appends what no comparison has: speed and torque of the axes at the last row of the feedback.
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

/// What a field is that append_spindles() has taken from the feedback, with the number of its spindle as the
/// PLC counts (from 1) and its unit: "spindle 2: angle, rev". Empty for other fields.
std::string meaning_of(const std::string& field);

}  // namespace trunnion::verification
