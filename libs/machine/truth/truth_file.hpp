// SPDX-License-Identifier: Apache-2.0
// truth.yaml: how a machine differs from its design. docs/truth.md has the format.
#pragma once

#include <map>
#include <optional>
#include <string>

#include "machine/machine_outline.hpp"
#include "touch_probe/touch_probe.hpp"
#include "truth/drive_truth.hpp"
#include "truth/instrument.hpp"
#include "truth/true_geometry.hpp"

namespace trunnion::truth {

struct Truth {
  GeometryTruth geometry;                              ///< with the errors that `random` has drawn
  std::map<std::string, DriveTruth> drives;            ///< by the name of the servo axis
  std::map<std::string, SpindleTruth> spindle_drives;  ///< by the name of the spindle
  /// ballbar, laser, rtest (mm), laser_angle (rad); without an entry an instrument is exact.
  std::map<std::string, InstrumentTruth> instruments;
  std::optional<touch_probe::TouchProbeTruth> probe;  ///< in the spindle
  std::vector<touch_probe::Solid> solids;             ///< in the workpiece frame
};

/// `file` is named in errors. Throws std::runtime_error that begins with file:line:column: a key that is not
/// known, a value outside its limits, an axis that the machine does not have, a structure that is not the
/// machine's.
Truth parse_truth(const std::string& text, const std::string& file, const machine::MachineOutline& machine);

/// A location error by its name: "C0Y", "A0Z", "B0Z"; of a rotary axis "XOC" .. "COC" (ISO 230-7; ISO 230-1
/// writes X0C); of the spindle "XOS" .. "BOS".
struct LocationError {
  double* value = nullptr;  ///< mm or rad
  bool angle = false;
};
/// Nothing when the machine has none of this name.
std::optional<LocationError> location_error(GeometryTruth& truth, const machine::MachineOutline& machine,
                                            const std::string& name);

/// The geometry of the machine. Throws std::runtime_error that begins with `file` when `truth` is not this
/// machine's.
TrueGeometry make_geometry(const GeometryTruth& truth, const machine::MachineOutline& machine,
                           const std::string& file);

}  // namespace trunnion::truth
