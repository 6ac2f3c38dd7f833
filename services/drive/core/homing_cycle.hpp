// SPDX-License-Identifier: Apache-2.0
// The search for the reference of an axis and of those that move with it: fast to the home switches, back off
// them, slowly to their edges, and on to the next index marks where these are the reference.
#pragma once

#include <cstdint>
#include <type_traits>

#include "drive_hardware.hpp"

namespace trunnion::drive {

class HomingCycle {
 public:
  struct Settings {
    double direction = 1;           ///< 1 or -1: where the switch is searched
    double search = 20, creep = 1;  ///< mm/s or deg/s
    double acceleration = 1000;     ///< mm/s2 or deg/s2
    double travel = 1000;           ///< mm or deg from the start; the search gives up beyond it
    double seconds = 0;             ///< longest time, braking not counted; 0 is none
    double reference = 0;           ///< machine position of the edge
    bool index = false;             ///< on to the index marks behind the edges

    template <class Self, class Visit>
    static void fields(Self& self, Visit&& visit) {
      visit("direction", self.direction), visit("search", self.search), visit("creep", self.creep);
      visit("acceleration", self.acceleration), visit("travel", self.travel);
      visit("reference", self.reference);
      if (!std::is_const_v<Self> || self.seconds > 0) visit("seconds", self.seconds);
      if (!std::is_const_v<Self> || self.index) visit("index", self.index);
    }
  };
  /// What all axes of the search have found together.
  struct Signals {
    bool any_switch = false, all_switches = false;
    bool all_marks = false;  ///< index marks behind the edges
  };
  enum class State { idle, moving, done, failed };
  enum class Failure { none, ended, travel, time };

  /// At rest at `position`.
  void start(const Settings& settings, double position);
  /// Brakes and ends as failed; the first reason is kept.
  void abort(Failure failure = Failure::ended);
  /// One period of `dt` s: the setpoint of the axis. Cyclic.
  double step_together(const Signals& signals, double dt);
  /// The same of one axis, whose switch is latched.
  double step(const AxisStatus& axis, double dt) {
    const double position = step_together({axis.home_switch, axis.home_switch, true}, dt);
    if (edges_found() && !latched_) latch_ = axis.home_latch, latched_ = true;
    return position;
  }

  State state() const { return state_; }
  Failure failure() const { return failure_; }
  const Settings& settings() const { return settings_; }
  /// It began on the switch, and the axis moves off it.
  bool leaves_switch() const { return state_ == State::moving && phase_ == Phase::leave_fast; }
  /// The edges have been taken at the slow speed.
  bool edges_found() const { return !aborted_ && (phase_ == Phase::settle || phase_ == Phase::mark); }
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
    if (!std::is_const_v<Self> || self.latched_) visit("latched", self.latched_);
    visit("at_rest", self.at_rest_);
    if (!std::is_const_v<Self> || self.periods_ > 0) visit("periods", self.periods_);
    if (!std::is_const_v<Self> || self.failure_ != Failure::none) visit("failure", self.failure_);
  }

 private:
  enum class Phase { leave_fast, search, leave, creep, settle, mark };
  void next_phase(const Signals& signals);
  double demand() const;

  Settings settings_;
  State state_ = State::idle;
  Phase phase_ = Phase::search;
  bool aborted_ = false, latched_ = false;
  double position_ = 0, start_ = 0, velocity_ = 0, latch_ = 0;
  std::uint32_t at_rest_ = 0;  // periods
  std::uint32_t periods_ = 0;  // since the start
  Failure failure_ = Failure::none;
};

}  // namespace trunnion::drive
