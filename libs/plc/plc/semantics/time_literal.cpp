// SPDX-License-Identifier: Apache-2.0
#include "plc/semantics/time_literal.hpp"

#include <chrono>
#include <limits>

namespace trunnion::st {
namespace {

constexpr std::int64_t second = 1000000000;

struct TimeUnit {
  std::string_view name;
  std::int64_t ns;
};
// Longer names first where one begins with another.
constexpr TimeUnit units[] = {{"ms", 1000000},      {"us", 1000},       {"ns", 1},    {"d", 86400 * second},
                              {"h", 3600 * second}, {"m", 60 * second}, {"s", second}};

class Scanner {
 public:
  explicit Scanner(std::string_view text) : text_(text) {}
  bool at_end() const { return text_.empty(); }
  bool accept(char c) {
    if (text_.empty() || text_[0] != c) return false;
    text_.remove_prefix(1);
    return true;
  }
  /// At most 15 digits with underscores between them.
  std::optional<std::int64_t> number() {
    std::int64_t value = 0;
    int digits = 0;
    while (!text_.empty() && ((text_[0] >= '0' && text_[0] <= '9') || (digits > 0 && text_[0] == '_'))) {
      if (text_[0] != '_') value = value * 10 + (text_[0] - '0'), ++digits;
      text_.remove_prefix(1);
      if (digits > 15) return std::nullopt;
    }
    return digits > 0 ? std::optional(value) : std::nullopt;
  }
  /// Digits behind a decimal point as a share of `unit`.
  std::int64_t fraction(std::int64_t unit) {
    std::int64_t value = 0;
    while (!text_.empty() && text_[0] >= '0' && text_[0] <= '9') {
      unit /= 10;
      // The share of a unit that is no power of ten, as of minutes, is rounded down.
      value += (text_[0] - '0') * unit;
      text_.remove_prefix(1);
    }
    return value;
  }
  const TimeUnit* unit() {
    for (const auto& unit : units) {
      if (text_.size() < unit.name.size()) continue;
      bool same = true;
      for (std::size_t i = 0; i < unit.name.size(); ++i) same = same && (text_[i] | 0x20) == unit.name[i];
      if (!same) continue;
      text_.remove_prefix(unit.name.size());
      return &unit;
    }
    return nullptr;
  }

 private:
  std::string_view text_;
};

std::optional<std::int64_t> clock(Scanner& scanner, std::string& problem) {
  const auto hour = scanner.number();
  const bool first = scanner.accept(':');
  const auto minute = scanner.number();
  std::optional<std::int64_t> whole = 0;
  std::int64_t fraction = 0;
  if (scanner.accept(':')) {
    whole = scanner.number();
    if (scanner.accept('.')) fraction = scanner.fraction(second);
  }
  if (!hour || !first || !minute || !whole || !scanner.at_end()) {
    problem = "a time of day is hours:minutes:seconds, as TOD#23:59:59.5";
    return std::nullopt;
  }
  if (*hour > 23 || *minute > 59 || *whole > 59) {
    problem = "hours are 0 .. 23, minutes and seconds 0 .. 59";
    return std::nullopt;
  }
  return (*hour * 3600 + *minute * 60 + *whole) * second + fraction;
}

std::optional<std::int64_t> day(Scanner& scanner, std::string& problem) {
  const auto year = scanner.number();
  const bool first = scanner.accept('-');
  const auto month = scanner.number();
  const bool next = scanner.accept('-');
  const auto number = scanner.number();
  if (!year || !first || !month || !next || !number) {
    problem = "a date is year-month-day, as D#2026-02-28";
    return std::nullopt;
  }
  if (*year < 1970 || *year > 2200 || *month < 1 || *month > 12 || *number < 1 || *number > 31) {
    problem = "there is no such day between 1970 and 2200";
    return std::nullopt;
  }
  const std::chrono::year_month_day date{std::chrono::year(static_cast<int>(*year)),
                                         std::chrono::month(static_cast<unsigned>(*month)),
                                         std::chrono::day(static_cast<unsigned>(*number))};
  if (!date.ok()) {
    problem = "there is no such day between 1970 and 2200";
    return std::nullopt;
  }
  return std::chrono::sys_days(date).time_since_epoch().count() * 86400 * second;
}

}  // namespace

std::optional<std::int64_t> parse_duration(std::string_view text, std::string& problem) {
  problem =
      "a time has numbers with the units d, h, m, s, ms, us, ns, the largest first, as T#1h30m or T#2.5s";
  Scanner scanner(text);
  const bool negative = scanner.accept('-');
  if (scanner.at_end()) return std::nullopt;
  std::int64_t total = 0, last = std::numeric_limits<std::int64_t>::max();
  while (!scanner.at_end()) {
    const auto number = scanner.number();
    if (!number) return std::nullopt;
    std::int64_t fraction = 0;
    const bool has_fraction = scanner.accept('.');
    if (has_fraction) {
      // The unit comes behind the digits.
      auto digits = scanner;
      if (!digits.number()) return std::nullopt;
      const auto* unit = digits.unit();
      if (unit == nullptr) return std::nullopt;
      fraction = scanner.fraction(unit->ns);
    }
    const auto* unit = scanner.unit();
    if (unit == nullptr || unit->ns >= last || (has_fraction && !scanner.at_end())) return std::nullopt;
    last = unit->ns;
    std::int64_t part = 0;
    if (__builtin_mul_overflow(*number, unit->ns, &part) || __builtin_add_overflow(part, fraction, &part) ||
        __builtin_add_overflow(total, part, &total)) {
      problem = "the time is longer than 292 years";
      return std::nullopt;
    }
    while (scanner.accept('_')) {
    }
  }
  return negative ? -total : total;
}

std::optional<std::int64_t> parse_date(std::string_view text, std::string& problem) {
  Scanner scanner(text);
  const auto result = day(scanner, problem);
  if (!result || scanner.at_end()) return result;
  problem = "a date is year-month-day, as D#2026-02-28";
  return std::nullopt;
}

std::optional<std::int64_t> parse_time_of_day(std::string_view text, std::string& problem) {
  Scanner scanner(text);
  return clock(scanner, problem);
}

std::optional<std::int64_t> parse_date_and_time(std::string_view text, std::string& problem) {
  Scanner scanner(text);
  const auto date = day(scanner, problem);
  if (!date) return std::nullopt;
  if (!scanner.accept('-')) {
    problem = "a date with time is year-month-day-hours:minutes:seconds";
    return std::nullopt;
  }
  const auto time = clock(scanner, problem);
  return time ? std::optional(*date + *time) : std::nullopt;
}

}  // namespace trunnion::st
