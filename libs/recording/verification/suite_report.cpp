// SPDX-License-Identifier: Apache-2.0
#include "verification/suite_report.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <span>

#include "report/plot.hpp"

namespace trunnion::verification {
namespace {

using report::escaped;
using report::PlotPoint;

std::string seconds_text(double seconds) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3f", seconds);
  return text;
}

std::string string_at(const bus::Json& json, const char* key) {
  return json.is_object() && json.contains(key) && json[key].is_string() ? json[key].get<std::string>() : "";
}

const bus::Json* first_of(const SuiteResult& result) {
  if (!result.report.is_object() || !result.report.contains("first")) return nullptr;
  const auto& first = result.report["first"];
  return first.is_object() && first.contains("around") && first["around"].is_array() ? &first : nullptr;
}

bool is_cyclic(const bus::Json& first) { return first.contains("cycle"); }

std::uint64_t index_of(const bus::Json& first) {
  const char* key = is_cyclic(first) ? "cycle" : "message";
  return first.contains(key) && first[key].is_number_unsigned() ? first[key].get<std::uint64_t>() : 0;
}

std::string headline(const bus::Json& first) {
  const auto series = string_at(first, "series"), field = string_at(first, "field");
  const auto meaning = string_at(first, "meaning");
  return string_at(first, "topic") + (series.empty() ? "" : ", " + series) +
         (is_cyclic(first) ? ", cycle " : ", message ") + std::to_string(index_of(first)) +
         (field.empty() ? ", only in one of them" : ", " + field) +
         (meaning.empty() ? "" : " (" + meaning + ")");
}

std::optional<double> value_of(const bus::Json& row, const char* side) {
  const auto text = string_at(row, side);
  try {
    std::size_t used = 0;
    const double value = std::stod(text, &used);
    if (used == text.size() && std::isfinite(value)) return value;
  } catch (const std::exception&) {
  }
  return std::nullopt;
}

/// Both sides over the cycles around the first difference; nothing when they are no numbers.
std::string plot_of(const bus::Json& first) {
  std::vector<PlotPoint> recorded, now;
  for (const auto& row : first["around"]) {
    if (!row.is_object() || !row.contains("index") || !row["index"].is_number()) continue;
    const double x = row["index"].get<double>();
    if (const auto y = value_of(row, "a")) recorded.push_back({x, *y});
    if (const auto y = value_of(row, "b")) now.push_back({x, *y});
  }
  if (recorded.size() < 2 || now.size() < 2) return "";
  report::Range x{recorded.front().x, recorded.back().x}, y{recorded.front().y, recorded.front().y};
  for (const auto* side : {&recorded, &now})
    for (const auto& point : *side) {
      x = {std::min(x.low, point.x), std::max(x.high, point.x)};
      y = {std::min(y.low, point.y), std::max(y.high, point.y)};
    }
  const double margin = y.span() > 0 ? 0.05 * y.span() : std::max(1e-9, 0.01 * std::abs(y.low));
  report::Plot plot(90, 30, 640, 240, x, {y.low - margin, y.high + margin});
  plot.title(headline(first));
  plot.labels(is_cyclic(first) ? "cycle" : "message", string_at(first, "field"));
  plot.curve(recorded, "fill=\"none\" stroke=\"#2a78d6\" stroke-width=\"3\"");
  plot.curve(now, "fill=\"none\" stroke=\"#d6522a\" stroke-width=\"1.5\"");
  return report::document(760, 330, plot.svg());
}

std::string rows_of(const bus::Json& first) {
  constexpr std::uint64_t shown = 3;
  const auto at = index_of(first);
  std::string html = std::string("<table><tr><th>") + (is_cyclic(first) ? "cycle" : "message") +
                     "</th><th>recorded</th><th>written now</th></tr>";
  for (const auto& row : first["around"]) {
    if (!row.is_object() || !row.contains("index") || !row["index"].is_number_unsigned()) continue;
    const auto index = row["index"].get<std::uint64_t>();
    if (index + shown < at || index > at + shown) continue;
    const auto cell = [&](const char* side) {
      const auto text = string_at(row, side);
      return "<td>" + (text.empty() ? "-" : escaped(text)) + "</td>";
    };
    html += std::string(index == at ? "<tr class=\"first\">" : "<tr>") + "<td>" + std::to_string(index) +
            "</td>" + cell("a") + cell("b") + "</tr>";
  }
  return html + "</table>";
}

std::string suite_name(const std::string& recording) {
  const std::filesystem::path path(recording);
  const auto machine = path.parent_path().parent_path().filename().string();
  return path.parent_path().filename() == "recordings" && !machine.empty()
             ? machine + "/" + path.stem().string()
             : path.stem().string();
}

std::string verdict(const SuiteResult& result) {
  if (result.passed) return "passed\">as recorded";
  return result.skipped ? "skipped\">skipped: " + escaped(result.problem)
                        : "failed\">" + escaped(result.problem);
}

std::string outcome_of(const std::vector<SuiteResult>& results) {
  const auto failures = std::ranges::count_if(results, &SuiteResult::failed);
  const auto skipped = std::ranges::count(results, true, &SuiteResult::skipped);
  const auto counted = skipped == 0 ? "" : ", " + std::to_string(skipped) + " skipped";
  if (is_passed(results)) return "<span class=\"passed\">all as recorded</span>" + counted;
  if (failures == 0) return "<span class=\"failed\">nothing is verified</span>" + counted;
  return "<span class=\"failed\">" + std::to_string(failures) + " not as recorded</span>" + counted;
}

// An attribute, when there is one.
std::string skipped_count(std::span<const SuiteResult> results) {
  const auto skipped = std::ranges::count(results, true, &SuiteResult::skipped);
  return skipped == 0 ? "" : " skipped=\"" + std::to_string(skipped) + "\"";
}

constexpr const char* style =
    "body{font:15px/1.5 system-ui,sans-serif;margin:32px auto;max-width:900px;padding:0 16px;color:#1b2530}"
    "table{border-collapse:collapse;margin:12px 0}td,th{padding:4px 12px;border-bottom:1px solid "
    "#d5dbe1;text-align:left}"
    "td{font-variant-numeric:tabular-nums}tr.first "
    "td{background:#fdeee8}.passed{color:#17743a}.failed{color:#b3261e;"
    "font-weight:600}svg{max-width:100%;height:auto}.key "
    "i{display:inline-block;width:24px;height:3px;margin:0 6px 3px 16px}";

}  // namespace

bool is_passed(const std::vector<SuiteResult>& results) {
  return std::ranges::none_of(results, &SuiteResult::failed) &&
         std::ranges::any_of(results, &SuiteResult::passed);
}

void judge(SuiteResult& result, int status, const std::string& output, const std::string& last_words) {
  result.report = bus::Json::parse(output, nullptr, false);
  if (result.report.is_discarded()) result.report = nullptr;
  result.passed = status == 0 && result.report.is_object();
  if (result.passed) return;
  if (!result.report.is_object()) {
    result.problem = last_words.empty() ? "the verification ended without an answer" : last_words;
    return;
  }
  result.problem = string_at(result.report, "skipped");
  result.skipped = !result.problem.empty();
  if (result.skipped) return;
  result.problem = string_at(result.report, "problem");
  if (result.problem.empty()) result.problem = string_at(result.report, "error");
  if (const auto* first = first_of(result); first != nullptr)
    result.problem += (result.problem.empty() ? "" : "; ") + ("first difference: " + headline(*first));
  std::string missing;
  if (result.report.contains("missing") && result.report["missing"].is_array())
    for (const auto& name : result.report["missing"])
      if (name.is_string()) missing += (missing.empty() ? "" : ", ") + name.get<std::string>();
  if (!missing.empty())
    result.problem +=
        (result.problem.empty() ? "" : "; ") + ("required, and not in the recording: " + missing);
  if (result.problem.empty()) result.problem = "not as recorded";
}

std::string junit_of(const std::string& title, const std::vector<SuiteResult>& results) {
  const auto failures = std::ranges::count_if(results, &SuiteResult::failed);
  std::string xml = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites name=\"" + escaped(title) +
                    "\" tests=\"" + std::to_string(results.size()) + "\" failures=\"" +
                    std::to_string(failures) + "\"" + skipped_count(results) + ">\n";
  for (std::size_t begin = 0; begin < results.size();) {
    std::size_t end = begin;
    double seconds = 0;
    std::size_t failed = 0;
    for (; end < results.size() && results[end].recording == results[begin].recording; ++end)
      seconds += results[end].seconds, failed += results[end].failed() ? 1 : 0;
    const auto name = escaped(suite_name(results[begin].recording));
    xml += "  <testsuite name=\"" + name + "\" tests=\"" + std::to_string(end - begin) + "\" failures=\"" +
           std::to_string(failed) + "\"" + skipped_count(std::span(results).subspan(begin, end - begin)) +
           " time=\"" + seconds_text(seconds) + "\">\n";
    for (; begin < end; ++begin) {
      const auto& result = results[begin];
      xml += "    <testcase classname=\"" + name + "\" name=\"" + escaped(result.name) + "\" time=\"" +
             seconds_text(result.seconds) + "\"";
      xml += result.passed ? "/>\n"
                           : std::string(">\n      <") + (result.skipped ? "skipped" : "failure") +
                                 " message=\"" + escaped(result.problem) + "\"/>\n    </testcase>\n";
    }
    xml += "  </testsuite>\n";
  }
  return xml + "</testsuites>\n";
}

std::string html_of(const std::string& title, const std::vector<SuiteResult>& results) {
  std::string html =
      "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>" + escaped(title) +
      "</title><style>" + style + "</style></head><body>\n<h1>" + escaped(title) + "</h1>\n<p>" +
      std::to_string(results.size()) + " verifications, " + outcome_of(results) +
      "</p>\n<table><tr><th>recording</th><th>service</th><th>result</th><th>time s</th></tr>\n";
  for (const auto& result : results) {
    html += "<tr><td>" + escaped(suite_name(result.recording)) + "</td><td>" + escaped(result.name) +
            "</td><td class=\"" + verdict(result) + "</td><td>" + seconds_text(result.seconds) +
            "</td></tr>\n";
  }
  html += "</table>\n";
  for (const auto& result : results) {
    const auto* first = result.passed ? nullptr : first_of(result);
    if (first == nullptr) continue;
    html += "<h2>" + escaped(suite_name(result.recording)) + ": " + escaped(result.name) + "</h2>\n<p>" +
            escaped(headline(*first)) + "</p>\n";
    if (const auto plot = plot_of(*first); !plot.empty())
      html +=
          "<p class=\"key\"><i style=\"background:#2a78d6\"></i>recorded<i "
          "style=\"background:#d6522a\"></i>written "
          "now</p>\n" +
          plot;
    html += rows_of(*first) + "\n";
  }
  return html + "</body></html>\n";
}

}  // namespace trunnion::verification
