// SPDX-License-Identifier: Apache-2.0
// The calibration with dial and edge finder as JSON: its steps, and what readings or displacements change.
#pragma once

#include <map>

#include "calibration/manual_calibration.hpp"
#include "core/requests.hpp"
#include "machine/parameters.hpp"

namespace trunnion::gateway {

/// Language of the query; English when it is empty. Throws BadRequest for one that is not there.
calibration::GuideLanguage guide_language(const std::string& name);

/// {"kind", "title", "checks", "steps": [{"at", "use", "do", "readings": [{"name", "about"}]}], "values",
/// "optional", "poses": names of the nine check poses, "vectors"}. `alpha` in deg, 5 .. 90.
bus::Json guide_document(calibration::ManualKind kind, calibration::GuideLanguage language, double alpha,
                         const calibration::ChainParameters& chain);

struct ManualEvaluation {
  std::map<std::uint32_t, machine::ParameterValue> values;  ///< of the parameters that change
  bus::Json document;
};
/// {"readings": {name: mm}} or {"displacements": nine [x, y, z] in mm, "alpha": deg} -> {"before", "after":
/// vectors, "changes", and of displacements "accepted" and "acceptance"}. Displacements within their limits
/// change nothing. Throws BadRequest, or std::runtime_error when the catalogue refuses a value.
ManualEvaluation evaluate_manual(const bus::Json& body, calibration::ManualKind kind,
                                 const calibration::ChainParameters& chain, std::uint16_t channel);

}  // namespace trunnion::gateway
