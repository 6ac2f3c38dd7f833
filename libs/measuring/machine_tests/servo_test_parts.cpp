// SPDX-License-Identifier: Apache-2.0
#include "machine_tests/servo_test_parts.hpp"

#include <stdexcept>
#include <utility>

namespace trunnion::machine_tests {

using idl::servo::TestRequest;
using servo_analysis::AxisTrace;

const TestedAxis& only_axis(const ServoSession& session, const TestOptions& o) {
  if (o.axes.size() != 1) throw std::runtime_error("this test is of one axis: --axis X");
  return session.axis(o.axes.front());
}

TestReport report_of(const char* test, servo_analysis::TestFindings findings) {
  TestReport report;
  static_cast<servo_analysis::TestFindings&>(report) = std::move(findings);
  report.test = test;
  return report;
}

AxisTrace stroke(ServoSession& session, const TestedAxis& a, double feed, int strokes) {
  auto result = session.run(samples_of({a.number}, 2), stroke_program(a, feed, 0.5, strokes));
  if (result.traces.empty()) throw std::runtime_error("the drive gave no samples of the motion");
  return std::move(result.traces[0]);
}

servo_analysis::MotionFigures moved_figures(const AxisTrace& trace, double settling) {
  const auto f = servo_analysis::motion_figures(trace, settling);
  if (f.phases == 0)
    throw std::runtime_error("the axis was not at constant speed: it needs more travel, or a lower feed");
  return f;
}

std::vector<AxisTrace> run_without_feedforward(ServoSession& session, TestRequest request,
                                               const std::string& program) {
  const std::size_t count = request.axes.size();
  auto result = session.run(without_feedforward(session.parameters(), std::move(request)), program);
  if (result.traces.size() < count) throw std::runtime_error("the drive gave no samples of the motion");
  result.traces.resize(count);
  return std::move(result.traces);
}

servo_analysis::TestPicture picture_of(const ServoSession& session, const TestedAxis& axis, const char* what,
                                       servo_analysis::Diagram diagram) {
  return {session.machine() + ", axis " + axis.letter + ": " + what, std::move(diagram)};
}

}  // namespace trunnion::machine_tests
