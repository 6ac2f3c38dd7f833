// SPDX-License-Identifier: Apache-2.0
// How often a test with drawn values repeats itself.
#pragma once

#include <cstdint>

namespace trunnion::testing_support {

/// Whether a sanitizer watches: it looks for other faults than the drawn values do, and is five to twenty
/// times slower.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr bool sanitized = true;
#elif defined(__has_feature)
inline constexpr bool sanitized = __has_feature(address_sanitizer) || __has_feature(thread_sanitizer);
#else
inline constexpr bool sanitized = false;
#endif

/// `all`, and a quarter of it under a sanitizer.
constexpr std::uint64_t rounds(std::uint64_t all) { return sanitized ? (all + 3) / 4 : all; }

}  // namespace trunnion::testing_support
