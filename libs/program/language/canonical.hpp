// SPDX-License-Identifier: Apache-2.0
// The canonical commands are what this library gives out, so its namespace has their names.
#pragma once

#include "canonical/canonical.hpp"

namespace trunnion::language {

using namespace canonical;

}  // namespace trunnion::language
