// SPDX-License-Identifier: Apache-2.0
#include "plc/plcopen/chart.hpp"

#include <algorithm>
#include <charconv>
#include <functional>
#include <limits>
#include <map>
#include <numeric>
#include <set>
#include <tuple>

namespace trunnion::st::plcopen {
namespace {

const std::set<std::string> plain_qualifiers = {"N", "R", "S", "P", "P0", "P1"};
const std::set<std::string> timed_qualifiers = {"L", "D", "SD", "DS", "SL"};

struct Part {
  enum class Kind {
    step,
    macro_step,
    jump,
    transition,
    selection_divergence,
    selection_convergence,
    simultaneous_divergence,
    simultaneous_convergence,
    action_block,
  };

  Kind kind = Kind::step;
  Node node;
  std::vector<std::size_t> from;  ///< what its connections come from
  std::size_t index = 0;          ///< of a step or a transition; of a macro step the step at its end
  std::size_t first = 0;          ///< of a macro step: the step at its beginning
  std::string scope;              ///< of the body it is in: local ids begin with it
};

const std::map<std::string_view, Part::Kind> part_kinds = {
    {"step", Part::Kind::step},
    {"macroStep", Part::Kind::macro_step},
    {"jumpStep", Part::Kind::jump},
    {"transition", Part::Kind::transition},
    {"selectionDivergence", Part::Kind::selection_divergence},
    {"selectionConvergence", Part::Kind::selection_convergence},
    {"simultaneousDivergence", Part::Kind::simultaneous_divergence},
    {"simultaneousConvergence", Part::Kind::simultaneous_convergence},
    {"actionBlock", Part::Kind::action_block}};

class ChartReader {
  using Kind = Part::Kind;

 public:
  ChartReader(Document& document, Node body) : document_(document), body_(body) {}

  Chart run() {
    for (const auto node : children(body_)) read(node, "");
    for (auto& part : parts_) connect(part);
    if (!failed())
      for (auto& part : parts_)
        if (part.kind == Kind::macro_step) find_ends(part);
    if (failed()) return std::move(chart_);
    for (const auto& part : parts_) follow(part);
    if (!failed()) check_initial_steps();
    if (!failed()) sort();
    return std::move(chart_);
  }

 private:
  bool failed() const { return document_.diagnostics().errors() > errors_; }

  void read(Node node, const std::string& scope) {
    const auto name = local_name(node);
    if (name == "comment" || name == "documentation" || name == "vendorElement") return;
    const auto found = part_kinds.find(name);
    if (found == part_kinds.end())
      return document_.error(node, "'" + std::string(name) +
                                       "' is not available in a sequential function chart: step, macroStep, "
                                       "jumpStep, transition, actionBlock, divergences and convergences are");
    const auto id = attribute(node, "localId");
    if (id.empty() || !by_id_.emplace(scope + id, parts_.size()).second)
      return document_.error(node, id.empty() ? "the attribute localId is missing"
                                              : "there are two elements with localId " + id);
    Part part{found->second, node, {}, 0, 0, scope};
    if (part.kind == Kind::step) {
      if (!document_.name(node, "name")) return;
      part.index = chart_.steps.size();
      const auto text = attribute(node, "name");
      if (!by_name_.emplace(upper_case(text), part.index).second)
        return document_.error(node, "there are two steps '" + text + "'");
      chart_.steps.push_back({node, text, attribute(node, "initialStep") == "true"});
    } else if (part.kind == Kind::transition) {
      part.index = chart_.transitions.size();
      chart_.transitions.push_back({node, 0, {}, {}});
    }
    parts_.push_back(part);
    if (part.kind != Kind::macro_step) return;
    const auto inner = child(child(node, "body"), "SFC");
    if (!inner) return document_.error(node, "the macro step has no body in SFC");
    if (++depth_ > deepest_element) return document_.error(node, "macro steps are nested too deeply");
    for (const auto one : children(inner)) read(one, scope + id + "/");
    --depth_;
  }

  /// A macro step stands for its chart: what leads to it leads to the step that has nothing before it, what
  /// comes from it comes from the step that has nothing behind it (IEC 60848:2013, 7.6).
  void find_ends(Part& macro) {
    const auto scope = macro.scope + attribute(macro.node, "localId") + "/";
    std::vector<std::size_t> first, last;
    for (std::size_t i = 0; i < parts_.size(); ++i) {
      const auto& part = parts_[i];
      if (part.scope != scope || part.kind != Kind::step) continue;
      if (part.from.empty()) first.push_back(part.index);
      const bool leads_on = std::any_of(parts_.begin(), parts_.end(), [&](const Part& other) {
        return other.kind != Kind::action_block &&
               std::find(other.from.begin(), other.from.end(), i) != other.from.end();
      });
      if (!leads_on) last.push_back(part.index);
    }
    if (first.size() != 1 || last.size() != 1)
      return document_.error(macro.node,
                             "a macro step has one step without connection to one before it and one with "
                             "nothing behind it; here are " +
                                 std::to_string(first.size()) + " and " + std::to_string(last.size()));
    macro.first = first[0], macro.index = last[0];
  }

  void connect(Part& part) {
    for (const auto point : children(part.node, "connectionPointIn"))
      for (const auto connection : children(point, "connection")) {
        const auto id = attribute(connection, "refLocalId");
        const auto found = by_id_.find(part.scope + id);
        if (found == by_id_.end())
          document_.error(connection, "there is no element with localId " + id);
        else
          part.from.push_back(found->second);
      }
  }

  void follow(const Part& part) {
    switch (part.kind) {
      case Kind::transition: {
        auto& before = chart_.transitions[part.index].before;
        steps_before(part, part, before, 0);
        std::sort(before.begin(), before.end());
        before.erase(std::unique(before.begin(), before.end()), before.end());
        if (before.empty() && !failed()) document_.error(part.node, "the transition has no step before it");
        break;
      }
      case Kind::step:
        transitions_before(part, part, part.index, 0);
        break;
      case Kind::macro_step:
        transitions_before(part, part, part.first, 0);
        break;
      case Kind::jump: {
        const auto name = attribute(part.node, "targetName");
        const auto found = by_name_.find(upper_case(name));
        if (found == by_name_.end()) return document_.error(part.node, "there is no step '" + name + "'");
        transitions_before(part, part, found->second, 0);
        break;
      }
      case Kind::action_block:
        read_actions(part);
        break;
      default:
        break;
    }
  }

  /// Depth first through what lies between a transition and the steps before it.
  void steps_before(const Part& at, const Part& transition, std::vector<std::size_t>& steps, int depth) {
    for (const auto i : at.from) {
      const auto& part = parts_[i];
      if (part.kind == Kind::step || part.kind == Kind::macro_step) {
        steps.push_back(part.index);
      } else if (part.kind == Kind::transition || part.kind == Kind::selection_convergence) {
        return document_.error(transition.node,
                               "two transitions follow each other; a step is missing between them");
      } else if ((part.kind != Kind::selection_divergence && part.kind != Kind::simultaneous_convergence) ||
                 depth == deepest_element) {
        return document_.error(transition.node, "the transition is not connected with a step before it");
      } else {
        steps_before(part, transition, steps, depth + 1);
      }
    }
  }

  /// The same between a step, or a jump to it, and the transitions before it.
  void transitions_before(const Part& at, const Part& step, std::size_t target, int depth) {
    for (const auto i : at.from) {
      const auto& part = parts_[i];
      if (part.kind == Kind::transition) {
        auto& after = chart_.transitions[part.index].after;
        if (std::find(after.begin(), after.end(), target) == after.end()) after.push_back(target);
      } else if (part.kind == Kind::step || part.kind == Kind::macro_step ||
                 part.kind == Kind::simultaneous_convergence) {
        return document_.error(step.node,
                               "two steps follow each other; a transition is missing between them");
      } else if ((part.kind != Kind::selection_convergence && part.kind != Kind::simultaneous_divergence) ||
                 depth == deepest_element) {
        return document_.error(step.node, "the step is not connected with a transition before it");
      } else {
        transitions_before(part, step, target, depth + 1);
      }
    }
  }

  void read_actions(const Part& block) {
    std::optional<std::size_t> step;
    for (const auto i : block.from)
      if (parts_[i].kind == Kind::step) step = parts_[i].index;
    if (!step) return document_.error(block.node, "the action block is not connected with a step");
    for (const auto node : children(block.node, "action")) {
      ChartAssociation one{node, *step, attribute(node, "qualifier"), {}, "", {}};
      if (one.qualifier.empty()) one.qualifier = "N";
      const bool timed = timed_qualifiers.contains(one.qualifier);
      if (!timed && !plain_qualifiers.contains(one.qualifier)) {
        document_.error(node, "the qualifier '" + one.qualifier +
                                  "' is not known: N, R, S, L, D, P, SD, DS, SL, P0 and P1 are");
        continue;
      }
      const bool has_duration = !attribute(node, "duration").empty();
      if (timed && !has_duration) {
        document_.error(node, "the qualifier " + one.qualifier + " needs a duration, as T#2s");
        continue;
      }
      if (timed) one.duration = document_.expression(node, "duration");
      if (const auto reference = child(node, "reference")) {
        if (!document_.name(reference, "name")) continue;
        one.action = attribute(reference, "name");
      } else {
        one.body = child(node, "inline");
        if (!one.body) document_.error(node, "the action has neither a reference nor a body");
      }
      chart_.associations.push_back(std::move(one));
    }
  }

  void check_initial_steps() {
    // Steps and transitions that are connected are one network.
    const auto steps = chart_.steps.size();
    std::vector<std::size_t> network(steps + chart_.transitions.size());
    std::iota(network.begin(), network.end(), 0u);
    const auto root = [&](std::size_t i) {
      while (network[i] != i) i = network[i] = network[network[i]];
      return i;
    };
    for (std::size_t t = 0; t < chart_.transitions.size(); ++t)
      for (const auto* list : {&chart_.transitions[t].before, &chart_.transitions[t].after})
        for (const auto step : *list) network[root(step)] = root(steps + t);
    std::map<std::size_t, std::size_t> initial;  // of each network: how many
    for (std::size_t s = 0; s < steps; ++s) initial[root(s)] += chart_.steps[s].initial ? 1 : 0;
    if (steps == 0) document_.error(body_, "the chart has no step");
    for (std::size_t s = 0; s < steps; ++s) {
      auto& count = initial[root(s)];
      if (count == 1) continue;
      document_.error(chart_.steps[s].node,
                      count == 0
                          ? "the network of the step '" + chart_.steps[s].name + "' has no initial step"
                          : "the network of the step '" + chart_.steps[s].name + "' has " +
                                std::to_string(count) + " initial steps; one is allowed");
      count = 1;  // it is said once
    }
    for (const auto& transition : chart_.transitions)
      if (transition.after.empty()) document_.error(transition.node, "no step follows the transition");
  }

  void sort() {
    const auto number = [](const std::string& text, auto missing) {
      auto value = missing;
      std::from_chars(text.data(), text.data() + text.size(), value);
      return value;
    };
    auto& all = chart_.transitions;
    std::vector<std::size_t> order(all.size());
    std::iota(order.begin(), order.end(), 0u);
    const auto key = [&](std::size_t i) {
      const auto node = all[i].node;
      return std::tuple(number(attribute(node, "priority"), std::numeric_limits<std::uint64_t>::max()),
                        number(attribute(child(node, "position"), "x"), 0.0), i);
    };
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return key(a) < key(b); });
    std::vector<ChartTransition> sorted;
    for (const auto i : order) sorted.push_back(std::move(all[i])), sorted.back().number = sorted.size();
    all = std::move(sorted);
  }

  Document& document_;
  Node body_;
  Chart chart_;
  std::vector<Part> parts_;
  std::map<std::string, std::size_t> by_id_, by_name_;
  int depth_ = 0;
  const std::size_t errors_ = document_.diagnostics().errors();
};

}  // namespace

Chart read_chart(Document& document, Node body) { return ChartReader(document, body).run(); }

}  // namespace trunnion::st::plcopen
