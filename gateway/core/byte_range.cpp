// SPDX-License-Identifier: Apache-2.0
#include "core/byte_range.hpp"

#include <algorithm>
#include <charconv>
#include <optional>

namespace trunnion::gateway {
namespace {

// Decimal digits only; what is too large for 64 bits is as good as the largest number.
std::optional<std::uint64_t> whole_number(std::string_view text) {
  if (text.empty() || text.find_first_not_of("0123456789") != std::string_view::npos) return {};
  std::uint64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() ? value : UINT64_MAX;
}

}  // namespace

ByteRange byte_range(std::string_view header, std::uint64_t size) {
  const ByteRange whole{ByteRange::Kind::whole, 0, size}, outside{ByteRange::Kind::outside, 0, 0};
  constexpr std::string_view unit = "bytes=";
  if (!header.starts_with(unit)) return whole;
  header.remove_prefix(unit.size());
  const auto minus = header.find('-');
  if (minus == std::string_view::npos) return whole;
  const auto from = header.substr(0, minus), to = header.substr(minus + 1);
  if (from.empty()) {
    const auto last = whole_number(to);
    if (!last) return whole;
    if (*last == 0 || size == 0) return outside;
    const auto count = std::min(*last, size);
    return {ByteRange::Kind::part, size - count, count};
  }
  const auto first = whole_number(from);
  const auto last = to.empty() ? std::optional(UINT64_MAX) : whole_number(to);
  if (!first || !last || *last < *first) return whole;
  if (*first >= size) return outside;
  return {ByteRange::Kind::part, *first, std::min(*last, size - 1) - *first + 1};
}

}  // namespace trunnion::gateway
