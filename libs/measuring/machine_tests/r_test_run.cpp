// SPDX-License-Identifier: Apache-2.0
#include "machine_tests/r_test_run.hpp"

#include <utility>

namespace trunnion::machine_tests {

using identification::dynamic_less_static;

RTestReport run_r_test(BallTest& test, double feed, std::size_t stops,
                       const identification::RTestSettings& settings) {
  RTestReport report;
  report.motion = test.run(feed, test.start());
  report.result = identification::evaluate_turn(test.set(), report.motion.there, settings);
  if (stops > 0) report.stops = test.stop(stops, test.start());
  if (report.stops.size() >= identification::least_stops)
    report.comparison = identification::compare(test.set(), report.result, report.stops);
  return report;
}

std::vector<StudyRow> study_r_test(BallTest& test, const RTestStudy& study,
                                   const identification::RTestSettings& settings) {
  std::vector<StudyRow> rows;
  for (const double start : study.starts) {
    const auto stops = test.stop(study.stops, start);
    for (const double feed : study.feeds) {
      StudyRow row;
      row.feed = feed, row.start = start;
      for (std::size_t k = 0; k < study.repeats; ++k) {
        const auto motion = test.run(feed, start);
        const auto result = identification::evaluate_turn(test.set(), motion.there, settings);
        row.difference += dynamic_less_static(result.angles, result.read, stops).cwiseAbs2();
        row.cleaned += dynamic_less_static(result.angles, result.cleaned, stops).cwiseAbs2();
      }
      row.difference = (row.difference / static_cast<double>(study.repeats)).cwiseSqrt();
      row.cleaned = (row.cleaned / static_cast<double>(study.repeats)).cwiseSqrt();
      rows.push_back(row);
    }
  }
  return rows;
}

}  // namespace trunnion::machine_tests
