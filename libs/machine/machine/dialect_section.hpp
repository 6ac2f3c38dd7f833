// SPDX-License-Identifier: Apache-2.0
// `dialect` and `program_dialects` in machine.yaml: how the programs of the machine are written.
#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "machine/parameters.hpp"

namespace YAML {
class Node;
}

namespace trunnion::machine {

/// Parameters 04c959 and 04c800 that the two come to, for channels 0 to `channels` - 1; those that
/// machine.yaml does not have are not among them. `document` is that of machine.yaml in `file`. Throws
/// std::runtime_error with file:line:column.
std::map<std::uint32_t, ParameterValue> read_dialect_parameters(const YAML::Node& document,
                                                                const std::string& file,
                                                                std::uint32_t channels);

}  // namespace trunnion::machine
