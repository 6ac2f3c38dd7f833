// SPDX-License-Identifier: Apache-2.0
// What a program has learned at rest, and reads again in a restart: where skip moves and searches for
// references have ended, and values of spindles and signals of the PLC.
#include <string>
#include <utility>

#include "program_execution/program_flow.hpp"

namespace trunnion::program_execution {

// A restart behind it finds the axes as they have been homed since.
void ProgramFlow::home_ended(const AxisValues& position) {
  skips_.push_back({position, position});
  place_ = position;
  extent_ = channel_setup::AxisBox::of(position);
  finish_pending();
}

// Equal values behind each other are one result, so that a program that waits for a value can be continued:
// X of `stopped` is the value, X of `touched` how often it was read.
void ProgramFlow::value_read(double value) {
  using language::X;
  if (value_last_ && skips_.back().stopped[X] == value) {
    values_read_ = skips_.back().touched[X];
    skips_.back().touched[X] += 1;
    --skips_read_;
    return;
  }
  SkipResult result;
  result.stopped[X] = value, result.touched[X] = 1;
  skips_.push_back(result);
}

// As behind a skip move.
FlowState ProgramFlow::continue_after_read() {
  if (search_ == Search::line)
    return fail_search("line " + std::to_string(command_.line) +
                       " reads a spindle or a signal of the PLC, and what follows depends on it");
  if (skips_read_ == skips_.size()) return fail(language::AlarmNumber::not_resumable);
  const auto& result = skips_[skips_read_];
  interpreter_.give_value(result.stopped[language::X]);
  values_read_ += 1;
  value_last_ = values_read_ >= result.touched[language::X];
  if (value_last_) ++skips_read_, values_read_ = 0;
  return FlowState::full;
}

// What was read behind the restart point is void.
void ProgramFlow::drop_later_results() {
  if (values_read_ > 0) {
    skips_[skips_read_].touched[language::X] = std::exchange(values_read_, 0);
    ++skips_read_;
    value_last_ = true;
  }
  skips_.resize(skips_read_);
}

// A skip move has ended, now or before the restart: the interpreter continues from where it ended. A search
// for references that was passed over has ended at the reference positions.
FlowState ProgramFlow::continue_after_skip() {
  if (search_ == Search::line && interpreter_.homing())
    skips_.push_back({home_target_, home_target_});
  else if (search_ == Search::line)
    return fail_search("line " + std::to_string(command_.line) +
                       " measures (G31), and what follows depends on it");
  if (skips_read_ == skips_.size()) return fail(language::AlarmNumber::not_resumable);
  interpreter_.set_position(skips_[skips_read_].stopped, skips_[skips_read_].touched);
  ++skips_read_;
  value_last_ = false;
  return FlowState::full;
}

// A call that is only searched for a restart or a line is not answered again: the service has gone on.
FlowState ProgramFlow::fail_after_cycle() {
  if (search_ == Search::line)
    return fail_search(
        "a cycle of another service is called before it, and what follows depends on its answer");
  return fail(language::AlarmNumber::not_resumable,
              "a program behind a cycle of another service cannot be resumed: reset and start again");
}

}  // namespace trunnion::program_execution
