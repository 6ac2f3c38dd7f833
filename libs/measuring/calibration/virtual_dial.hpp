// SPDX-License-Identifier: Apache-2.0
// What an operator with edge finder, dial and tool reads on the true machine.
#pragma once

#include "calibration/manual_calibration.hpp"
#include "truth/instrument.hpp"
#include "truth/pose_report.hpp"

namespace trunnion::calibration {

/// Gauges of the virtual operator, mm and deg.
struct ManualGauges {
  double bore_radius = 40, finder_radius = 2;  ///< bore of C, ball of the edge finder
  double rim_radius = 150;                     ///< of the table
  double tool_length = 120, tool_radius = 8, arbor_diameter = 30;
  double alpha = 90;
  double surface = 50;                  ///< workpiece's top above the believed axis of A or the table
  truth::InstrumentTruth instrument{};  ///< of every reading, mm
};

/// The readings of the guide's steps. `model`: the chain by which the control moves; where it is wrong the
/// operator still brings the instrument to its contact. Throws std::runtime_error when the machine does not
/// reach a position.
Readings read_virtually(ManualKind kind, const truth::PoseReport& machine, const ChainParameters& model,
                        const ManualGauges& gauges);

/// The RTCP check at the nine poses with one model.
struct ManualCheck {
  ChainParameters model;
  std::vector<Vec3> displacements;  ///< mm
  Acceptance acceptance;
};

struct VirtualCheck {
  Vec3 place = Vec3::Zero();      ///< mm, of the ball in the workpiece frame
  double ball_length = 120;       ///< mm, spindle face to the ball's centre
  double alpha = 30;              ///< deg, see check_poses()
  truth::InstrumentTruth dial{};  ///< of every reading, mm
};

inline constexpr int most_corrections = 3;

/// Checks and corrects the model until it is accepted, with most_corrections at most; the last check has the
/// model that came of it.
std::vector<ManualCheck> check_and_correct(ManualKind kind, const truth::PoseReport& machine,
                                           ChainParameters model, const VirtualCheck& check);

/// Linear axes that put the true tip of a tool of `length` at `place` of the workpiece frame, mm.
Vec3 position_for(const truth::PoseReport& machine, const ChainParameters& model, const Vec3& place,
                  const Angles& angles, double length);

}  // namespace trunnion::calibration
