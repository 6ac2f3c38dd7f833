// SPDX-License-Identifier: Apache-2.0
// The active G codes as an operator reads them.
#pragma once

#include <string>
#include <vector>

#include "language/canonical.hpp"

namespace trunnion::channel {

/// One code of each group, in the order of their groups on the page; codes that are off by default are left
/// out while they are.
std::vector<std::string> modal_codes(const language::ModalState& modal);

}  // namespace trunnion::channel
