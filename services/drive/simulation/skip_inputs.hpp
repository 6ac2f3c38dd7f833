// SPDX-License-Identifier: Apache-2.0
// Simulated skip inputs: switches at a fixed place of an axis, with the latch that a drive has for a probe.
#pragma once

#include <array>
#include <vector>

#include "drive_hardware.hpp"
#include "simulated_axis.hpp"

namespace trunnion::drive {

class SkipInputs {
 public:
  /// `axes` are the columns of the servos. Throws as Parameters::get() does.
  void configure(const machine::Parameters& parameters, const std::vector<machine::AxisInfo>& axes);
  /// The period of row `number` is over. Within it every axis is taken to have moved evenly, so a position is
  /// latched more finely than by the period. The first call only learns where the axes are.
  void step(const std::vector<SimulatedAxis>& servos, std::uint64_t number, EncoderRowSink& rows);

  /// That are on at the end of the newest period: bit 0 = input 1.
  std::uint8_t on() const;

  /// No field, configure() sets it: inputs_.
  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("load", self.load_);
    visit("encoder", self.encoder_);
  }

 private:
  struct Input {
    int column = -1;
    double position = 0;
    double side = 1;
  };
  std::array<Input, 4> inputs_;
  std::vector<double> load_, encoder_;  // at the end of the period before
};

}  // namespace trunnion::drive
