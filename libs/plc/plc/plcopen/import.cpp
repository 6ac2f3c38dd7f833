// SPDX-License-Identifier: Apache-2.0
#include "plc/plcopen/import.hpp"

#include <set>

#include "plc/instruction_list/list.hpp"
#include "plc/plcopen/chart_statements.hpp"
#include "plc/plcopen/configuration.hpp"
#include "plc/plcopen/declarations.hpp"
#include "plc/plcopen/diagram_statements.hpp"
#include "plc/syntax/parser.hpp"

namespace trunnion::st::plcopen {
namespace {

struct PouWord {
  std::string_view type;
  const char *begin, *end;
};
constexpr PouWord pou_words[] = {{"program", "PROGRAM", "END_PROGRAM"},
                                 {"function", "FUNCTION", "END_FUNCTION"},
                                 {"functionBlock", "FUNCTION_BLOCK", "END_FUNCTION_BLOCK"}};

class Import {
 public:
  Import(Document& document, std::vector<ElementPlace>& places) : document_(document), places_(places) {}

  Tokens run() {
    const auto root = document_.root();
    if (local_name(root) != "project") {
      document_.error(root, "expected the element project of PLCopen XML (TC6 2.01)");
      return {};
    }
    const auto types = child(root, "types");
    append(words_, data_types(document_, child(types, "dataTypes")));
    for (const auto one : children(child(types, "pous"), "pou")) pou(one);
    place(child(root, "instances"), "");
    for (const auto one : children(child(child(root, "instances"), "configurations"), "configuration"))
      append(words_, configuration_words(document_, one));
    return std::move(words_);
  }

 private:
  void place(Node node, std::string text) { places_.push_back({document_.at(node), std::move(text)}); }
  void write(const std::string& text, Node node) { append(words_, document_.words(text, node)); }

  void pou(Node node) {
    const auto name = document_.name(node, "name");
    const auto type = attribute(node, "pouType");
    const PouWord* kind = nullptr;
    for (const auto& word : pou_words)
      if (word.type == type) kind = &word;
    if (kind == nullptr)
      document_.error(node, "the pouType is program, function or functionBlock, not '" + type + "'");
    if (!name || kind == nullptr) return;
    pou_ = "POU '" + (*name)[0].text + "'";
    place(node, pou_);
    write(kind->begin, node);
    append(words_, *name);
    const auto interface = child(node, "interface");
    if (const auto result = child(interface, "returnType"))
      if (auto words = type_words(document_, result)) {
        write(":", result);
        append(words_, std::move(*words));
      }
    names_.clear();
    for (const auto list : children(interface)) {
      const auto part = local_name(list);
      if (part == "returnType" || part == "documentation" || part == "addData") continue;
      append(words_, variable_list(document_, list));
      for (const auto variable : children(list, "variable"))
        names_.insert(upper_case(attribute(variable, "name")));
    }
    for (const auto body : children(node, "body")) {
      auto result = read_body(node, body);
      append(words_, std::move(result.declarations));
      append(words_, std::move(result.statements));
    }
    if (!child(node, "body")) document_.error(node, "the POU has no body");
    write(kind->end, node);
  }

  struct Body {
    Tokens declarations, statements;
  };
  /// `pou`: whose actions and transitions a chart refers to; none: no chart is allowed.
  Body read_body(Node pou, Node body) {
    Body all;
    for (const auto language : children(body)) {
      const auto name = local_name(language);
      if (name == "ST") {
        append(all.statements, document_.content(language));
      } else if (name == "IL") {
        append(all.statements,
               InstructionList(document_.content(language), document_.file(), document_.diagnostics()).run());
      } else if (name == "SFC" && pou) {
        chart(pou, language, all);
      } else if (name == "LD" || name == "FBD") {
        const auto before = document_.diagnostics().errors();
        const auto diagram = read_diagram(document_, language);
        for (const auto& element : diagram.elements)
          place(element.node, pou_ + ", network " + std::to_string(element.network + 1) + ", " +
                                  Diagram::described(element));
        if (document_.diagnostics().errors() > before) continue;
        auto result = diagram_body(document_, diagram, names_);
        for (const auto& token : result.declarations) names_.insert(token.upper);
        append(all.declarations, std::move(result.declarations));
        append(all.statements, std::move(result.statements));
      } else if (name != "documentation" && name != "addData") {
        document_.error(language, "a body in '" + std::string(name) + "' is not available: LD, FBD, ST, IL" +
                                      (pou ? " and SFC are" : " are"));
      }
    }
    return all;
  }

  void chart(Node pou, Node language, Body& all) {
    const auto before = document_.diagnostics().errors();
    const auto found = read_chart(document_, language);
    for (const auto node : children(language)) {
      const auto name = attribute(node, "name");
      place(node, pou_ + ", " + std::string(local_name(node)) +
                      (local_name(node) == "step" ? " '" + name + "'"
                                                  : " with localId " + attribute(node, "localId")));
    }
    if (document_.diagnostics().errors() > before) return;
    const auto statements = [&](Node body) {
      auto result = read_body({}, body);
      append(all.declarations, std::move(result.declarations));
      return std::move(result.statements);
    };
    ChartParts parts;
    for (const auto action : children(child(pou, "actions"), "action")) {
      place(action, pou_ + ", action '" + attribute(action, "name") + "'");
      if (document_.name(action, "name"))
        parts.actions[upper_case(attribute(action, "name"))] = statements(child(action, "body"));
    }
    for (const auto transition : children(child(pou, "transitions"), "transition")) {
      place(transition, pou_ + ", transition '" + attribute(transition, "name") + "'");
      if (auto condition =
              chart_condition(document_, child(transition, "body"), attribute(transition, "name"), names_,
                              statements, all.declarations))
        parts.transitions[upper_case(attribute(transition, "name"))] = std::move(*condition);
    }
    if (document_.diagnostics().errors() > before) return;
    auto result = chart_body(document_, found, parts, names_, statements);
    append(all.declarations, std::move(result.declarations));
    append(all.statements, std::move(result.statements));
  }

  Document& document_;
  std::vector<ElementPlace>& places_;
  Tokens words_;
  std::string pou_;
  std::set<std::string> names_;
};

}  // namespace

bool is_plcopen(std::string_view name) { return name.ends_with(".xml"); }

void import_document(std::string_view text, std::uint16_t file, SourceTree& tree, Diagnostics& diagnostics,
                     std::vector<ElementPlace>& places) {
  const auto before = diagnostics.errors();
  Document document(text, file, diagnostics);
  if (!document.root()) return;
  auto words = Import(document, places).run();
  // What is missing would only be reported once more.
  if (diagnostics.errors() > before) return;
  words.push_back({TokenKind::end, "the end of the file", "", 10, {file, 1, 1}});
  parse(std::move(words), tree, diagnostics);
}

}  // namespace trunnion::st::plcopen
