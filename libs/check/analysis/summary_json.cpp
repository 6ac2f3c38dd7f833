// SPDX-License-Identifier: Apache-2.0
// A summary as one JSON document: mm, degrees, seconds, 1/min, mm/min.
#include <nlohmann/json.hpp>

#include "analysis/foreign_text.hpp"
#include "analysis/summary_report.hpp"

namespace trunnion::analysis {
namespace {

using Json = nlohmann::ordered_json;

void put_place(Json& json, const WarningPlace& place, const TextName& name) {
  if (place.program != 0) json["program"] = name(place.program);
  json["line"] = place.line;
  json["column"] = place.column;
}

Json range_json(const Range& range) {
  if (!range.any) return nullptr;
  return {{"from", range.low}, {"to", range.high}};
}

Json tool_json(const ToolFigures& tool, const SummaryReport& report) {
  Json json = {{"tool", tool.number}};
  put_place(json, tool.first, report.name);
  json["changes"] = tool.changes;
  json["h"] = tool.lengths;
  json["d"] = tool.radii;
  const auto entry = report.environment.tool_offset(tool.number);
  if (report.lengths_known && tool.number != 0 && entry) {
    json["length"] = entry->length + entry->length_wear;
    if (entry->radius) json["radius"] = *entry->radius;
  }
  json["cut_seconds"] = tool.cut;
  json["rapid_seconds"] = report.figures.machine() == nullptr ? Json(nullptr) : Json(tool.rapid);
  json["speed"] = range_json(tool.speed);
  json["feed"] = range_json(tool.feed);
  return json;
}

Json time_json(const ProgramFigures& figures) {
  const auto& time = figures.time();
  Json json = {{"cut", time.cut}, {"dwell", time.dwell}};
  if (figures.machine() == nullptr) return json;
  json["rapid"] = time.rapid;
  json["tool_change"] = time.change;
  json["total"] = time.total();
  return json;
}

Json offsets_json(const SummaryReport& report) {
  Json list = Json::array();
  const auto& offsets = report.figures.offsets();
  for (std::size_t i = 0; i < offsets.size(); ++i) {
    if (!offsets[i].used) continue;
    Json tip = Json::object();
    for (std::size_t axis = 0; axis < 3; ++axis)
      tip[std::string(1, language::axis_letters[axis])] = {{"from", offsets[i].low[axis]},
                                                           {"to", offsets[i].high[axis]}};
    list.push_back(Json{{"offset", work_offset_name(i)}, {"tip", tip}});
  }
  return list;
}

Json axes_json(const SummaryReport& report) {
  Json json = Json::object();
  const auto* const machine = report.figures.machine();
  const auto& box = report.figures.axes();
  if (machine == nullptr || !box) return json;
  for (const auto axis : machine->channel_axes().index) {
    Json one = {{"from", box->low[axis]}, {"to", box->high[axis]}};
    const auto& travel = machine->travel(axis);
    if (const auto reserve = report.figures.reserve(axis)) {
      one["travel"] = {{"from", travel.negative}, {"to", travel.positive}};
      one["reserve"] = *reserve;
    }
    json[std::string(1, language::axis_letters[axis])] = one;
  }
  return json;
}

Json named_json(const std::vector<NamedFigure>& list, const SummaryReport& report) {
  Json json = Json::array();
  for (const NamedFigure& one : list) {
    Json entry = {{"name", one.name}};
    put_place(entry, one.place, report.name);
    entry["blocks"] = one.blocks;
    if (!one.text.empty()) entry["text"] = one.text;
    json.push_back(entry);
  }
  return json;
}

Json warnings_json(const SummaryReport& report) {
  Json json = Json::array();
  for (const Warning& warning : report.warnings.sorted()) {
    const WarningRule& rule = rule_of(warning);
    Json entry = {{"warning", rule.name}};
    put_place(entry, warning.place, report.name);
    entry["blocks"] = warning.blocks;
    entry["text"] = rule.text;
    if (!warning.detail.empty()) entry["detail"] = warning.detail;
    entry["remedy"] = rule.remedy;
    json.push_back(entry);
  }
  return json;
}

Json highest_json(const Highest& highest, const SummaryReport& report) {
  if (!(highest.value > 0)) return nullptr;
  Json json = {{"value", highest.value}};
  put_place(json, highest.place, report.name);
  return json;
}

Json error_json(const SummaryReport& report) {
  const auto& alarm = *report.alarm;
  Json json = {{"number", static_cast<unsigned>(alarm.number)}, {"text", report.alarm_text}};
  put_place(json, {alarm.program, alarm.line, alarm.column}, report.name);
  if (alarm.foreign != nullptr) json["remedy"] = foreign_text(*alarm.foreign);
  return json;
}

}  // namespace

std::string to_json(const SummaryReport& report) {
  const auto& figures = report.figures;
  Json json = {{"lines", report.lines}, {"blocks", report.blocks}};
  json["seconds"] = time_json(figures);
  json["tool_changes"] = figures.changes();
  json["rapid_length"] = figures.rapid_length();
  json["cut_length"] = figures.cut_length();
  json["tools"] = Json::array();
  for (const ToolFigures& tool : figures.tools()) json["tools"].push_back(tool_json(tool, report));
  json["work_offsets"] = offsets_json(report);
  json["axes"] = axes_json(report);
  json["calls"] = named_json(figures.calls(), report);
  json["cycles"] = named_json(figures.cycles(), report);
  json["highest"] = {{"speed", highest_json(figures.highest_speed(), report)},
                     {"feed", highest_json(figures.highest_feed(), report)}};
  json["printed_lines"] = figures.printed();
  json["no_effect"] = named_json(figures.without_effect(), report);
  json["unknown_m"] = named_json(figures.unknown_m(), report);
  json["other_m"] = named_json(figures.other_m(), report);
  json["warnings"] = warnings_json(report);
  if (report.repeats_from != 0) json["repeats_from"] = report.repeats_from;
  if (report.alarm) json["error"] = error_json(report);
  return json.dump(2, ' ', false, Json::error_handler_t::replace);
}

}  // namespace trunnion::analysis
