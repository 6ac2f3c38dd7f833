// SPDX-License-Identifier: Apache-2.0
// What a row of a table of G codes names.
#pragma once

#include "language/block_handlers.hpp"

namespace trunnion::language {

/// A function of a handler, and what it is called with.
template <auto handler, auto function, auto... arguments>
Fault run(BlockHandlers& handlers, std::uint16_t at) {
  return ((handlers.*handler).*function)(at, arguments...);
}

}  // namespace trunnion::language
