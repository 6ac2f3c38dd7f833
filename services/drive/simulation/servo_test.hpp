// SPDX-License-Identifier: Apache-2.0
// A test of simulated servo loops: checks the request, keeps the tests of its axes, reports.
#pragma once

#include <vector>

#include "loop_test.hpp"
#include "machine/axes.hpp"
#include "servo_tester.hpp"

namespace trunnion::drive {

class ServoTest : public ServoTester {
 public:
  /// Ends a test that is running. `period` s of interpolation.
  void configure(const machine::Parameters& parameters, const std::vector<machine::AxisInfo>& axes,
                 double period);

  std::string request(const idl::servo::TestRequest& request) override;
  void end(idl::servo::TestPhase phase) override;
  bool running() const override { return running_; }
  bool needs_time() const override { return running_ && !request_.in_motion; }
  bool ready() const override;
  void fill(idl::servo::TestSamples& out) override;

  /// Of the axis in `column`; null when no test concerns it. Cyclic.
  LoopTest* of(std::size_t column) {
    return running_ && columns_[column] >= 0 ? &tests_[static_cast<std::size_t>(columns_[column])] : nullptr;
  }
  /// A period begins. Cyclic.
  void begin_period(bool moving);
  /// It is over: a vibration, the end of the duration. Cyclic.
  void end_period();

  /// No fields, configure() and continue_test() set them: parameters_, axes_, columns_, period_.
  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("request", self.request_), visit("running", self.running_), visit("phase", self.phase_);
    visit("told", self.told_), visit("elapsed", self.elapsed_), visit("first", self.first_);
    visit("tests", self.tests_);
  }
  /// After fields() were read.
  void continue_test();

 private:
  std::string refusal(const idl::servo::TestRequest& request) const;
  void prepare();

  machine::Parameters parameters_;
  std::vector<machine::AxisInfo> axes_;
  std::vector<int> columns_;
  double period_ = 0.001;
  idl::servo::TestRequest request_;
  bool running_ = false, told_ = true;
  idl::servo::TestPhase phase_ = idl::servo::TestPhase::COMPLETED;
  std::uint64_t elapsed_ = 0, first_ = 0;
  std::vector<LoopTest> tests_;
};

}  // namespace trunnion::drive
