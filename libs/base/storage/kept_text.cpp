// SPDX-License-Identifier: Apache-2.0
#include "storage/kept_text.hpp"

#include <charconv>
#include <cstdio>

#include "storage/crc32.hpp"

namespace trunnion::storage {
namespace {

constexpr std::string_view mark = "# trunnion-state ";

// Everything of the last line before the checksum, which includes it.
std::string head_of(std::string_view name, std::uint64_t generation, bool line_end_added) {
  std::string head(mark);
  head.append("format=").append(std::to_string(kept_format)).append(" file=").append(name);
  head.append(" generation=").append(std::to_string(generation));
  return head.append(line_end_added ? " line_end=added" : "").append(" crc32=");
}

std::string digits_of(std::uint32_t crc) {
  char digits[9];
  std::snprintf(digits, sizeof digits, "%08x", crc);
  return digits;
}

// The word behind `key` in the last line, empty when it has none.
std::string_view field(std::string_view line, std::string_view key) {
  const auto at = line.find(key);
  if (at == std::string_view::npos) return {};
  const auto from = at + key.size();
  return line.substr(from, line.find(' ', from) - from);
}

template <class Number>
bool parse(std::string_view text, Number& value) {
  const auto result = std::from_chars(text.data(), text.data() + text.size(), value);
  return !text.empty() && result.ec == std::errc{} && result.ptr == text.data() + text.size();
}

bool has_mark(std::string_view text) { return text.find(mark) != std::string_view::npos; }

Kept use(const Unsealed& from, KeptState state, std::string problem) {
  return {state, from.content, from.generation, std::move(problem)};
}

}  // namespace

std::string seal(std::string_view name, std::uint64_t generation, std::string_view content) {
  const bool add = !content.empty() && content.back() != '\n';
  std::string text(content);
  if (add) text += '\n';
  text += head_of(name, generation, add);
  return text.append(digits_of(crc32(text))).append(1, '\n');
}

std::optional<Unsealed> unseal(std::string_view name, std::string_view text, std::string& problem) {
  const auto refuse = [&](std::string why) {
    problem = std::move(why);
    return std::nullopt;
  };
  if (text.empty()) return refuse("it is empty");
  if (text.back() != '\n') return refuse("its last line is incomplete");
  const auto before = text.rfind('\n', text.size() - 2);
  const auto start = before == std::string_view::npos ? 0 : before + 1;
  const auto line = text.substr(start, text.size() - 1 - start);
  if (!line.starts_with(mark)) return refuse("its last line, with the checksum, is missing");
  const auto checksum = field(line, " crc32=");
  if (checksum != digits_of(crc32(std::string_view(text.data(), text.size() - 1 - checksum.size()))))
    return refuse("its checksum is wrong");
  unsigned format = 0;
  if (!parse(field(line, " format="), format) || format > kept_format)
    return refuse("its format is " + std::string(field(line, " format=")) +
                  ", and this version reads up to " + std::to_string(kept_format) +
                  ": install a newer version");
  if (const auto file = field(line, " file="); file != name)
    return refuse("it has the content of " + std::string(file));
  Unsealed result;
  if (!parse(field(line, " generation="), result.generation)) return refuse("it has no generation");
  const bool added = field(line, " line_end=") == "added";
  result.content = std::string(text.substr(0, added && start > 0 ? start - 1 : start));
  return result;
}

Kept decide(std::string_view name, const std::optional<std::string>& newest,
            const std::optional<std::string>& previous, bool interrupted) {
  std::string newest_problem = "it is missing", previous_problem;
  std::optional<Unsealed> fresh, old;
  if (newest) fresh = unseal(name, *newest, newest_problem);
  if (previous) old = unseal(name, *previous, previous_problem);
  if (!newest && !previous) return {};
  if (fresh && old && fresh->generation <= old->generation && !interrupted)
    return use(fresh->generation == old->generation ? *fresh : *old, KeptState::previous,
               "it is an old copy of generation " + std::to_string(fresh->generation));
  if (fresh) return use(*fresh, KeptState::good, "");
  // Only this version writes a previous generation: without one the file may be of the version before.
  if (newest && !previous && !has_mark(*newest)) return {KeptState::good, *newest, 0, ""};
  if (old) return use(*old, KeptState::previous, newest_problem);
  return {KeptState::unusable, "", 0,
          newest_problem + (previous ? "; of its previous generation: " + previous_problem
                                     : "; there is no previous generation")};
}

}  // namespace trunnion::storage
