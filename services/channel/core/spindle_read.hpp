// SPDX-License-Identifier: Apache-2.0
// A value of a spindle that a program reads at rest: of which feedback it is. Which spindles are
// synchronized. A signal of the PLC is asked for behind the same wait.
#pragma once

#include <cstdint>
#include <optional>

#include "contracts/types.hpp"

namespace trunnion::channel {

/// The state `number` (canonical/spindle_value.hpp) of a spindle; 0 when the drive says nothing of it.
double spindle_value(const idl::stream::Feedback& feedback, std::uint32_t number);

/// Bit n: spindle n follows another one, or another one follows it.
std::uint32_t synchronized_spindles(const idl::stream::Feedback& feedback);

/// The value is that of the first feedback with the last cycle of the wait that goes before it, however the
/// messages travelled.
class SpindleRead {
 public:
  void begin(std::uint32_t number) {
    number_ = number;
    value_.reset();
  }
  void end() { number_.reset(); }
  bool active() const { return number_.has_value(); }
  /// As begin(), while it is active.
  std::uint32_t number() const { return number_.value_or(0); }
  /// `complete`: the drive has executed the wait.
  void on_feedback(const idl::stream::Feedback& feedback, bool complete) {
    if (active() && complete && !value_) value_ = spindle_value(feedback, *number_);
  }
  const std::optional<double>& value() const { return value_; }

 private:
  std::optional<std::uint32_t> number_;
  std::optional<double> value_;
};

}  // namespace trunnion::channel
