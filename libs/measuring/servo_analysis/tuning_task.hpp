// SPDX-License-Identifier: Apache-2.0
// What a tuning needs to know of an axis, from its parameters and its place.
#pragma once

#include <vector>

#include "machine/parameters.hpp"
#include "servo_analysis/axis_tuning.hpp"
#include "servo_analysis/test_programs.hpp"

namespace trunnion::servo_analysis {

/// Another linear axis of X, Y, Z for circles with `axis`; null when there is none.
const TestedAxis* partner_of(const std::vector<TestedAxis>& axes, const TestedAxis& axis);

/// `partner`: for circles; null: none, as when it has no space. `amplitude` mm or deg.
TuningTask tuning_task(const machine::Parameters& parameters, const TestedAxis& axis,
                       const TestedAxis* partner, double amplitude);

}  // namespace trunnion::servo_analysis
