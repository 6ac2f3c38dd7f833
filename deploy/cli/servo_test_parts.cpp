// SPDX-License-Identifier: Apache-2.0
#include "servo_test_parts.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "machine/gantry_pairs.hpp"
#include "machine/parameter_constants.hpp"

namespace trunnion::cli {

using idl::servo::TestRequest;
using servo_analysis::AxisTrace;
using servo_analysis::per_minute;

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

TestRequest samples_of(const std::vector<std::uint16_t>& axes, std::uint16_t decimation) {
  TestRequest r;
  r.axes = axes;
  r.in_motion = true;
  r.duration = longest_test;
  r.decimation = decimation;
  return r;
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

double feed_without_feedforward(const ServoSession& session, const std::vector<std::uint16_t>& axes,
                                const std::vector<double>& speeds, double feed) {
  const auto& p = session.parameters();
  double share = 1;
  for (std::size_t i = 0; i < axes.size(); ++i)
    share =
        std::min(share, servo_analysis::bearable_share(speeds[i], p.get(parameter::position_gain, axes[i]),
                                                       p.get(parameter::following_error_limit, axes[i])));
  return share * feed;
}

std::vector<AxisTrace> run_without_feedforward(ServoSession& session, TestRequest request,
                                               const std::string& program) {
  const auto& p = session.parameters();
  const std::size_t count = request.axes.size();
  for (const auto& pair : machine::gantry_pairs(p))
    for (std::size_t i = 0; i < count; ++i)
      if (request.axes[i] == pair.master) request.axes.push_back(pair.slave);
  for (const auto axis : request.axes)
    for (const auto& share : {parameter::velocity_feedforward, parameter::acceleration_feedforward})
      request.trial.push_back({share.number(axis), 0, p.get(share, axis)});
  auto result = session.run(std::move(request), program);
  if (result.traces.size() < count) throw std::runtime_error("the drive gave no samples of the motion");
  result.traces.resize(count);
  return std::move(result.traces);
}

double feed_of(const TestedAxis& a, const TestOptions& o, double standard) {
  const double feed = o.feed.value_or(standard);
  if (!(feed > 0) || feed > a.highest_feed)
    throw std::runtime_error(fmt::format("feed {:g}: axis {} moves with up to {:g} {}", feed, a.letter,
                                         a.highest_feed, a.speed_unit()));
  return feed;
}

std::string picture_title(const ServoSession& s, const TestedAxis& a, const char* what) {
  return s.machine() + ", axis " + a.letter + ": " + what;
}

std::vector<double> difference(const std::vector<double>& a, const std::vector<double>& b) {
  std::vector<double> d(a.size());
  for (std::size_t i = 0; i < a.size(); ++i) d[i] = a[i] - b[i];
  return d;
}

}  // namespace trunnion::cli
