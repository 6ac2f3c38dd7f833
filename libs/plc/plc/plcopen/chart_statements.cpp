// SPDX-License-Identifier: Apache-2.0
#include "plc/plcopen/chart_statements.hpp"

#include <algorithm>

#include "plc/syntax/parser.hpp"

namespace trunnion::st::plcopen {
namespace {

/// An action with all of its associations.
struct Action {
  std::string name;
  Node node;
  std::vector<const ChartAssociation*> associations;
  bool is_variable = false;  ///< a BOOL variable, which shows whether it is active
  Tokens body;
};

class ChartWriter {
 public:
  ChartWriter(Document& document, const Chart& chart, const ChartParts& parts, std::set<std::string>& names,
              const std::function<Tokens(Node)>& statements)
      : document_(document), chart_(chart), parts_(parts), names_(names), body_statements_(statements) {}

  ChartBody run() {
    steps();
    for (auto& action : actions()) control(action);
    append(statements_, std::move(executions_));
    transitions();
    return {std::move(declarations_), std::move(statements_)};
  }

 private:
  Tokens words(const std::string& text, Node node) { return document_.words(text, node); }
  void write(const std::string& text, Node node) { append(statements_, words(text, node)); }
  Tokens own(const std::string& text, TokenKind kind, Node node) const {
    return {{kind, text, text, 10, document_.at(node)}};
  }
  /// Declares a variable of the chart and gives its name, which no variable of the POU has.
  std::string declare(std::string name, const std::string& type, Node node) {
    while (!names_.insert(upper_case(name)).second) name += "_";
    append(declarations_, words("VAR " + name + " : " + type + "; END_VAR", node));
    return name;
  }
  const std::string& step(std::size_t i) const { return chart_.steps[i].name; }

  void steps() {
    for (const auto& one : chart_.steps)
      append(declarations_,
             words("VAR " + one.name + " : SFC_STEP" + (one.initial ? " := (X := TRUE)" : "") + "; END_VAR",
                   one.node));
    for (const auto& one : chart_.steps) names_.insert(upper_case(one.name));
    const auto first = chart_.steps.front().node;
    const auto runs = declare("chart_runs", "BOOL", first);
    write("IF NOT " + runs + " THEN " + runs + " := TRUE;", first);
    for (const auto& one : chart_.steps)
      if (one.initial) write(one.name + ".START := PLC_TIME();", one.node);
    write("END_IF;", first);
    for (const auto& one : chart_.steps)
      write("IF " + one.name + ".X THEN " + one.name + ".T := LTIME_TO_TIME(PLC_TIME() - " + one.name +
                ".START); END_IF;",
            one.node);
  }

  std::vector<Action> actions() {
    std::vector<Action> all;
    std::map<std::string, std::size_t> known;
    std::size_t inlined = 0;
    for (const auto& one : chart_.associations) {
      if (one.action.empty()) {
        all.push_back(
            {"action_" + std::to_string(++inlined), one.node, {&one}, false, body_statements_(one.body)});
        continue;
      }
      const auto upper = upper_case(one.action);
      const auto [at, is_new] = known.emplace(upper, all.size());
      if (is_new) {
        const auto body = parts_.actions.find(upper);
        const bool is_variable = body == parts_.actions.end();
        all.push_back({one.action, one.node, {}, is_variable, is_variable ? Tokens() : body->second});
      }
      all[at->second].associations.push_back(&one);
    }
    for (const auto& action : all)
      for (const auto& token : action.body)
        if (token.upper == "RETURN" && token.kind != TokenKind::string)
          document_.diagnostics().error(token.at, "RETURN is not available in an action of a chart");
    return all;
  }

  /// The steps of these qualifiers, as a condition; empty without one.
  std::string active(const Action& action, const std::string& qualifier) const {
    std::string text;
    for (const auto* one : action.associations)
      if (one->qualifier == qualifier) text += (text.empty() ? "(" : " OR ") + step(one->step) + ".X";
    return text.empty() ? text : text + ")";
  }

  /// The action control block of the standard (6.7.4.6), with what this action needs of it.
  void control(Action& action) {
    const auto node = action.node;
    const auto reset = active(action, "R");
    std::vector<std::string> terms;
    const auto latch = [&](const std::string& name, const std::string& when) {
      auto stored = declare(action.name + name, "BOOL", node);
      write("IF " + when + " THEN " + stored + " := TRUE; END_IF;", node);
      if (!reset.empty()) write("IF " + reset + " THEN " + stored + " := FALSE; END_IF;", node);
      return stored;
    };
    const auto edge = [&](const std::string& name, const char* type, const std::string& when) {
      auto detection = declare(action.name + name, type, node);
      write(detection + "(CLK := " + when + ");", node);
      return detection + ".Q";
    };
    if (const auto when = active(action, "N"); !when.empty()) terms.push_back(when);
    if (const auto when = active(action, "S"); !when.empty()) terms.push_back(latch("_stored", when));
    if (const auto when = active(action, "P"); !when.empty()) terms.push_back(edge("_pulse", "R_TRIG", when));
    timed(action, latch, terms);
    std::vector<std::string> pulses;
    if (const auto when = active(action, "P1"); !when.empty())
      pulses.push_back(edge("_entry", "R_TRIG", when));
    if (const auto when = active(action, "P0"); !when.empty())
      pulses.push_back(edge("_exit", "FALLING_EDGE", when));

    const auto is_active = declare(action.name + "_active", "BOOL", node);
    const auto any = [](const std::vector<std::string>& list, std::string text) {
      for (const auto& one : list) text += (text.empty() ? "" : " OR ") + one;
      return text;
    };
    // After Q has fallen the action is executed once more; for P0 and P1 it is not.
    const auto runs = own("@runs " + action.name, TokenKind::identifier, node);
    append(statements_, own("@define", TokenKind::symbol, node));
    append(statements_, runs);
    write(" := " + any(pulses, action.is_variable ? "FALSE" : is_active) + ";", node);
    write(is_active + " := " + (reset.empty() ? "" : "NOT " + reset + " AND ") + "(" +
              any(terms, terms.empty() ? "FALSE" : "") + ");",
          node);
    if (action.is_variable) {
      append(executions_, words(action.name + " := " + is_active + " OR ", node));
      append(executions_, runs);
      append(executions_, words(";", node));
    } else if (!action.body.empty()) {
      append(executions_, words("IF " + is_active + " OR ", node));
      append(executions_, runs);
      append(executions_, words("THEN", node));
      append(executions_, std::move(action.body));
      append(executions_, words("; END_IF;", node));
    }
  }

  template <class Latch>
  void timed(const Action& action, Latch latch, std::vector<std::string>& terms) {
    const ChartAssociation* found = nullptr;
    for (const auto* one : action.associations) {
      if (!one->duration) continue;
      if (found != nullptr)
        document_.error(one->node, "the action '" + action.name +
                                       "' has two qualifiers with a duration; an action can have one");
      found = one;
    }
    if (found == nullptr) return;
    const auto node = found->node;
    const auto& kind = found->qualifier;
    const auto when = step(found->step) + ".X";
    const auto timer = declare(action.name + "_timer", "TON", node);
    const bool latches = kind == "SD" || kind == "SL";
    const auto input = latches ? latch("_latched", when) : when;
    write(timer + "(IN := " + input + ", PT := ", node);
    append(statements_, *found->duration);
    write(");", node);
    if (kind == "DS")
      terms.push_back(latch("_latched", timer + ".Q"));
    else if (kind == "L" || kind == "SL")
      terms.push_back("(" + input + " AND NOT " + timer + ".Q)");
    else
      terms.push_back(timer + ".Q");
  }

  std::optional<ChartCondition> condition(const ChartTransition& transition) {
    const auto holder = child(transition.node, "condition");
    if (const auto reference = child(holder, "reference")) {
      const auto found = parts_.transitions.find(upper_case(attribute(reference, "name")));
      if (found != parts_.transitions.end()) return found->second;
      if (auto variable = document_.name(reference, "name")) return ChartCondition{{}, std::move(*variable)};
      return std::nullopt;
    }
    if (const auto written = child(holder, "inline"))
      return chart_condition(document_, written, attribute(written, "name"), names_, body_statements_,
                             declarations_);
    document_.error(transition.node, "the transition has no condition: a reference, or a body");
    return std::nullopt;
  }

  void transitions() {
    std::vector<Tokens> taken;
    for (const auto& one : chart_.transitions) {
      auto when = condition(one);
      if (!when) when = ChartCondition{{}, words("FALSE", one.node)};
      const auto others = taken.size();
      std::string enabled;
      for (const auto i : one.before) enabled += (enabled.empty() ? "" : " AND ") + step(i) + ".X";
      const auto not_others = [&] {
        for (std::size_t i = 0; i < others; ++i) {
          const auto& other = chart_.transitions[i].before;
          if (std::none_of(one.before.begin(), one.before.end(), [&](std::size_t step) {
                return std::find(other.begin(), other.end(), step) != other.end();
              }))
            continue;
          write("NOT", one.node);
          append(statements_, taken[i]);
          write("AND", one.node);
        }
      };
      if (!when->statements.empty()) {
        append(statements_, when->value);
        write(":= FALSE; IF", one.node);
        not_others();
        write(enabled + " THEN", one.node);
        append(statements_, std::move(when->statements));
        write("; END_IF;", one.node);
      }
      taken.push_back(own("@transition " + std::to_string(one.number), TokenKind::identifier, one.node));
      append(statements_, own("@define", TokenKind::symbol, one.node));
      append(statements_, taken.back());
      write(":=", one.node);
      not_others();
      write("(", one.node);
      append(statements_, std::move(when->value));
      write(")", one.node);
      append(statements_, own("@when", TokenKind::symbol, one.node));
      write(enabled + ";", one.node);
    }
    // A step that is left and entered at once stays active.
    const auto each = [&](auto steps_of, const std::function<std::string(const std::string&)>& text) {
      for (std::size_t t = 0; t < taken.size(); ++t) {
        const auto& one = chart_.transitions[t];
        write("IF", one.node);
        append(statements_, taken[t]);
        write("THEN", one.node);
        for (const auto i : steps_of(one)) write(text(step(i)), one.node);
        write("END_IF;", one.node);
      }
    };
    each([](const ChartTransition& t) { return t.before; },
         [](const std::string& name) { return name + ".X := FALSE;"; });
    each([](const ChartTransition& t) { return t.after; },
         [](const std::string& name) {
           return name + ".X := TRUE; " + name + ".T := T#0s; " + name + ".START := PLC_TIME();";
         });
  }

  Document& document_;
  const Chart& chart_;
  const ChartParts& parts_;
  std::set<std::string>& names_;
  const std::function<Tokens(Node)>& body_statements_;
  Tokens declarations_, statements_, executions_;
};

}  // namespace

ChartBody chart_body(Document& document, const Chart& chart, const ChartParts& parts,
                     std::set<std::string>& names, const std::function<Tokens(Node)>& statements) {
  return ChartWriter(document, chart, parts, names, statements).run();
}

std::optional<ChartCondition> chart_condition(Document& document, Node body, const std::string& name,
                                              std::set<std::string>& names,
                                              const std::function<Tokens(Node)>& statements,
                                              Tokens& declarations) {
  if (const auto text = child(body, "ST")) {
    auto tokens = document.content(text);
    if (!tokens.empty() && tokens.front().text == ":=") tokens.erase(tokens.begin());
    if (!tokens.empty() && tokens.back().text == ";") tokens.pop_back();
    if (!is_expression(tokens, document.at(body), document.diagnostics())) return std::nullopt;
    return ChartCondition{{}, std::move(tokens)};
  }
  if (children(body).empty()) {
    document.error(body, "the transition has no condition: a body in ST, LD, FBD or IL");
    return std::nullopt;
  }
  const auto before = document.diagnostics().errors();
  ChartCondition condition{statements(body), {}};
  if (document.diagnostics().errors() > before) return std::nullopt;
  auto result = (name.empty() ? std::string("transition") : name) + "_condition";
  while (!names.insert(upper_case(result)).second) result += "_";
  append(declarations, document.words("VAR " + result + " : BOOL; END_VAR", body));
  condition.value = document.words(result, body);
  bool found = false;
  const auto wanted = upper_case(name);
  for (std::size_t i = 0; i < condition.statements.size(); ++i) {
    auto& token = condition.statements[i];
    const bool is_part = i > 0 && condition.statements[i - 1].text == ".";
    if (wanted.empty() || token.kind != TokenKind::identifier || token.upper != wanted || is_part) continue;
    token.text = result;
    token.upper = upper_case(result);
    found = true;
  }
  if (found) return condition;
  document.error(body, name.empty()
                           ? "the condition needs a name, to which its coil or output variable writes"
                           : "nothing in the condition writes to '" + name + "', the name of the transition");
  return std::nullopt;
}

}  // namespace trunnion::st::plcopen
