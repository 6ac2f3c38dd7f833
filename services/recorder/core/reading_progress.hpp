// SPDX-License-Identifier: Apache-2.0
// Which cycles a recorder will still read before they are overwritten. No DDS, no clock.
#pragma once

#include <cstdint>
#include <optional>

#include "contracts/types.hpp"

namespace trunnion::recorder {

/// Follows the feedback: it has the most bytes for each cycle of all batches, and the drive writes it last.
class ReadingProgress {
 public:
  /// `recorder` tells recorders apart.
  explicit ReadingProgress(std::uint64_t recorder) { report_.recorder = recorder; }

  /// A batch of feedback that was read, and its size on the bus.
  void read(const idl::stream::Feedback& feedback, std::size_t bytes);
  /// What has to be published; none when it was already.
  std::optional<idl::stream::RecordingProgress> take();
  /// The report that nobody has to wait for this recorder any more.
  idl::stream::RecordingProgress ended() const;

  /// Cycles. A motion needs the least to go on while the recorder reads; the most is three quarters of
  /// what a writer keeps for readers by DDS: 1024 batches of 16 cycles.
  static constexpr std::uint64_t least = 1024, most = 12288;

 private:
  idl::stream::RecordingProgress report_;
  std::uint64_t bytes_per_cycle_ = 1;
  bool news_ = false;
};

}  // namespace trunnion::recorder
