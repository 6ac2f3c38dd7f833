// SPDX-License-Identifier: Apache-2.0
// Literals of times and dates (IEC 61131-3:2013, 6.3.4 and 6.3.5), in ns; dates since 1970-01-01 without leap
// seconds.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace trunnion::st {

inline constexpr std::int64_t millisecond = 1000000;  ///< ns

/// 1d2h3m4.5s, 1h30m, 100ms, 5us, 20ns, with an optional minus and underscores. Without a result `problem`
/// says why.
std::optional<std::int64_t> parse_duration(std::string_view text, std::string& problem);
/// 2026-02-28
std::optional<std::int64_t> parse_date(std::string_view text, std::string& problem);
/// 23:59:59.5
std::optional<std::int64_t> parse_time_of_day(std::string_view text, std::string& problem);
/// 2026-02-28-23:59:59
std::optional<std::int64_t> parse_date_and_time(std::string_view text, std::string& problem);

}  // namespace trunnion::st
