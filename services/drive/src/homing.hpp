// SPDX-License-Identifier: Apache-2.0
// The search for the home switch of one axis: fast to the switch, back off it, slowly to its edge.
#pragma once

#include <cstdint>

#include "drive_hardware.hpp"

namespace trunnion::drive {

class Homing {
 public:
  struct Settings {
    double direction = 1;           ///< 1 or -1: where the switch is searched
    double search = 20, creep = 1;  ///< mm/s or deg/s
    double acceleration = 1000;     ///< mm/s2 or deg/s2
    double travel = 1000;           ///< mm or deg; the search gives up beyond it
    double reference = 0;           ///< machine position of the edge

    template <class Self, class Visit>
    static void fields(Self& self, Visit&& visit) {
      visit("direction", self.direction), visit("search", self.search), visit("creep", self.creep);
      visit("acceleration", self.acceleration), visit("travel", self.travel);
      visit("reference", self.reference);
    }
  };
  enum class State { idle, moving, done, failed };

  /// At rest at `position`.
  void start(const Settings& settings, double position);
  /// Brakes and ends as failed.
  void abort();
  /// One period of `dt` s: the setpoint of the axis. Cyclic.
  double step(const AxisStatus& axis, double dt);

  State state() const { return state_; }
  /// Machine position less the one of the encoder, when done.
  double shift() const { return settings_.reference - latch_; }

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("settings", self.settings_);
    visit("state", self.state_);
    visit("phase", self.phase_);
    visit("aborted", self.aborted_);
    visit("position", self.position_);
    visit("start", self.start_);
    visit("velocity", self.velocity_);
    visit("latch", self.latch_);
    visit("at_rest", self.at_rest_);
  }

 private:
  enum class Phase { leave_fast, search, leave, creep, settle };
  void next_phase(const AxisStatus& axis);
  double demand() const;

  Settings settings_;
  State state_ = State::idle;
  Phase phase_ = Phase::search;
  bool aborted_ = false;
  double position_ = 0, start_ = 0, velocity_ = 0, latch_ = 0;
  std::uint32_t at_rest_ = 0;  // periods
};

}  // namespace trunnion::drive
