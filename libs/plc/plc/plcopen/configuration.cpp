// SPDX-License-Identifier: Apache-2.0
#include "plc/plcopen/configuration.hpp"

#include <optional>

#include "plc/plcopen/declarations.hpp"

namespace trunnion::st::plcopen {
namespace {

// A duration of XML Schema, PT0.01S, as one of Structured Text; other texts as they are.
std::string interval_text(const std::string& text) {
  if (!text.starts_with("PT")) return text;
  std::string result = "T#";
  for (std::size_t i = 2; i < text.size(); ++i) {
    const char c = text[i];
    result += c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  }
  return result;
}

class Words {
 public:
  Words(Document& document, Node configuration) : document_(document), configuration_(configuration) {}

  Tokens run() {
    globals(configuration_);
    const auto resources = children(configuration_, "resource");
    for (const auto resource : resources) globals(resource);
    bool any = false;
    for (const auto resource : resources)
      any = any || child(resource, "pouInstance") || task_with_instance(resource);
    const auto name = any ? document_.name(configuration_, "name") : std::nullopt;
    if (!name) return std::move(words_);
    write("CONFIGURATION", configuration_), append(words_, *name);
    for (const auto resource : resources) {
      const auto resource_name = document_.name(resource, "name");
      if (!resource_name) continue;
      write("RESOURCE", resource), append(words_, *resource_name), write("ON PLC", resource);
      for (const auto task : children(resource, "task")) this->task(task);
      for (const auto task : children(resource, "task")) instances(task, attribute(task, "name"));
      instances(resource, "");
      write("END_RESOURCE", resource);
    }
    write("END_CONFIGURATION", configuration_);
    return std::move(words_);
  }

 private:
  static bool task_with_instance(Node resource) {
    for (const auto task : children(resource, "task"))
      if (child(task, "pouInstance")) return true;
    return false;
  }
  void write(const std::string& text, Node node) { append(words_, document_.words(text, node)); }

  void globals(Node holder) {
    for (const auto list : children(holder, "globalVars")) append(words_, variable_list(document_, list));
    if (const auto access = child(holder, "accessVars"); access && child(access, "accessVariable"))
      document_.error(access, "accessVars are not available: others read and write variables by their path");
    if (const auto config = child(holder, "configVars"); config && child(config, "configVariable"))
      document_.error(config, "configVars are not available: give the variable its address in the POU");
  }

  void task(Node node) {
    auto name = document_.name(node, "name");
    if (!name) return;
    if (!attribute(node, "single").empty())
      document_.error(node,
                      "a task begins by its interval; instead of single test for the edge in the program");
    write("TASK", node), append(words_, std::move(*name)), write("(", node);
    bool first = true;
    if (!attribute(node, "interval").empty()) {
      write("INTERVAL := " + interval_text(attribute(node, "interval")), node);
      first = false;
    }
    if (!attribute(node, "priority").empty())
      write(std::string(first ? "" : ", ") + "PRIORITY := " + attribute(node, "priority"), node);
    write(");", node);
  }

  void instances(Node holder, const std::string& task) {
    for (const auto node : children(holder, "pouInstance")) {
      auto name = document_.name(node, "name"), type = document_.name(node, "typeName");
      if (!name || !type) continue;
      write("PROGRAM", node), append(words_, std::move(*name));
      if (!task.empty()) write("WITH " + task, node);
      write(":", node), append(words_, std::move(*type)), write(";", node);
    }
  }

  Document& document_;
  Node configuration_;
  Tokens words_;
};

}  // namespace

Tokens configuration_words(Document& document, Node configuration) {
  return Words(document, configuration).run();
}

}  // namespace trunnion::st::plcopen
