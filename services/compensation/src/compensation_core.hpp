// SPDX-License-Identifier: Apache-2.0
// Backlash and pitch error compensation, added to the machine setpoints: positive moves positive.
// Source: HNC-8 parameters 30a000..003 and 30a020..026 with tables 70xxxx (docs/spec in
// docs/compensation.md).
#pragma once

#include <vector>

#include "machine/gantry_pairs.hpp"
#include "stream/stage_core.hpp"

namespace trunnion::compensation {

/// A table of errors over the machine coordinate, interpolated linearly; outside the travel the boundary
/// value holds unless the table is modulo.
struct PitchTable {
  bool enabled = false;
  bool bidirectional = false;
  bool modulo = false;
  double start = 0, interval = 1, factor = 1;
  std::vector<double> positive, negative;

  /// mm or deg to add at machine coordinate `x` when moving in direction `positive_direction`.
  double at(double x, bool positive_direction) const;
};

/// The slave of a gantry has its own tables. When it or its master is compensated, its compensated setpoint
/// becomes a column of the frames, behind the channel's axes; gantry then only corrects it.
/// State per axis, slaves last: last uncompensated setpoint, direction of the last move (-1, 0, 1), backlash
/// added now.
class CompensationCore : public stream::StageCore<idl::stream::AxisFrame> {
 public:
  void configure(const machine::Parameters& parameters, std::uint16_t channel) override;
  bool process(const idl::stream::AxisFrame& in, const stream::FeedbackWindow& feedback,
               idl::stream::AxisFrame& out) override;
  void load(std::span<const double> state) override;
  void save(stream::StateValues& state) const override;

 private:
  struct Axis {
    bool active() const { return backlash != 0 || pitch.enabled; }

    double backlash = 0, rate = 0;
    PitchTable pitch;
    double last = 0, direction = 0, added = 0;
  };
  struct Slave {
    machine::GantryPair pair;
    std::size_t master = 0;  // column of its master
  };
  static Axis read_axis(const machine::Parameters& parameters, std::uint32_t number);
  double compensate(Axis& axis, double x) const;

  std::vector<Axis> axes_;     // of the channel, then the slaves
  std::vector<Slave> slaves_;  // those that are compensated
  bool primed_ = false;        // false until the first setpoint gives the axes' positions
};

}  // namespace trunnion::compensation
