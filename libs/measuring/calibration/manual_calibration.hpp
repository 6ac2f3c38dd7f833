// SPDX-License-Identifier: Apache-2.0
// Guided manual calibration with dial and edge finder, after the commissioning manual of HNC-8, 1.5.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "calibration/measurement_inputs.hpp"

namespace trunnion::calibration {

enum class ManualKind { ac_table, bc_head, ac_head, hybrid };

/// That of a machine, by its rotary axes and their directions (within 1 degree of the manual's); nothing for
/// another machine.
std::optional<ManualKind> manual_kind(const ChainParameters& chain);
const char* to_string(ManualKind kind);
/// What is said of another machine.
inline constexpr const char* manual_machines =
    "the manual calibration is for an AC table, a BC or AC head, or a B head over a C table with the "
    "directions of the manual";

struct ManualStep {
  std::string at;                                             ///< positions of the rotary axes
  std::string use;                                            ///< instrument
  std::string action;                                         ///< what to touch and how
  std::vector<std::pair<std::string, std::string>> readings;  ///< name and meaning
};
struct ManualGuide {
  std::string title;
  std::vector<std::string> checks;  ///< before the calibration
  std::vector<ManualStep> steps;
  std::vector<std::pair<std::string, std::string>> values;  ///< of the instruments: name and meaning
  std::vector<std::string> optional;                        ///< names that may be absent
};
enum class GuideLanguage { english, german, chinese };
/// manual_steps.yaml, or its translation.
const ManualGuide& guide_of(ManualKind kind, GuideLanguage language = GuideLanguage::english);

/// mm (alpha: deg) by the names of the guide.
using Readings = std::map<std::string, double>;

/// `name: value` lines (YAML). Throws std::runtime_error with file:line:column for a name that is not in the
/// guide, a value outside of -100000 .. 100000 (alpha: 5 .. 90, radius and diameter: above 0), a missing one.
Readings parse_readings(const std::string& text, const std::string& file, ManualKind kind);

/// The chain with the vectors that the formulas give: a table's C axis and A offset, a head's offsets.
/// Corrections of the chain become zero: the formulas give whole vectors.
ChainParameters chain_of_readings(ManualKind kind, const Readings& readings, ChainParameters chain);

/// The nine poses of the RTCP check: C0, C90, C180, C270, then five of the swivelling axis with C0: 0, +a,
/// -a, -90, 0 of a table (a = `alpha` deg), 0, 45, 90, -45, -90 of a head.
std::vector<Angles> check_poses(ManualKind kind, double alpha = 30);

/// Nine lines `x y z` of the displacement at check_poses(), mm; `#` begins a comment. Throws
/// std::runtime_error that begins with file:line:column.
std::vector<Vec3> parse_displacements(const std::string& text, const std::string& file);

/// The chain, corrected by the displacement of the ball along + axes of the workpiece frame at the nine
/// poses, mm. First order: what remains after it is of the order of the product of errors.
ChainParameters corrected(ManualKind kind, const std::vector<Vec3>& displacements, double alpha,
                          ChainParameters chain);

struct Acceptance {
  struct Line {
    std::string name;             ///< "X over C0 .. C270"
    double value = 0, limit = 0;  ///< mm
  };
  std::vector<Line> lines;
  bool accepted() const;
};
/// Limits of the manual: 0.02 mm; 0.01 mm for Z of a table between +a and -a and between 0 and -90.
Acceptance acceptance_of(ManualKind kind, const std::vector<Vec3>& displacements);
/// A dial's series: the largest amount of a reading less the first, mm.
double largest_deviation(const std::vector<double>& readings);

}  // namespace trunnion::calibration
