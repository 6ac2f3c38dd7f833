// SPDX-License-Identifier: Apache-2.0
#include "plc/syntax/diagnostics.hpp"

#include <algorithm>
#include <tuple>

namespace trunnion::st {

void Diagnostics::error(Position at, std::string text) {
  ++errors_;
  if (entries_.size() < most) entries_.push_back({Severity::error, at, std::move(text)});
}

void Diagnostics::warning(Position at, std::string text) {
  if (entries_.size() < most) entries_.push_back({Severity::warning, at, std::move(text)});
}

std::vector<Diagnostic> Diagnostics::sorted() const {
  auto result = entries_;
  const auto key = [](const Diagnostic& d) { return std::tie(d.at.file, d.at.line, d.at.column); };
  std::stable_sort(result.begin(), result.end(),
                   [&](const Diagnostic& a, const Diagnostic& b) { return key(a) < key(b); });
  const auto same = [&](const Diagnostic& a, const Diagnostic& b) {
    return key(a) == key(b) && a.text == b.text;
  };
  result.erase(std::unique(result.begin(), result.end(), same), result.end());
  return result;
}

std::string to_line(const Diagnostic& d, const std::vector<std::string>& files) {
  const auto file = d.at.file < files.size() ? files[d.at.file] : std::string("?");
  return file + ":" + std::to_string(d.at.line) + ":" + std::to_string(d.at.column) +
         (d.severity == Severity::error ? ": error: " : ": warning: ") + d.text;
}

}  // namespace trunnion::st
