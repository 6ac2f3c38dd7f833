// SPDX-License-Identifier: Apache-2.0
// What a suite came to, for people (HTML) and for a continuous integration server (JUnit XML).
#pragma once

#include <string>
#include <vector>

#include "bus/json.hpp"

namespace trunnion::verification {

struct SuiteResult {
  std::string recording;  ///< path
  std::string name;       ///< as SuiteTest
  double seconds = 0;     ///< from the start of the verification to its end
  bool passed = false;
  std::string problem;  ///< one line, when it did not pass
  bus::Json report;     ///< what `trunnion verify --json` printed; null when it printed nothing
  bool skipped =
      false;  ///< the recording gives nothing to verify the service with; the reason is in `problem`
  bool failed() const { return !passed && !skipped; }
};

/// A suite in which nothing was verified does not pass.
bool is_passed(const std::vector<SuiteResult>& results);

/// Of a verification that ended with `status` and printed `output`; `last_words` is the last line of its
/// standard error. Fills passed, skipped, problem and report.
void judge(SuiteResult& result, int status, const std::string& output, const std::string& last_words);

/// One test suite for each recording.
std::string junit_of(const std::string& title, const std::vector<SuiteResult>& results);

/// A page without other files: a table, and for each failure the first difference as text and as a plot.
std::string html_of(const std::string& title, const std::vector<SuiteResult>& results);

}  // namespace trunnion::verification
