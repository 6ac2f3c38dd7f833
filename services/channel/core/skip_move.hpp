// SPDX-License-Identifier: Apache-2.0
// A move that a skip input ends (G31): which edge counts, and in which cycle the channel reacts to it.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "contracts/types.hpp"
#include "language/canonical.hpp"
#include "machine/axes.hpp"

namespace trunnion::channel {

using language::AxisValues;

/// The input's edge, in the machine coordinates of the drives.
struct Touch {
  std::uint64_t cycle = 0;
  AxisValues deviation{};  ///< latched position minus what was commanded for `cycle`
};

/// Watches one input during a skip move. Only an edge within the motion counts: one that the
/// feedback reports for the first cycle or before came while the axes were at rest.
class SkipMove {
 public:
  void begin(std::uint32_t input);
  void end() { input_.reset(); }
  bool active() const { return input_.has_value(); }
  /// The motion starts or continues in `cycle`.
  void moves_from(std::uint64_t cycle);
  /// `axes` and `columns`: the channel's axes and their columns in the feedback.
  void on_feedback(const idl::stream::Feedback& feedback, const machine::ChannelAxes& axes,
                   const std::vector<int>& columns);
  /// The setpoint of `cycle` must be the first that brakes, or a later one. An edge of cycle n is answered in
  /// cycle n + lead + 1: by then every channel process has its feedback, however the messages travelled.
  bool brakes_in(std::uint64_t cycle, std::uint64_t lead) const {
    return touch_ && cycle >= touch_->cycle + lead + 1;
  }
  const std::optional<Touch>& touch() const { return touch_; }

 private:
  std::optional<std::uint32_t> input_;
  std::optional<std::uint64_t> from_;
  std::optional<Touch> touch_;
};

}  // namespace trunnion::channel
