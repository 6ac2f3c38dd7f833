// SPDX-License-Identifier: Apache-2.0
// A summary as text and as JSON.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "analysis/check_program.hpp"
#include "analysis/program_figures.hpp"
#include "analysis/warnings.hpp"

namespace trunnion::analysis {

struct SummaryReport {
  const ProgramFigures& figures;
  const Warnings& warnings;
  const language::Environment& environment;
  const TextName& name;
  bool lengths_known = false;            ///< the tool table is that of the machine
  std::uint64_t lines = 0;               ///< of the text
  std::uint64_t blocks = 0;              ///< executed, those of loops and subprograms each time
  std::optional<language::Alarm> alarm;  ///< that has ended the program
  std::string alarm_text;
  std::uint32_t repeats_from = 0;  ///< line; 0: it ends
};

/// Lines, without the alarm.
std::string to_text(const SummaryReport& report);
/// One document, with the alarm as "error".
std::string to_json(const SummaryReport& report);

/// 12.3 s, or 0:12:34 h from 100 s on.
std::string duration(double seconds);

}  // namespace trunnion::analysis
