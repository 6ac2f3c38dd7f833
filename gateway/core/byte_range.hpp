// SPDX-License-Identifier: Apache-2.0
// The header Range of HTTP (RFC 9110, section 14).
#pragma once

#include <cstdint>
#include <string_view>

namespace trunnion::gateway {

struct ByteRange {
  enum class Kind {
    whole,   ///< no range, or one that is to be ignored: not of bytes, several, malformed
    part,    ///< `count` bytes from `first`
    outside  ///< nothing of what is asked for exists
  };
  Kind kind = Kind::whole;
  std::uint64_t first = 0, count = 0;
};

/// The part of a content of `size` bytes that `header` asks for.
ByteRange byte_range(std::string_view header, std::uint64_t size);

}  // namespace trunnion::gateway
