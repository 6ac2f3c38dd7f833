// SPDX-License-Identifier: Apache-2.0
#include "swap_sequence.hpp"

namespace trunnion::launcher {

using idl::service::Lifecycle;
using idl::service::StandbyState;

void SwapSequence::enter(Phase phase, double now) {
  phase_ = phase;
  entered_ = now;
}

SwapStep SwapSequence::start_again(SwapFailure otherwise, double now) {
  if (started_again_) return {SwapAction::fail, otherwise};
  started_again_ = true;
  compared_ = 0;
  enter(Phase::joining, now);
  return {SwapAction::start_new};
}

SwapStep SwapSequence::end_old(double now) {
  ended_at_ = now;
  killed_ = false;
  enter(Phase::ending, now);
  return {SwapAction::end_old};
}

SwapStep SwapSequence::step(const SwapView& view) {
  if (phase_ == Phase::recovering) return recover(view);
  if (!view.new_runs) {
    if (!ends_old() && !view.executable) return {SwapAction::fail, SwapFailure::no_executable};
    if (!ends_old()) return start_again(SwapFailure::ended, view.now);
    enter(Phase::recovering, view.now);
    return recover(view);
  }
  const bool on_standby = phase_ == Phase::joining || phase_ == Phase::comparing;
  if (on_standby) {
    if (view.compared > compared_) compared_at_ = view.now;
    compared_ = view.compared;
    if (view.differs) return {SwapAction::fail, SwapFailure::differs};
  }
  switch (phase_) {
    case Phase::joining:
      return join(view);
    case Phase::comparing:
      return compare(view);
    case Phase::overlapping:
      return overlap_with_old(view);
    case Phase::ending:
      return await_end(view);
    case Phase::taking_over:
      return take_over(view);
    case Phase::recovering:
      break;
  }
  return {};
}

SwapStep SwapSequence::join(const SwapView& view) {
  if (view.announced && !view.contract_matches) return {SwapAction::fail, SwapFailure::other_contract};
  if (!view.announced || view.standby != StandbyState::MATCHING) {
    if (view.now - entered_ > join_timeout) return {SwapAction::fail, SwapFailure::did_not_join};
    return {};
  }
  if (comparison_ != Comparison::once) {
    compared_at_ = view.now;
    enter(Phase::comparing, view.now);
    return {};
  }
  if (!view.may_end) return {SwapAction::fail, SwapFailure::may_not_end};
  return end_old(view.now);
}

SwapStep SwapSequence::compare(const SwapView& view) {
  const bool rests = view.now - view.moved > rest_time && view.now - entered_ > rest_time;
  if (compared_ < cycles_ && !rests) {
    if (view.now - compared_at_ > compare_timeout) return {SwapAction::fail, SwapFailure::nothing_to_compare};
    return {};
  }
  if (comparison_ == Comparison::ticks) return end_old(view.now);
  both_since_ = view.now;
  enter(Phase::overlapping, view.now);
  return {SwapAction::promote_new};
}

SwapStep SwapSequence::overlap_with_old(const SwapView& view) {
  if (view.lifecycle != Lifecycle::ACTIVE || !view.in_step) {
    both_since_ = view.now;
    if (view.now - entered_ > promote_timeout) return start_again(SwapFailure::takes_no_part, view.now);
    return {};
  }
  return view.now - both_since_ > overlap ? end_old(view.now) : SwapStep{};
}

SwapStep SwapSequence::await_end(const SwapView& view) {
  if (view.old_runs) {
    if (killed_ || view.now - ended_at_ <= end_timeout) return {};
    killed_ = true;
    return {SwapAction::kill_old};
  }
  if (comparison_ == Comparison::batches) return {SwapAction::succeed};
  enter(Phase::taking_over, view.now);
  return {SwapAction::promote_new};
}

SwapStep SwapSequence::take_over(const SwapView& view) {
  if (view.lifecycle == Lifecycle::ACTIVE) {
    gap_ = view.now - ended_at_;
    return {SwapAction::succeed};
  }
  if (view.now - entered_ > take_over_timeout) return {SwapAction::kill_new};
  return {};
}

// The new process is gone and the old one was asked to end: its files and its port must be free before it is
// started again.
SwapStep SwapSequence::recover(const SwapView& view) {
  if (started_old_) return {SwapAction::fail, SwapFailure::ended};
  if (view.old_runs) {
    if (killed_ || view.now - ended_at_ <= end_timeout) return {};
    killed_ = true;
    return {SwapAction::kill_old};
  }
  started_old_ = true;
  return {SwapAction::start_old};
}

}  // namespace trunnion::launcher
