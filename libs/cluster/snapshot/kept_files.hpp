// SPDX-License-Identifier: Apache-2.0
// Files of a state directory as a part of a service's explicit state.
#pragma once

#include <string>
#include <vector>

#include "bus/json_type.hpp"

namespace trunnion::snapshot {

/// The files of `directory` with these names, as far as they exist, with their bytes in hexadecimal digits.
bus::Json kept_files(const std::string& directory, const std::vector<std::string>& names);

/// Writes them into `directory`. Throws std::runtime_error when one cannot be written, and
/// nlohmann::json::exception when `files` is of another shape.
void put_files(const std::string& directory, const bus::Json& files);

}  // namespace trunnion::snapshot
