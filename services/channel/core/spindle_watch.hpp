// SPDX-License-Identifier: Apache-2.0
// What the feedback says of the spindles: whether one is at rest, so that a tap may be coupled to it, and in
// which gear.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "contracts/types.hpp"

namespace trunnion::channel {

/// A spindle is named by its column in the feedback. One that the drive says nothing of is at rest.
class SpindleWatch {
 public:
  enum class Rest : std::uint8_t {
    rests,
    waits,  ///< the feedback may be older than the PLC's answer that it stands: ask again behind the next one
    turns,
  };
  void on_feedback(const idl::stream::Feedback& feedback);
  Rest rest(std::size_t column);
  /// The last rest() has said so.
  bool waits() const { return waits_; }
  void end() { waits_ = false; }
  /// 1/min, clockwise positive.
  double speed(std::size_t column) const { return column < speeds_.size() ? speeds_[column] : 0; }
  /// In force, from 1; 0 = none.
  std::uint8_t gear(std::size_t column) const {
    return column < gears_.size() ? gears_[column] : std::uint8_t{0};
  }

 private:
  static constexpr double standstill = 5;         // 1/min: at it the PLC finishes M5
  static constexpr std::uint32_t most_waits = 3;  // messages

  std::vector<double> speeds_;
  std::vector<std::uint8_t> gears_;
  bool waits_ = false;
  std::uint32_t messages_ = 0;  // since the first rest() of a wait
};

}  // namespace trunnion::channel
