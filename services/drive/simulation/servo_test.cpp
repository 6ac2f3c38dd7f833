// SPDX-License-Identifier: Apache-2.0
#include "servo_test.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "machine/parameter_constants.hpp"

namespace trunnion::drive {

using idl::servo::TestPhase;
using idl::servo::TestRequest;
using idl::servo::TestSignal;

namespace {
constexpr std::size_t most_values = 4096;  // of a message
constexpr double longest_test = 600;       // s

std::uint32_t axis_of(std::uint32_t parameter) { return (parameter - 100000) / 1000; }

bool may_be_tried(std::uint32_t number) {
  const auto axis = axis_of(number);
  for (const auto& p : {parameter::position_gain, parameter::speed_gain, parameter::speed_integral_time,
                        parameter::current_time_constant, parameter::velocity_feedforward,
                        parameter::acceleration_feedforward, parameter::dual_loop_time,
                        parameter::damping_gain, parameter::torque_filter_time, parameter::notch_frequency,
                        parameter::notch_width, parameter::friction_compensation})
    if (p.number(axis) == number) return true;
  return false;
}

std::string outside(const char* name, double value, double low, double high, const char* unit) {
  return fmt::format("{} {:g} is not within {:g} .. {:g} {}", name, value, low, high, unit);
}
}  // namespace

void ServoTest::configure(const machine::Parameters& parameters, const std::vector<machine::AxisInfo>& axes,
                          double period) {
  if (running_) end(TestPhase::ENDED_BY_STOP);
  parameters_ = parameters;
  axes_ = axes;
  period_ = period;
  columns_.assign(axes.size(), -1);
}

std::string ServoTest::refusal(const TestRequest& r) const {
  if (running_) return "another test is running; it ends when its client is gone for 5 s";
  if (r.axes.empty()) return "no axis is given";
  for (const auto axis : r.axes)
    if (std::none_of(axes_.begin(), axes_.end(), [&](const auto& a) { return a.number == axis; }) ||
        std::count(r.axes.begin(), r.axes.end(), axis) > 1)
      return "there is no axis with logical number " + std::to_string(axis) + ", or it is given twice";
  const auto within = [](double value, double low, double high) { return value >= low && value <= high; };
  if (!within(r.duration, 0, longest_test)) return outside("duration", r.duration, 0, longest_test, "s");
  if (!within(r.vibration_limit, 0, 10))
    return outside("vibration limit", r.vibration_limit, 0, 10, "mm or deg");
  if (r.decimation < 1 || r.decimation > 1000)
    return outside("decimation", r.decimation, 1, 1000, "periods of the speed loop");
  if (r.signal != TestSignal::NONE) {
    const bool speed = r.signal == TestSignal::SPEED_CHIRP || r.signal == TestSignal::SPEED_STEP;
    const double most = speed ? parameters_.get(parameter::maximum_feed, r.axes.front()) / 60 : 1;
    if (!within(std::abs(r.amplitude), 0, most))
      return outside("amplitude", r.amplitude, -most, most, speed ? "mm/s or deg/s" : "of the rated torque");
    if (!within(r.period, 0.001, longest_test)) return outside("period", r.period, 0.001, longest_test, "s");
    const double highest = servo_substeps / period_ / 2;
    for (const double f : {r.first_frequency, r.last_frequency})
      if (!within(f, 0, highest)) return outside("frequency", f, 0, highest, "Hz");
  }
  for (const auto& trial : r.trial) {
    const auto& catalogue = machine::Catalogue::instance();
    if (trial.parameter < 100000 || trial.parameter >= 200000 || !may_be_tried(trial.parameter) ||
        std::find(r.axes.begin(), r.axes.end(), axis_of(trial.parameter)) == r.axes.end())
      return "parameter " + machine::number_text(trial.parameter) +
             " is no servo parameter of an axis of the test that acts at once";
    for (const double value : {trial.value, trial.fallback})
      if (auto fault = catalogue.check(trial.parameter, value, ""); !fault.empty()) return fault;
  }
  return "";
}

std::string ServoTest::request(const TestRequest& r) {
  if (r.end) {
    if (!running_ || request_.client != r.client) return "no test of this client is running";
    end(TestPhase::ENDED_BY_CLIENT);
    return "";
  }
  // It is renewed; or has ended, and the renewal was on its way.
  if (request_.number != 0 && request_.client == r.client && request_.number == r.number) return "";
  if (auto reason = refusal(r); !reason.empty()) return reason;
  request_ = r;
  running_ = true, told_ = false;
  phase_ = TestPhase::RUNNING;
  elapsed_ = first_ = 0;
  tests_.assign(r.axes.size(), {});
  prepare();
  return "";
}

// The parts of the test that follow from request and parameters.
void ServoTest::prepare() {
  std::fill(columns_.begin(), columns_.end(), -1);
  auto trial = parameters_, fallback = parameters_;
  for (const auto& value : request_.trial) {
    trial.values[value.parameter] = {value.value, ""};
    fallback.values[value.parameter] = {value.fallback, ""};
  }
  for (std::size_t i = 0; i < tests_.size(); ++i) {
    const auto axis = request_.axes[i];
    const int column = machine::column_of(axes_, axis);
    columns_[static_cast<std::size_t>(column)] = static_cast<int>(i);
    tests_[i].start(request_, ServoParameters::from(trial, axis), ServoParameters::from(fallback, axis),
                    i == 0, period_ / servo_substeps);
    tests_[i].values().reserve(most_values + servo_substeps * sample_values);
  }
}

void ServoTest::continue_test() {
  if (!running_) return;
  const auto state = tests_;
  prepare();
  for (std::size_t i = 0; i < tests_.size(); ++i) tests_[i].take_state(state[i]);
}

void ServoTest::end(TestPhase phase) {
  if (!running_) return;
  running_ = false, told_ = false;
  if (phase_ != TestPhase::ENDED_BY_VIBRATION) phase_ = phase;
}

void ServoTest::begin_period(bool moving) {
  if (!running_) return;
  for (auto& test : tests_) test.activate(moving || !request_.in_motion);
}

void ServoTest::end_period() {
  if (!running_) return;
  if (phase_ == TestPhase::RUNNING &&
      std::any_of(tests_.begin(), tests_.end(), [](const auto& t) { return t.vibrates(); })) {
    for (auto& test : tests_) test.fall_back();
    phase_ = TestPhase::ENDED_BY_VIBRATION;
    told_ = false;
  }
  if (static_cast<double>(++elapsed_) * period_ >= request_.duration) end(TestPhase::COMPLETED);
}

bool ServoTest::ready() const {
  return !told_ ||
         (running_ && !tests_.empty() && tests_.front().values().size() * tests_.size() >= most_values / 2);
}

void ServoTest::fill(idl::servo::TestSamples& out) {
  out.client = request_.client, out.number = request_.number;
  out.phase = phase_;
  out.reason = phase_ == TestPhase::ENDED_BY_STOP
                   ? "the axes were stopped, parameters have changed, or the client is gone"
                   : "";
  out.vibration = 0;
  for (const auto& test : tests_) out.vibration = std::max(out.vibration, test.vibration());
  out.interval = period_ / servo_substeps * request_.decimation;
  out.axes = request_.axes;
  out.first = first_;
  out.values.clear();
  const std::size_t samples = tests_.empty() ? 0 : tests_.front().values().size() / sample_values;
  for (std::size_t k = 0; k < samples; ++k)
    for (const auto& test : tests_)
      out.values.insert(out.values.end(),
                        test.values().begin() + static_cast<std::ptrdiff_t>(k * sample_values),
                        test.values().begin() + static_cast<std::ptrdiff_t>((k + 1) * sample_values));
  first_ += samples;
  for (auto& test : tests_) test.values().clear();
  told_ = true;
}

}  // namespace trunnion::drive
