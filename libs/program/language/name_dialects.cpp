// SPDX-License-Identifier: Apache-2.0
#include "language/name_dialects.hpp"

#include <algorithm>
#include <stdexcept>

namespace trunnion::language {
namespace {

constexpr char small(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

bool same_letters(std::string_view a, std::string_view b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](char x, char y) { return small(x) == small(y); });
}

/// The next word of `text`, which then begins behind it; empty at its end.
std::string_view next_word(std::string_view& text) {
  text.remove_prefix(std::min(text.find_first_not_of(' '), text.size()));
  const auto word = text.substr(0, text.find(' '));
  text.remove_prefix(word.size());
  return word;
}

[[noreturn]] void fail(std::string_view ending, std::string_view what) {
  throw std::runtime_error(std::string("'").append(ending).append("' ").append(what));
}

}  // namespace

void NameDialects::add(std::string_view text) {
  while (!text.empty()) {
    auto rule = text.substr(0, text.find(';'));
    text.remove_prefix(std::min(rule.size() + 1, text.size()));
    const auto ending = next_word(rule);
    if (ending.empty()) continue;
    const auto dialect = canonical::dialect_named(next_word(rule));
    if (!dialect || !next_word(rule).empty()) {
      std::string names;
      for (const auto name : canonical::dialect_names) names.append(names.empty() ? "" : ", ").append(name);
      fail(ending, names.insert(0, "needs one dialect: "));
    }
    for (const Rule& other : rules_)
      if (same_letters(other.ending, ending)) fail(ending, "is there twice");
    rules_.push_back({std::string(ending), *dialect});
  }
}

std::optional<canonical::ProgramDialect> NameDialects::of(std::string_view name) const {
  const Rule* longest = nullptr;
  for (const Rule& rule : rules_) {
    const auto size = rule.ending.size();
    if (size > name.size() || (longest != nullptr && longest->ending.size() >= size)) continue;
    if (same_letters(name.substr(name.size() - size), rule.ending)) longest = &rule;
  }
  return longest == nullptr ? std::nullopt : std::optional(longest->dialect);
}

}  // namespace trunnion::language
