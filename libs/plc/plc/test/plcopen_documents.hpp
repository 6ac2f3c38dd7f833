// SPDX-License-Identifier: Apache-2.0
// PLCopen XML documents for tests.
#pragma once

#include <string>
#include <vector>

namespace trunnion::st {

inline std::string project(const std::string& pous, const std::string& types = "",
                           const std::string& instances = "") {
  return "<?xml version=\"1.0\" encoding=\"utf-8\"?>\n<project "
         "xmlns=\"http://www.plcopen.org/xml/tc6_0201\">\n"
         "<types>\n<dataTypes>" +
         types + "</dataTypes>\n<pous>\n" + pous + "</pous>\n</types>\n<instances><configurations>" +
         instances + "</configurations></instances>\n</project>\n";
}

/// <localVars>: "a BOOL" and so on; a type of the program begins with a small letter: "t ton" is derived.
inline std::string variables(const std::string& list,
                             const std::vector<std::pair<std::string, std::string>>& all) {
  std::string text = "<" + list + ">";
  for (const auto& [name, type] : all)
    text += "<variable name=\"" + name + "\"><type>" + type + "</type></variable>";
  return text + "</" + list + ">\n";
}

inline std::string derived(const std::string& name) { return "<derived name=\"" + name + "\"/>"; }

inline std::string pou(const std::string& name, const std::string& kind, const std::string& interface,
                       const std::string& body) {
  return "<pou name=\"" + name + "\" pouType=\"" + kind + "\">\n<interface>" + interface +
         "</interface>\n<body>" + body + "</body>\n</pou>\n";
}

/// Elements of a diagram, with their localId.
class DiagramText {
 public:
  /// Elements are placed at x = localId, y.
  double y = 0;

  using Ids = std::vector<int>;
  /// "7" or "7.Q": the output of a block.
  using Sources = std::vector<std::string>;

  static std::string point(const Sources& from) {
    std::string text = "<connectionPointIn>";
    for (const auto& source : from) {
      const auto dot = source.find('.');
      text += "<connection refLocalId=\"" + source.substr(0, dot) + "\"";
      if (dot != std::string::npos) text += " formalParameter=\"" + source.substr(dot + 1) + "\"";
      text += "/>";
    }
    return text + "</connectionPointIn>";
  }
  /// Its localId.
  std::string add(const std::string& kind, const std::string& attributes, const Sources& from,
                  const std::string& inside) {
    const auto id = std::to_string(next_++);
    text_ += "<" + kind + " localId=\"" + id + "\" " + attributes + "><position x=\"" + id + "\" y=\"" +
             std::to_string(y) + "\"/>" + (from.empty() ? "" : point(from)) + inside + "</" + kind + ">\n";
    return id;
  }
  std::string rail() { return add("leftPowerRail", "", {}, "<connectionPointOut formalParameter=\"\"/>"); }
  std::string contact(const std::string& variable, const Sources& from, const std::string& attributes = "") {
    return add("contact", attributes, from, "<connectionPointOut/><variable>" + variable + "</variable>");
  }
  std::string coil(const std::string& variable, const Sources& from, const std::string& attributes = "") {
    return add("coil", attributes, from, "<connectionPointOut/><variable>" + variable + "</variable>");
  }
  std::string in(const std::string& expression, const std::string& attributes = "") {
    return add("inVariable", attributes, {},
               "<connectionPointOut/><expression>" + expression + "</expression>");
  }
  std::string out(const std::string& expression, const Sources& from, const std::string& attributes = "") {
    return add("outVariable", attributes, from, "<expression>" + expression + "</expression>");
  }
  /// inputs: formal parameter and source, "!IN" negated.
  std::string block(const std::string& type, const std::string& instance,
                    const std::vector<std::pair<std::string, Sources>>& inputs,
                    const std::vector<std::string>& outputs, const std::string& attributes = "") {
    std::string inside = "<inputVariables>";
    for (const auto& [name, from] : inputs) {
      const bool negated = name[0] == '!';
      inside += "<variable formalParameter=\"" + name.substr(negated ? 1 : 0) + "\"" +
                (negated ? " negated=\"true\"" : "") + ">" + point(from) + "</variable>";
    }
    inside += "</inputVariables><inOutVariables/><outputVariables>";
    for (const auto& name : outputs)
      inside += "<variable formalParameter=\"" + name + "\"><connectionPointOut/></variable>";
    inside += "</outputVariables>";
    return add("block",
               "typeName=\"" + type + "\"" + (instance.empty() ? "" : " instanceName=\"" + instance + "\"") +
                   " " + attributes,
               {}, inside);
  }
  std::string ladder() const { return "<LD>\n" + text_ + "</LD>"; }
  std::string blocks() const { return "<FBD>\n" + text_ + "</FBD>"; }

 private:
  int next_ = 1;
  std::string text_;
};

}  // namespace trunnion::st
