// SPDX-License-Identifier: Apache-2.0
// gzip (RFC 1952) as a content coding of HTTP.
#pragma once

#include <string>
#include <string_view>

namespace trunnion::gateway {

/// Smaller bodies are sent as they are: the packet is the same.
inline constexpr std::size_t least_compressed = 1400;

/// Whether the header Accept-Encoding (RFC 9110, 12.5.3) permits gzip: named or by *, with a weight above 0.
bool accepts_gzip(std::string_view accept_encoding);

/// Whether content of this MIME type becomes smaller.
bool is_compressible(std::string_view type);

/// `level` from 1 (fastest) to 9 (smallest). The same bytes for the same text.
std::string gzip(std::string_view text, int level);

}  // namespace trunnion::gateway
