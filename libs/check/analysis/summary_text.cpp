// SPDX-License-Identifier: Apache-2.0
// A summary in lines.
#include <fmt/core.h>

#include <cmath>
#include <string>

#include "analysis/check_parts.hpp"
#include "analysis/summary_report.hpp"

namespace trunnion::analysis {
namespace {

std::string at_place(const WarningPlace& place, const TextName& name) {
  const std::string text = place.program == 0 ? "" : fmt::format("{} ", name(place.program));
  return fmt::format("{}line {}:{}", text, place.line, place.column);
}

/// To four decimals, and 0 without a sign.
double shown(double value) { return std::round(value * 1e4) / 1e4 + 0.0; }

std::string part_of_time(const char* what, double seconds, double total) {
  const double percent = total > 0 ? seconds / total * 100 : 0;
  return fmt::format("{} {} ({:.0f} %)", what, duration(seconds), percent);
}

std::string from_to(char letter, const Range& range) {
  if (range.low == range.high) return fmt::format("; {}{:.7g}", letter, range.low);
  return fmt::format("; {}{:.7g} .. {:.7g}", letter, range.low, range.high);
}

std::string numbers(char letter, const std::vector<std::uint16_t>& list) {
  std::string text;
  for (const auto number : list) text += fmt::format(" {}{}", letter, number);
  return text;
}

std::string time_line(const SummaryReport& report) {
  const auto& figures = report.figures;
  const auto& time = figures.time();
  if (figures.machine() == nullptr)
    return fmt::format(
        "time     cutting {}, dwell {}; rapids over {:.3f} mm have no time without --machine\n",
        duration(time.cut), duration(time.dwell), figures.rapid_length());
  const double total = time.total();
  const std::string changes =
      fmt::format("{} tool change{}", figures.changes(), figures.changes() == 1 ? "" : "s");
  return fmt::format("time     {}: {}, {}, {}, {}\n", duration(total),
                     part_of_time("cutting", time.cut, total), part_of_time("rapid", time.rapid, total),
                     part_of_time("dwell", time.dwell, total),
                     part_of_time(changes.c_str(), time.change, total));
}

std::string tool_line(const ToolFigures& tool, const SummaryReport& report) {
  std::string text = tool.number == 0 ? std::string("without a tool change")
                                      : fmt::format("T{}{}{}", tool.number, numbers('H', tool.lengths),
                                                    numbers('D', tool.radii));
  text += fmt::format(", from {}", at_place(tool.first, report.name));
  const auto entry = report.environment.tool_offset(tool.number);
  if (report.lengths_known && tool.number != 0 && entry) {
    text += fmt::format("; {:.7g} mm long", entry->length + entry->length_wear);
    if (entry->radius) text += fmt::format(", radius {:.7g} mm", *entry->radius);
  }
  text += fmt::format("; cutting {}", duration(tool.cut));
  if (report.figures.machine() != nullptr) text += fmt::format(", rapid {}", duration(tool.rapid));
  if (tool.speed.any) text += from_to('S', tool.speed);
  if (tool.feed.any) text += from_to('F', tool.feed);
  return fmt::format("tool     {}\n", text);
}

std::string offset_lines(const SummaryReport& report) {
  std::string lines;
  const auto& offsets = report.figures.offsets();
  for (std::size_t i = 0; i < offsets.size(); ++i) {
    if (!offsets[i].used) continue;
    lines += fmt::format("{:<8} tool tip", work_offset_name(i));
    for (std::size_t axis = 0; axis < 3; ++axis)
      if (((report.environment.axes() >> axis) & 1u) != 0)
        lines += fmt::format("{} {} {:.4f} .. {:.4f}", axis == 0 ? "" : ",", language::axis_letters[axis],
                             shown(offsets[i].low[axis]), shown(offsets[i].high[axis]));
    lines += "\n";
  }
  return lines;
}

std::string axis_lines(const SummaryReport& report) {
  std::string lines;
  const auto* const machine = report.figures.machine();
  const auto& box = report.figures.axes();
  if (machine == nullptr || !box) return lines;
  for (const auto axis : machine->channel_axes().index) {
    const auto& travel = machine->travel(axis);
    const char letter = language::axis_letters[axis];
    lines += fmt::format("{}        machine {:.4f} .. {:.4f}", letter, shown(box->low[axis]),
                         shown(box->high[axis]));
    if (const auto reserve = report.figures.reserve(axis))
      lines += fmt::format(", travel {:.7g} .. {:.7g}, reserve {:.4f}", travel.negative, travel.positive,
                           *reserve);
    lines += "\n";
  }
  return lines;
}

std::string list_line(const char* title, const std::vector<NamedFigure>& list) {
  if (list.empty()) return {};
  std::string text;
  for (const NamedFigure& one : list)
    text += fmt::format("{} {}{}", text.empty() ? "" : ",", one.name,
                        one.blocks > 1 ? fmt::format(" ({} blocks)", one.blocks) : std::string());
  return fmt::format("{:<8}{}\n", title, text);
}

std::string named_lines(const char* title, const std::vector<NamedFigure>& list, const TextName& name) {
  std::string lines;
  for (const NamedFigure& one : list)
    lines += fmt::format("{} {}: {}{}{}\n", title, at_place(one.place, name), one.name,
                         one.text.empty() ? "" : ", ", one.text);
  return lines;
}

std::string unknown_of(const SummaryReport& report) {
  if (report.figures.machine() != nullptr) return {};
  std::string codes;
  for (const NamedFigure& code : report.figures.other_m()) codes += fmt::format(" {}", code.name);
  return unknown_lines(report.environment.axes(), codes);
}

std::string highest_line(const SummaryReport& report) {
  const auto& speed = report.figures.highest_speed();
  const auto& feed = report.figures.highest_feed();
  std::string text;
  if (speed.value > 0)
    text += fmt::format(" S{:.7g} 1/min in {}", speed.value, at_place(speed.place, report.name));
  if (feed.value > 0)
    text += fmt::format("{} F{:.7g} mm/min in {}", text.empty() ? "" : ",", feed.value,
                        at_place(feed.place, report.name));
  return text.empty() ? text : fmt::format("highest {}\n", text);
}

}  // namespace

std::string duration(double seconds) {
  constexpr double shown_in_seconds = 100;
  constexpr long of_minute = 60, of_hour = 3600;
  if (seconds < shown_in_seconds) return fmt::format("{:.1f} s", seconds);
  const long whole = std::lround(seconds);
  return fmt::format("{}:{:02}:{:02} h", whole / of_hour, whole % of_hour / of_minute, whole % of_minute);
}

std::string to_text(const SummaryReport& report) {
  const auto& figures = report.figures;
  std::string text = fmt::format("program  {} lines, {} blocks executed\n", report.lines, report.blocks);
  text += time_line(report);
  for (const ToolFigures& tool : figures.tools()) text += tool_line(tool, report);
  text += offset_lines(report);
  text += axis_lines(report);
  text += list_line("calls", figures.calls());
  text += list_line("cycles", figures.cycles());
  text += highest_line(report);
  if (figures.printed() > 0) text += fmt::format("prints   {} lines of DPRNT\n", figures.printed());
  text += unknown_of(report);
  text += named_lines("no effect", figures.without_effect(), report.name);
  text += named_lines("unknown M code", figures.unknown_m(), report.name);
  text += warning_lines(report.warnings, report.name);
  return text;
}

}  // namespace trunnion::analysis
