// SPDX-License-Identifier: Apache-2.0
// Coverage factors of uncertainties.
#pragma once

#include <cstddef>

namespace trunnion::metrology {

/// The factor by which a standard uncertainty is multiplied so that, with the probability `confidence` (0 to
/// 1, exclusive), all of `values` values are within their expanded uncertainties at the same time
/// (Bonferroni; values of one measurement are correlated, so the probability is a little higher). `freedom`
/// 0: the standard uncertainty is known, normal distribution. GUM (JCGM 100) annex G.
double coverage_factor(double confidence, std::size_t values, std::size_t freedom);

}  // namespace trunnion::metrology
