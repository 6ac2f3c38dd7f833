// What the stage computes, without DDS, clock or file: a function of setpoints, parameters and a small state.
#pragma once

#include <vector>

#include "stream/stage_core.hpp"

namespace @IDENTIFIER@ {

/// In the place of the stage @STAGE@. It passes the setpoints on; state: the newest setpoint of every axis,
/// mm or deg.
class Core : public trunnion::stream::StageCore<trunnion::idl::stream::AxisFrame> {
 public:
  void configure(const trunnion::machine::Parameters& parameters, std::uint16_t channel) override;
  bool process(const trunnion::idl::stream::AxisFrame& in, const trunnion::stream::FeedbackWindow& feedback,
               trunnion::idl::stream::AxisFrame& out) override;
  void load(std::span<const double> state) override { newest_.assign(state.begin(), state.end()); }
  void save(trunnion::stream::StateValues& state) const override { state = newest_; }

 private:
  std::vector<double> newest_;  // empty before the first batch
};

}  // namespace @IDENTIFIER@
