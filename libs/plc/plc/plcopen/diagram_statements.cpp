// SPDX-License-Identifier: Apache-2.0
#include "plc/plcopen/diagram_statements.hpp"

#include <algorithm>
#include <limits>
#include <tuple>

#include "plc/library/functions.hpp"

namespace trunnion::st::plcopen {
namespace {

constexpr int longest_chain = 500;  // elements one behind the other, without one that is computed before

/// Operators that Structured Text writes between their operands.
bool is_operator(const std::string& upper) {
  return upper == "AND" || upper == "OR" || upper == "XOR" || upper == "MOD";
}

class StatementWriter {
  using Kind = Element::Kind;

 public:
  StatementWriter(Document& document, const Diagram& diagram, const std::set<std::string>& names)
      : document_(document), elements_(diagram.elements), networks_(diagram.networks), names_(names) {
    state_.resize(elements_.size(), State::open);
    for (std::size_t i = 0; i < elements_.size(); ++i)
      if (elements_[i].kind == Kind::connector && !connectors_.emplace(elements_[i].name, i).second)
        document_.error(elements_[i].node, "there are two connectors '" + elements_[i].name + "'");
  }

  DiagramBody run() {
    std::vector<std::vector<std::size_t>> sorted(networks_);
    for (std::size_t i = 0; i < elements_.size(); ++i)
      if (acts(elements_[i])) sorted[elements_[i].network].push_back(i);
    for (auto& network : sorted) {
      std::sort(network.begin(), network.end(), [&](std::size_t a, std::size_t b) {
        const auto key = [&](std::size_t i) {
          const auto& e = elements_[i];
          const auto order = e.order > 0 ? e.order : std::numeric_limits<std::uint64_t>::max();
          return std::tuple(e.kind != Kind::label, order, e.y, e.x, i);
        };
        return key(a) < key(b);
      });
      for (const auto i : network) execute(i);
    }
    return {std::move(declarations_), std::move(statements_)};
  }

 private:
  enum class State { open, in_progress, done };

  static bool acts(const Element& e) {
    return e.kind == Kind::coil || e.kind == Kind::block || e.kind == Kind::label || e.kind == Kind::jump ||
           e.kind == Kind::return_ || e.kind == Kind::out_variable ||
           (e.kind == Kind::in_out_variable && !e.inputs.empty());
  }

  Tokens words(const std::string& text, Node node) { return document_.words(text, node); }
  void write(const std::string& text, Node node) { append(statements_, words(text, node)); }
  void write(Tokens tokens) { append(statements_, std::move(tokens)); }
  /// A word that no source can contain: the name of an intermediate value, or a statement of diagrams.
  Tokens own(const std::string& text, TokenKind kind, Node node) const {
    return {{kind, text, text, 10, document_.at(node)}};
  }
  Tokens value_name(const Element& e, const std::string& part = "") const {
    return own("@" + e.id + part, TokenKind::identifier, e.node);
  }
  static Tokens negated(Tokens tokens, bool negates, Node node, Document& document) {
    if (!negates) return tokens;
    auto result = document.words("NOT (", node);
    append(result, std::move(tokens));
    append(result, document.words(")", node));
    return result;
  }
  void define(Tokens name, Tokens value, Node node, const Tokens& when = {}) {
    write(own("@define", TokenKind::symbol, node));
    write(std::move(name));
    write(":=", node);
    write(std::move(value));
    if (!when.empty()) {
      write(own("@when", TokenKind::symbol, node));
      write(when);
    }
    write(";", node);
  }

  /// Q of an edge detection of its own, which is called here.
  Tokens edge(Edge kind, Tokens signal, Node node) {
    auto name = (kind == Edge::rising ? "rising_edge_" : "falling_edge_") + std::to_string(++edges_);
    while (names_.contains(upper_case(name))) name += "_";
    append(declarations_,
           words("VAR " + name + " : " + (kind == Edge::rising ? "R_TRIG" : "FALLING_EDGE") + "; END_VAR",
                 node));
    write(name + "(CLK :=", node);
    write(std::move(signal));
    write(");", node);
    return words(name + ".Q", node);
  }

  // What is executed.

  void execute(std::size_t i) {
    if (state_[i] != State::open) return;
    state_[i] = State::in_progress;
    const auto& e = elements_[i];
    std::set<std::size_t> seen;
    for (const auto* list : {&e.inputs, &e.in_outs})
      for (const auto& input : *list)
        for (const auto& source : input.sources) before(source.element, e, seen);
    switch (e.kind) {
      case Kind::coil:
        coil(e);
        break;
      case Kind::block:
        block(e);
        break;
      case Kind::out_variable:
      case Kind::in_out_variable:
        out_variable(e);
        break;
      case Kind::label:
        write(own("@label", TokenKind::symbol, e.node));
        write(e.name + ";", e.node);
        break;
      case Kind::jump:
      case Kind::return_:
        leave(e);
        break;
      default:
        break;
    }
    state_[i] = State::done;
  }

  /// What `consumer` takes is executed before, through contacts and connectors; not when executionOrderId
  /// says otherwise.
  void before(std::size_t i, const Element& consumer, std::set<std::size_t>& seen, int depth = 0) {
    const auto& e = elements_[i];
    if (!seen.insert(i).second || depth > longest_chain) return;  // a circle is reported where it is read
    if (e.kind == Kind::block || e.kind == Kind::coil) {
      if (e.order > 0 && consumer.order > 0 && e.order > consumer.order) return;
      return execute(i);
    }
    if (e.kind == Kind::continuation) {
      if (const auto found = connectors_.find(e.name); found != connectors_.end())
        before(found->second, consumer, seen, depth + 1);
      return;
    }
    if (defined_.contains(i)) return;
    for (const auto& input : e.inputs)
      for (const auto& source : input.sources) before(source.element, consumer, seen, depth + 1);
  }

  void coil(const Element& e) {
    if (e.inputs.empty() || e.inputs[0].sources.empty())
      return document_.error(e.node, "the coil is not connected");
    auto power = input(e.inputs[0]);
    if (e.consumers > 0) {
      define(value_name(e), std::move(power), e.node);
      power = value_name(e);
    }
    assign(e, e.value, std::move(power), {});
  }

  void assign(const Element& e, const Tokens& target, Tokens value, const Tokens& when) {
    if (e.edge != Edge::none) value = edge(e.edge, std::move(value), e.node);
    value = negated(std::move(value), e.negated, e.node, document_);
    if (!when.empty()) {
      write("IF", e.node);
      write(when);
      write("THEN", e.node);
    }
    if (e.storage != Storage::none) {
      write("IF", e.node);
      write(std::move(value));
      write("THEN", e.node);
      write(target);
      write(e.storage == Storage::set ? ":= TRUE; END_IF;" : ":= FALSE; END_IF;", e.node);
    } else {
      write(target);
      write(":=", e.node);
      write(std::move(value));
      write(";", e.node);
    }
    if (!when.empty()) write("END_IF;", e.node);
  }

  void out_variable(const Element& e) {
    if (e.inputs.empty() || (e.inputs[0].sources.empty() && !e.inputs[0].expression))
      return document_.error(e.node, "the variable is not connected");
    const auto& in = e.inputs[0];
    Tokens when;
    if (in.sources.size() == 1) {
      const auto& source = elements_[in.sources[0].element];
      // Further outputs of a function are assigned by its call.
      if (source.is_function() && is_further_output(source, in.sources[0].output)) return;
      if (enable(source) != nullptr && in.sources[0].output != "ENO") when = value_name(source, ".ENO");
    }
    if (in.sources.size() == 1 && converts(elements_[in.sources[0].element], in.sources[0].output) &&
        e.storage == Storage::none)
      return move_converted(e, input(in), when);
    assign(e, e.value, input(in), when);
  }

  /// The target D of the manuals' ladder, which takes the low bits of the value.
  static bool converts(const Element& e, const std::string& output) {
    return e.is_function() && output == "D" && is_standard_function(upper_case(e.name));
  }

  void move_converted(const Element& e, Tokens value, const Tokens& when) {
    if (!when.empty()) {
      write("IF", e.node);
      write(when);
      write("THEN", e.node);
    }
    write("MOV(", e.node);
    write(std::move(value));
    write(",", e.node);
    write(e.value);
    write(");", e.node);
    if (!when.empty()) write("END_IF;", e.node);
  }

  void leave(const Element& e) {
    if (e.inputs.empty() || e.inputs[0].sources.empty())
      return document_.error(e.node, "the " + std::string(local_name(e.node)) + " is not connected");
    auto power = input(e.inputs[0]);
    write("IF", e.node);
    write(std::move(power));
    write("THEN", e.node);
    if (e.kind == Kind::return_) {
      write("RETURN; END_IF;", e.node);
    } else {
      write(own("@jump", TokenKind::symbol, e.node));
      write(e.name + "; END_IF;", e.node);
    }
  }

  static const Input* enable(const Element& e) {
    if (e.kind != Kind::block) return nullptr;
    for (const auto& input : e.inputs)
      if (upper_case(input.name) == "EN" && (!input.sources.empty() || input.expression)) return &input;
    return nullptr;
  }
  static bool is_disassembly(const Element& e) { return e.is_function() && upper_case(e.name) == "DISAS"; }
  static bool is_further_output(const Element& e, const std::string& output) {
    if (is_disassembly(e) && output == "D") return true;
    if (output.empty() || output == "ENO" || output == "OUT" || output == upper_case(e.name)) return false;
    for (const auto& one : e.outputs)
      if (const auto name = upper_case(one.name); name != "ENO") return name != output;
    return true;
  }

  void block(const Element& e) {
    Tokens when;
    if (const auto* in = enable(e)) {
      define(value_name(e, ".ENO"), input(*in), e.node);
      when = value_name(e, ".ENO");
    }
    auto arguments = this->arguments(e);
    if (!arguments) return;
    if (e.is_function() && !returns_nothing(e)) {
      define(value_name(e), std::move(*arguments), e.node, when);
      return;
    }
    if (!when.empty()) {
      write("IF", e.node);
      write(when);
      write("THEN", e.node);
    }
    write(std::move(*arguments));
    write(";", e.node);
    if (!when.empty()) write("END_IF;", e.node);
  }

  static bool returns_nothing(const Element& e) {
    return is_disassembly(e) || std::all_of(e.outputs.begin(), e.outputs.end(), [](const Output& output) {
             return upper_case(output.name) == "ENO";
           });
  }

  /// The call of the block, or the expression of an operator.
  std::optional<Tokens> arguments(const Element& e) {
    const auto upper = upper_case(e.name);
    const bool infix = e.is_function() && is_operator(upper);
    const bool inverts = e.is_function() && upper == "NOT";
    const bool by_position =
        e.is_function() && !is_disassembly(e) && (infix || inverts || is_standard_function(upper));
    auto result = infix             ? Tokens{}
                  : inverts         ? words("NOT (", e.node)
                  : e.is_function() ? words(e.name + "(", e.node)
                                    : e.instance;
    if (!e.is_function()) append(result, words("(", e.node));
    bool first = true;
    const auto separate = [&](Node node) {
      if (!first) append(result, words(infix ? upper : ",", node));
      first = false;
    };
    for (const auto* list : {&e.inputs, &e.in_outs})
      for (const auto& in : *list) {
        if (upper_case(in.name) == "EN") continue;
        if (in.sources.empty() && !in.expression) {
          if (!by_position) continue;
          document_.error(in.at, "the input '" + in.name + "' is not connected");
          return std::nullopt;
        }
        separate(in.at);
        if (!by_position) append(result, words(in.name + " :=", in.at));
        auto value = input(in);
        if (infix) {
          append(result, words("(", in.at));
          append(value, words(")", in.at));
        }
        append(result, std::move(value));
      }
    if (e.is_function() && !by_position) further_outputs(e, result, separate);
    if (!infix) append(result, words(")", e.node));
    if (infix && first) {
      document_.error(e.node, e.name + " has no inputs");
      return std::nullopt;
    }
    return result;
  }

  template <class Separate>
  void further_outputs(const Element& e, Tokens& result, Separate separate) {
    for (const auto& other : elements_) {
      if (other.kind != Kind::out_variable || other.inputs.empty() || other.inputs[0].sources.size() != 1)
        continue;
      const auto& source = other.inputs[0].sources[0];
      if (&elements_[source.element] != &e || !is_further_output(e, source.output)) continue;
      separate(other.node);
      append(result, words(source.output + " =>", other.node));
      append(result, other.value);
    }
  }

  // What is read.

  Tokens input(const Input& in, int depth = 0) {
    Tokens result;
    if (in.expression) {
      result = *in.expression;
    } else if (in.sources.size() == 1) {
      result = source(in.sources[0], depth);
    } else {
      for (const auto& one : in.sources) {
        append(result, words(result.empty() ? "((" : "OR (", one.at));
        append(result, source(one, depth));
        append(result, words(")", one.at));
      }
      append(result, words(")", in.at));
    }
    if (in.edge != Edge::none) result = edge(in.edge, std::move(result), in.at);
    return negated(std::move(result), in.negated, in.at, document_);
  }

  Tokens source(const Source& from, int depth) {
    const auto& e = elements_[from.element];
    if (depth > longest_chain) {
      document_.error(e.node, "the connections form a circle, or more than " + std::to_string(longest_chain) +
                                  " elements follow each other");
      return words("FALSE", e.node);
    }
    switch (e.kind) {
      case Kind::power_rail:
        return words("TRUE", from.at);
      case Kind::contact:
        return contact(from.element, depth);
      case Kind::coil:
        if (state_[from.element] == State::done) return value_name(e);
        return not_before(e, from.at);
      case Kind::block:
        return output(e, from);
      case Kind::in_variable:
      case Kind::in_out_variable: {
        auto value = e.edge != Edge::none ? edge(e.edge, e.value, e.node) : e.value;
        return negated(std::move(value), e.negated, e.node, document_);
      }
      case Kind::connector:
        return connector(from.element, depth);
      case Kind::continuation: {
        const auto found = connectors_.find(e.name);
        if (found != connectors_.end()) return source({found->second, "", from.at}, depth + 1);
        document_.error(e.node, "there is no connector '" + e.name + "' in this body");
        return words("FALSE", e.node);
      }
      default:
        document_.error(from.at, "a " + std::string(local_name(e.node)) + " has no output");
        return words("FALSE", e.node);
    }
  }

  Tokens unconnected(const Element& e) {
    document_.error(e.node, "the " + std::string(local_name(e.node)) + " is not connected");
    return words("FALSE", e.node);
  }
  Tokens not_before(const Element& e, Node at) {
    document_.error(
        at, "the value of the " + Diagram::described(e) +
                " is used before it is executed: a loop leads through a variable or a function block");
    return words("FALSE", at);
  }

  Tokens contact(std::size_t i, int depth) {
    const auto& e = elements_[i];
    if (const auto found = defined_.find(i); found != defined_.end()) return found->second;
    if (e.inputs.empty() || e.inputs[0].sources.empty()) return unconnected(e);
    const bool at_rail =
        e.inputs[0].sources.size() == 1 && elements_[e.inputs[0].sources[0].element].kind == Kind::power_rail;
    Tokens result;
    if (!at_rail) {
      result = input(e.inputs[0], depth + 1);
      append(result, words("AND", e.node));
    }
    auto value = e.edge != Edge::none ? edge(e.edge, e.value, e.node) : e.value;
    append(result, negated(std::move(value), e.negated, e.node, document_));
    if (e.consumers < 2) return result;
    define(value_name(e), std::move(result), e.node);
    return defined_[i] = value_name(e);
  }

  Tokens connector(std::size_t i, int depth) {
    const auto& e = elements_[i];
    if (const auto found = defined_.find(i); found != defined_.end()) return found->second;
    if (e.inputs.empty()) return unconnected(e);
    define(value_name(e), input(e.inputs[0], depth + 1), e.node);
    return defined_[i] = value_name(e);
  }

  Tokens output(const Element& e, const Source& from) {
    const auto is_done = state_[from.element] == State::done;
    if (from.output == "ENO") {
      if (enable(e) == nullptr) return words("TRUE", from.at);
      return is_done ? value_name(e, ".ENO") : not_before(e, from.at);
    }
    bool negates = false;
    for (const auto& one : e.outputs)
      if (upper_case(one.name) == from.output) negates = one.negated;
    if (e.is_function()) {
      if (is_further_output(e, from.output)) {
        document_.error(from.at,
                        "the output '" + from.output + "' of a function can be connected to a variable only");
        return words("FALSE", from.at);
      }
      if (!is_done) return not_before(e, from.at);
      return negated(value_name(e), negates, from.at, document_);
    }
    if (from.output.empty() && e.outputs.empty()) {
      document_.error(from.at, "the connection does not name an output of the " + Diagram::described(e));
      return words("FALSE", from.at);
    }
    auto result = e.instance;
    append(result, words("." + (from.output.empty() ? e.outputs[0].name : from.output), from.at));
    return negated(std::move(result), negates, from.at, document_);
  }

  Document& document_;
  const std::vector<Element>& elements_;
  std::size_t networks_;
  const std::set<std::string>& names_;
  std::vector<State> state_;
  std::map<std::string, std::size_t> connectors_;
  std::map<std::size_t, Tokens> defined_;  ///< contacts whose power is computed already
  std::size_t edges_ = 0;
  Tokens declarations_, statements_;
};

}  // namespace

DiagramBody diagram_body(Document& document, const Diagram& diagram, const std::set<std::string>& names) {
  return StatementWriter(document, diagram, names).run();
}

}  // namespace trunnion::st::plcopen
