// A simulated spindle: turns as fast as the PLC orders, or follows an angle of the stream (tapping).
#pragma once

namespace trunnion::drive {

/// Angles are revolutions, clockwise positive, turns counted; speeds 1/min.
class Spindle {
 public:
  /// `acceleration` deg/s2, `period` s.
  void configure(double acceleration, double period);
  void order(double speed) { order_ = speed; }

  /// The setpoint of the cycle that is executed, counted from where the spindle was at the first one.
  void couple(double revolutions);
  void release() { coupled_ = false; }
  bool coupled() const { return coupled_; }
  /// A share `phase` of the way from that setpoint to the one of the next cycle.
  void lead(double phase, double next_revolutions);
  /// On at the speed of the last setpoint for `cycles`, when there is no next one.
  void lead_on(double cycles) { command_ += cycles * change_; }

  /// One period; `powered` is false when the drives are off, and the spindle runs down.
  void step(bool powered);

  double speed() const { return speed_; }
  double angle() const { return angle_; }

 private:
  double period_ = 0.001, step_ = 0;  // of speed in one period
  double order_ = 0, speed_ = 0, angle_ = 0;
  bool coupled_ = false;
  double origin_ = 0, target_ = 0, change_ = 0, command_ = 0;
};

}  // namespace trunnion::drive
