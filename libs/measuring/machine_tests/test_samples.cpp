// SPDX-License-Identifier: Apache-2.0
#include "machine_tests/test_samples.hpp"

#include <algorithm>

namespace trunnion::machine_tests {
namespace {

using idl::servo::TestPhase;

constexpr std::size_t columns = 8;  // of a sample of idl/servo.idl

void append(servo_analysis::AxisTrace& t, const double* v) {
  t.setpoint.push_back(v[0]), t.feedback.push_back(v[1]), t.speed_set.push_back(v[2]);
  t.speed.push_back(v[3]), t.torque.push_back(v[4]), t.excitation.push_back(v[5]);
  t.motor.push_back(v[6]), t.load.push_back(v[7]);
}

}  // namespace

bool add_samples(SessionResult& result, std::uint64_t& expected, const idl::servo::TestSamples& s) {
  if (s.first != expected) result.lost = true, expected = s.first;
  if (result.phase != TestPhase::ENDED_BY_VIBRATION) result.phase = s.phase;
  result.vibration = std::max(result.vibration, s.vibration);
  const std::size_t n = s.axes.size();
  result.traces.resize(n);
  for (std::size_t k = 0; k * columns < s.values.size(); ++k)
    append(result.traces[k % n], &s.values[k * columns]);
  for (auto& t : result.traces) t.interval = s.interval;
  expected += s.values.size() / columns / n;
  return s.phase == TestPhase::COMPLETED || s.phase == TestPhase::ENDED_BY_CLIENT ||
         s.phase == TestPhase::ENDED_BY_STOP;
}

}  // namespace trunnion::machine_tests
