// SPDX-License-Identifier: Apache-2.0
// Moments of the wall clock, for people and spreadsheets.
#pragma once

#include <cstdint>
#include <ctime>
#include <string>

namespace trunnion::text {

/// ISO 8601 in UTC, "2026-03-01T10:00:00.250Z". `nanoseconds` since the epoch, cut to `digits` decimals of
/// the second, 1..9.
std::string instant(std::uint64_t nanoseconds, std::size_t digits = 3);
/// The same to the second, "2026-03-01T10:00:00Z". `seconds` since the epoch.
std::string whole_second(std::time_t seconds);

}  // namespace trunnion::text
