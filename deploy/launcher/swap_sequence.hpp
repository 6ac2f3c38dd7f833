// SPDX-License-Identifier: Apache-2.0
// The order of events in a swap, without process, bus or clock: what is known goes in, what is to be done
// comes out.
#pragma once

#include <cstdint>

#include "contracts/types.hpp"

namespace trunnion::launcher {

/// How the new process is compared with the one it is to replace.
enum class Comparison {
  batches,  ///< a stage: its batches beside those of the stream; afterwards both take part for a moment
  ticks,    ///< the PLC: it counts the ticks in which it has done the same
  once      ///< any other: it reports once that nothing differs; one that compares nothing differs in nothing
};

/// What the launcher knows when it asks for the next step.
struct SwapView {
  double now = 0;                ///< s of a monotonic clock
  bool executable = true;        ///< the file of the new process can be executed
  bool new_runs = true;          ///< the new process has not ended
  bool old_runs = true;          ///< the old process has not ended
  bool announced = false;        ///< the new process has published its contract
  bool contract_matches = true;  ///< and it is the cluster's
  idl::service::StandbyState standby = idl::service::StandbyState::JOINING;
  idl::service::Lifecycle lifecycle = idl::service::Lifecycle::UNCONFIGURED;  ///< of the new process
  bool in_step = false;                                                       ///< of the new process
  std::uint64_t compared = 0;  ///< cycles or ticks in which both have done the same
  bool differs = false;        ///< something has been found that they did not do the same
  double moved = 0;            ///< s, when there was something to compare last: the stream or the ticks moved
  bool may_end = true;         ///< the old process may be ended now
};

enum class SwapAction {
  wait,
  start_new,    ///< end the new process if it runs, and start it (again) on standby
  promote_new,  ///< let the new process take part
  end_old,      ///< ask the old process to end
  kill_old,     ///< it did not
  kill_new,
  start_old,  ///< the old process has ended and the new one cannot do its work
  succeed,    ///< the new process is in the place of the old one
  fail        ///< the old process stays
};

/// Why the old process stays.
enum class SwapFailure {
  none,
  no_executable,
  ended,               ///< the new process ended by itself, or was ended for not taking over
  other_contract,      ///< it was built with another contract
  did_not_join,        ///< it did not reach the state of the running one
  nothing_to_compare,  ///< nothing was done that both could do
  differs,
  may_not_end,  ///< the old process is at work and cannot be ended now
  takes_no_part
};

struct SwapStep {
  SwapAction action = SwapAction::wait;
  SwapFailure failure = SwapFailure::none;  ///< of `fail`
};

/// A stage is promoted while the old one runs, and the old one is ended after a moment in which both take
/// part. Every other service is promoted when the old one has ended, because its files and its port have one
/// owner at a time. Until the old one is asked to end nothing depends on the new one, so one that ends early
/// is started a second time: a vendor's library may end a process that begins while others of its topics
/// leave (Fast DDS 2.9: an assertion of its reader).
class SwapSequence {
 public:
  // All in seconds.
  static constexpr double join_timeout = 8;       ///< until the new process has the state of the running one
  static constexpr double compare_timeout = 3;    ///< without a cycle that both have computed
  static constexpr double rest_time = 0.5;        ///< without a movement: there is nothing to compare
  static constexpr double promote_timeout = 3;    ///< until the new one is in step as a replica
  static constexpr double overlap = 0.15;         ///< both take part: more than two leads in real time
  static constexpr double end_timeout = 2;        ///< until a process that was asked to end is killed
  static constexpr double take_over_timeout = 5;  ///< until a promoted service is active

  /// `cycles` (or ticks) must be equal, fewer when nothing moves. The new process is being started at `now`.
  SwapSequence(Comparison comparison, std::uint32_t cycles, double now)
      : comparison_(comparison), cycles_(cycles), entered_(now) {}

  /// To be asked again after every action, until it is `succeed` or `fail`.
  SwapStep step(const SwapView& view);

  /// Cycles or ticks that were equal when the comparison ended.
  std::uint64_t compared() const { return compared_; }
  /// Seconds in which neither process served; 0 for a stage.
  double gap() const { return gap_; }
  /// The old process has been asked to end.
  bool ends_old() const { return phase_ >= Phase::ending; }

 private:
  enum class Phase { joining, comparing, overlapping, ending, taking_over, recovering };
  void enter(Phase phase, double now);
  SwapStep start_again(SwapFailure otherwise, double now);
  SwapStep end_old(double now);
  SwapStep join(const SwapView& view);
  SwapStep compare(const SwapView& view);
  SwapStep overlap_with_old(const SwapView& view);
  SwapStep await_end(const SwapView& view);
  SwapStep take_over(const SwapView& view);
  SwapStep recover(const SwapView& view);

  Comparison comparison_;
  std::uint32_t cycles_;
  Phase phase_ = Phase::joining;
  double entered_, compared_at_ = 0, both_since_ = 0, ended_at_ = 0, gap_ = 0;
  std::uint64_t compared_ = 0;
  bool started_again_ = false, killed_ = false, started_old_ = false;
};

}  // namespace trunnion::launcher
