// SPDX-License-Identifier: Apache-2.0
// The summary of a program for whoever prepares its job: tools, times, envelope, what it calls, what is
// doubtful.
#pragma once

#include <iosfwd>

#include "analysis/check_program.hpp"
#include "analysis/surveyed_machine.hpp"

namespace trunnion::analysis {

/// As check_program(), and writes the summary to `out`, as JSON when the options say so. False also when the
/// program has M codes that the logic of `machine` does not have, all of which the summary names.
bool summarize_program(language::TextSource& text, SurveyedMachine& machine,
                       const language::AxisValues& start, const CheckOptions& options, const TextName& name,
                       std::ostream& out);
/// The same where nothing but `environment` is known of the machine.
bool summarize_program(language::TextSource& text, language::Environment& environment,
                       const language::AxisValues& start, const CheckOptions& options, const TextName& name,
                       std::ostream& out);

}  // namespace trunnion::analysis
