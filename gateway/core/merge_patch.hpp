// SPDX-License-Identifier: Apache-2.0
// JSON Merge Patch (RFC 7396): the smallest message that turns one state into the next.
#pragma once

#include "bus/json.hpp"

namespace trunnion::gateway {

/// The patch from `from` to `to`, both objects without null members; an empty object when they are equal.
bus::Json merge_patch(const bus::Json& from, const bus::Json& to);

}  // namespace trunnion::gateway
