// SPDX-License-Identifier: Apache-2.0
#include "analysis/default_machine.hpp"

#include <charconv>
#include <cmath>
#include <stdexcept>
#include <vector>

namespace trunnion::analysis {
namespace {

constexpr double highest_tool = 65535;
constexpr double longest = 100000;  // mm
constexpr std::string_view byte_order_mark = "\xef\xbb\xbf";

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

std::optional<double> number(std::string_view text) {
  double value = 0;
  const auto result = std::from_chars(text.data(), text.data() + text.size(), value);
  if (result.ec != std::errc{} || result.ptr != text.data() + text.size() || !std::isfinite(value))
    return std::nullopt;
  return value;
}

std::vector<std::string_view> columns(std::string_view line) {
  std::vector<std::string_view> result;
  for (std::size_t from = 0; from <= line.size();) {
    const std::size_t comma = std::min(line.find(',', from), line.size());
    result.push_back(trimmed(line.substr(from, comma - from)));
    from = comma + 1;
  }
  return result;
}

}  // namespace

ToolRows read_tool_rows(const std::string& text, const std::string& file) {
  ToolRows rows;
  std::size_t line_number = 0;
  bool names_allowed = true;
  for (std::size_t from = text.starts_with(byte_order_mark) ? byte_order_mark.size() : 0;
       from < text.size();) {
    const std::size_t end = std::min(text.find('\n', from), text.size());
    const std::string_view line = trimmed(std::string_view(text).substr(from, end - from));
    from = end + 1;
    ++line_number;
    const auto fail = [&](const std::string& what) {
      throw std::runtime_error(
          std::string(file).append(":").append(std::to_string(line_number)).append(": ").append(what));
    };
    if (line.empty() || line.front() == '#') continue;
    const auto fields = columns(line);
    const auto tool = number(fields[0]);
    // A row that is no tool's has a number all the same.
    const bool names = names_allowed && line.find_first_of("0123456789") == std::string_view::npos;
    names_allowed = false;
    if (names) continue;
    if (!tool || *tool < 1 || *tool > highest_tool || *tool != std::floor(*tool))
      fail(std::string("tool number must be a whole number 1 to 65535, not '").append(fields[0]).append("'"));
    if (fields.size() < 2 || fields.size() > 3) fail("expected number,length,radius");
    const auto length = number(fields[1]);
    const auto radius = fields.size() == 3 ? number(fields[2]) : 0.0;
    if (!length || std::abs(*length) > longest) fail("length must be a number of mm");
    if (!radius || *radius < 0 || *radius > longest) fail("radius must be a number of mm, not below zero");
    if (!rows.emplace(static_cast<std::uint16_t>(*tool), ToolRow{*length, *radius}).second)
      fail("tool number twice");
  }
  return rows;
}

std::optional<double> DefaultMachine::tool_length(std::uint16_t h) const {
  if (!tools_) return 0.0;
  const auto found = tools_->find(h);
  return found == tools_->end() ? std::nullopt : std::optional(found->second.length);
}

std::optional<language::ToolOffset> DefaultMachine::tool_offset(std::uint16_t number) const {
  if (!tools_) return language::ToolOffset{0, 0, 0.0, 0};
  const auto found = tools_->find(number);
  if (found == tools_->end()) return std::nullopt;
  return language::ToolOffset{found->second.length, 0, found->second.radius, 0};
}

language::AxisValues DefaultMachine::tip_from_machine(const language::AxisValues& machine,
                                                      double tool_length) const {
  language::AxisValues tip = machine;
  tip[language::Z] -= tool_length;
  return tip;
}

language::AxisValues DefaultMachine::machine_from_tip(const language::AxisValues& tip,
                                                      double tool_length) const {
  language::AxisValues machine = tip;
  machine[language::Z] += tool_length;
  return machine;
}

}  // namespace trunnion::analysis
