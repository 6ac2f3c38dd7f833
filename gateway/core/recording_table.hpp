// SPDX-License-Identifier: Apache-2.0
// The executed cycles of a recording as CSV, part by part: what the page's analysis opens.
#pragma once

#include <memory>

#include "contracts/types.hpp"
#include "core/body_source.hpp"
#include "recording/mcap_reader.hpp"

namespace trunnion::gateway {

/// A line of names, then a line for each cycle of the topic feedback: cycle, commanded[i] and actual[i]
/// of each axis of the drive (mm, deg) and, on the last line of each batch, velocity[i] (mm/s, deg/s) and
/// torque[i] (fraction of the rated one). Numbers read back to the same bits. The names of `trunnion export`.
class RecordingTable final : public BodySource {
 public:
  /// Bytes of a part, at least.
  static constexpr std::size_t part_bytes = 256u << 10;

  explicit RecordingTable(std::unique_ptr<recording::Source> source);
  std::optional<std::string> next() override;
  /// Reads the first batch; false when there is none of this program's contract.
  bool begin();
  /// Of the file; empty when it is whole or not read to its end.
  const std::string& problem() const { return reader_.problem(); }

 private:
  /// The next batch into the text; false at the end of the file.
  bool read();
  void add(const idl::stream::Feedback& feedback);

  std::unique_ptr<recording::Source> source_;
  recording::Reader reader_;
  std::optional<std::uint16_t> channel_;  ///< of the topic in the file
  std::uint16_t columns_ = 0;             ///< axes in the first batch
  std::string text_;
};

}  // namespace trunnion::gateway
