// SPDX-License-Identifier: Apache-2.0
// The JSON type of the tools and the gateway, without the library behind it.
#pragma once

#include <nlohmann/json_fwd.hpp>

namespace trunnion::bus {

using Json = nlohmann::ordered_json;

}  // namespace trunnion::bus
