// SPDX-License-Identifier: Apache-2.0
// The units of truth.yaml in mm, rad and s.
#pragma once

namespace trunnion::truth {

inline constexpr double um = 1e-3, urad = 1e-6, ms = 1e-3;

}  // namespace trunnion::truth
