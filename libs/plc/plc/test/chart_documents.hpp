// SPDX-License-Identifier: Apache-2.0
// Sequential function charts for tests.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "checked_compilation.hpp"
#include "plc/library/register_names.hpp"
#include "plc/tools/source_run.hpp"
#include "plcopen_documents.hpp"

namespace trunnion::st {

inline constexpr std::int64_t chart_period = 10;  // ms between two scans

/// Elements of a chart; ids are given by the test.
struct ChartText {
  static std::string point(const std::vector<int>& from) {
    std::string text;
    for (const int id : from)
      text +=
          "<connectionPointIn><connection refLocalId=\"" + std::to_string(id) + "\"/></connectionPointIn>";
    return text;
  }
  void add(const std::string& kind, int id, const std::string& attributes, const std::vector<int>& from,
           const std::string& inside = "", double x = 0) {
    text += "<" + kind + " localId=\"" + std::to_string(id) + "\" " + attributes + "><position x=\"" +
            std::to_string(x) + "\" y=\"0\"/>" + point(from) + inside + "</" + kind + ">\n";
  }
  void step(int id, const std::string& name, const std::vector<int>& from, bool initial = false) {
    add("step", id, "name=\"" + name + "\"" + (initial ? " initialStep=\"true\"" : ""), from);
  }
  static std::string st(const std::string& code) {
    return "<ST><xhtml xmlns=\"http://www.w3.org/1999/xhtml\"><![CDATA[" + code + "]]></xhtml></ST>";
  }
  void transition(int id, const std::string& condition, const std::vector<int>& from,
                  const std::string& attributes = "", double x = 0) {
    add("transition", id, attributes, from,
        "<condition><inline name=\"\">" + st(condition) + "</inline></condition>", x);
  }
  void action(int id, int step, const std::string& actions) {
    text +=
        "<actionBlock localId=\"" + std::to_string(id) + "\">" + point({step}) + actions + "</actionBlock>\n";
  }
  static std::string named(const std::string& qualifier, const std::string& name,
                           const std::string& duration = "") {
    return "<action qualifier=\"" + qualifier + "\"" +
           (duration.empty() ? "" : " duration=\"" + duration + "\"") + "><reference name=\"" + name +
           "\"/></action>";
  }
  std::string body() const { return "<SFC>\n" + text + "</SFC>"; }

  std::string text;
};

inline std::string program(const ChartText& chart,
                           const std::vector<std::pair<std::string, std::string>>& list,
                           const std::string& parts = "") {
  return project("<pou name=\"main\" pouType=\"program\">\n<interface>" + variables("localVars", list) +
                 "</interface>\n" + parts + "<body>" + chart.body() + "</body>\n</pou>\n");
}

inline std::string actions(const std::vector<std::pair<std::string, std::string>>& list) {
  std::string text = "<actions>";
  for (const auto& [name, code] : list)
    text += "<action name=\"" + name + "\"><body>" + ChartText::st(code) + "</body></action>";
  return text + "</actions>";
}

class LoadedChart {
 public:
  explicit LoadedChart(const std::string& xml)
      : compilation(compile({{"chart.xml", xml}}, interface_registers())), run(checked(compilation)) {}
  void scan(int times = 1) {
    for (int i = 0; i < times; ++i) {
      const auto fault = run.scan("", chart_period * 1000000);
      EXPECT_EQ(fault.kind, FaultKind::none) << fault_line(compilation, run.machine(), fault);
    }
  }
  bool is(const std::string& path) { return run.get(path) == "TRUE"; }
  std::string get(const std::string& path) { return run.get(path); }
  void set(const std::string& path, bool value) { run.set(path, value ? "TRUE" : "FALSE"); }
  /// The names of the active steps of `all`.
  std::string active(const std::vector<std::string>& all) {
    std::string text;
    for (const auto& name : all)
      if (is(name + ".X")) text += (text.empty() ? "" : " ") + name;
    return text;
  }

  Compilation compilation;
  SourceRun run;
};

}  // namespace trunnion::st
