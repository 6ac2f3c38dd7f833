// SPDX-License-Identifier: Apache-2.0
// Looks at the blocks and the commands of a program and collects what is doubtful in it.
#pragma once

#include <optional>

#include "analysis/arc_checks.hpp"
#include "analysis/block_checks.hpp"
#include "analysis/motion_checks.hpp"
#include "analysis/warnings.hpp"
#include "language/block_watch.hpp"

namespace trunnion::analysis {

class ProgramSurvey final : public language::BlockWatch {
 public:
  /// `environment` must outlive the survey; `lengths_known`: its tool table is that of the machine;
  /// `functions_known`: so are its M codes.
  ProgramSurvey(const language::Environment& environment, bool lengths_known, bool functions_known)
      : blocks_(environment, functions_known, warnings_),
        arcs_(environment, warnings_),
        motions_(environment, lengths_known, blocks_, warnings_) {}
  ProgramSurvey(const ProgramSurvey&) = delete;
  ProgramSurvey& operator=(const ProgramSurvey&) = delete;

  void begin(const language::SeenBlock& seen) override {
    blocks_.see(seen);
    arcs_.see(seen, blocks_.calls());
  }
  /// As MotionChecks::see().
  void see(const language::Command& command, const language::AxisValues& from,
           const std::optional<Motion>& motion) {
    motions_.see(command, from, motion);
  }
  /// The program has ended at `position`, program coordinates; `whole`: not by an alarm.
  void end(bool whole, const language::AxisValues& position) {
    if (whole) arcs_.end(position);
    motions_.end(whole);
  }

  const Warnings& warnings() const { return warnings_; }

 private:
  Warnings warnings_;
  BlockChecks blocks_;
  ArcChecks arcs_;
  MotionChecks motions_;
};

}  // namespace trunnion::analysis
