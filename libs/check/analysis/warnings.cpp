// SPDX-License-Identifier: Apache-2.0
#include "analysis/warnings.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <tuple>

namespace trunnion::analysis {
namespace {

constexpr std::size_t index_of(WarningKind kind) { return static_cast<std::size_t>(kind); }
static_assert(warning_rules.size() == index_of(WarningKind::end_missing) + 1);

}  // namespace

const WarningRule& rule_of(const Warning& warning) { return warning_rules[index_of(warning.kind)]; }

std::string text_of(const Warning& warning) {
  const WarningRule& rule = rule_of(warning);
  const std::string found =
      warning.detail.empty() ? std::string(rule.text) : fmt::format("{}: {}", rule.text, warning.detail);
  return fmt::format("{}; {}", found, rule.remedy);
}

Warning* Warnings::add(WarningKind kind, const WarningPlace& place, std::uint32_t about) {
  for (Warning& known : found_) {
    if (known.kind != kind || known.about != about) continue;
    ++known.blocks;
    return nullptr;
  }
  if (found_.size() == most) return nullptr;
  return &found_.emplace_back(Warning{kind, place, about, 1, {}});
}

std::vector<Warning> Warnings::sorted() const {
  auto result = found_;
  std::stable_sort(result.begin(), result.end(), [](const Warning& a, const Warning& b) {
    const auto key = [](const Warning& w) {
      return std::tuple(w.place.program, w.place.line, w.place.column);
    };
    return key(a) < key(b);
  });
  return result;
}

WarningPlace place_in(std::uint32_t program, std::uint32_t number, std::string_view line,
                      std::size_t offset) {
  const auto before = line.substr(0, std::min(offset, line.size()));
  const auto is_first = [](char c) { return (static_cast<unsigned char>(c) & 0xc0u) != 0x80u; };
  const auto characters = std::count_if(before.begin(), before.end(), is_first);
  return {program, number, static_cast<std::uint32_t>(characters) + 1};
}

}  // namespace trunnion::analysis
