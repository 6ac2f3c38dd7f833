// SPDX-License-Identifier: Apache-2.0
// What the standard library has for further types (IEC 61131-3:2013, tables 36, 45, 46): CTU_DINT, TON_LTIME,
// CONCAT_LDT ...
#pragma once

#include <string>
#include <vector>

namespace trunnion::st {

/// Each the text of CTU, TON, CONCAT_DT and so on in standard_blocks.st with its own name and type, in the
/// same lines.
const std::vector<std::string>& derived_units();

}  // namespace trunnion::st
