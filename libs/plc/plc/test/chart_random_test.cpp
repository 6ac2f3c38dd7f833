// SPDX-License-Identifier: Apache-2.0
// Random sequential function charts against an evaluator of this test.
#include <algorithm>
#include <map>
#include <optional>
#include <random>

#include "chart_documents.hpp"

namespace trunnion::st {
namespace {

// Random charts. The evaluator below knows the rules of IEC 61131-3:2013, 6.7 and nothing of the translation.

struct Association {
  std::size_t step;
  std::string qualifier;
  std::int64_t duration;  // ms
};
struct Model {
  struct Transition {
    std::vector<std::size_t> before, after;
    std::size_t input = 0;
    bool negated = false;
    int priority = 0;  // 0: none
    double x = 0;
  };
  std::size_t steps = 0;
  std::vector<Transition> transitions;
  std::vector<std::vector<Association>>
      actions;  // the last one counts its executions, the others are variables
};
constexpr std::size_t inputs = 3, variables_count = 3;

bool is_timed(const std::string& q) { return q == "L" || q == "D" || q == "SD" || q == "DS" || q == "SL"; }

Model random_model(std::mt19937& random) {
  const auto below = [&](std::size_t n) { return random() % n; };
  Model model;
  model.steps = 2 + below(5);
  const auto some = [&] {
    std::vector<std::size_t> list = {below(model.steps)};
    if (below(3) == 0)
      if (const auto other = below(model.steps); other != list[0]) list.push_back(other);
    return list;
  };
  const auto count = model.steps + below(4);
  for (std::size_t t = 0; t < count; ++t) {
    Model::Transition one{
        some(),          some(), below(inputs), below(2) == 0, below(3) == 0 ? int(1 + below(3)) : 0,
        double(below(5))};
    // A chain through all steps, so that they are one network.
    if (t + 1 < model.steps) one.before = {t}, one.after = {t + 1};
    model.transitions.push_back(one);
  }
  static const std::vector<std::string> qualifiers = {"N", "N",  "S",  "R",  "L",  "D",
                                                      "P", "P0", "P1", "SD", "DS", "SL"};
  for (std::size_t a = 0; a <= variables_count; ++a) {
    auto& action = model.actions.emplace_back();
    for (std::size_t i = 0; i < 1 + below(4); ++i) {
      Association one{below(model.steps), qualifiers[below(qualifiers.size())],
                      std::int64_t(below(5)) * chart_period};
      const bool has_timed = std::any_of(action.begin(), action.end(),
                                         [](const auto& other) { return is_timed(other.qualifier); });
      if (is_timed(one.qualifier) && has_timed) continue;
      action.push_back(one);
    }
  }
  return model;
}

std::string xml_of(const Model& model) {
  ChartText chart;
  const auto id = [](const char* kind, std::size_t i) {
    static const std::vector<std::string> kinds = {"step",   "transition", "joined", "split",
                                                   "chosen", "merged",     "block"};
    return static_cast<int>(
        i + 1 + 1000 * static_cast<std::size_t>(std::find(kinds.begin(), kinds.end(), kind) - kinds.begin()));
  };
  std::vector<std::size_t> leaving(model.steps);
  for (const auto& t : model.transitions)
    for (const auto s : t.before) ++leaving[s];
  for (std::size_t s = 0; s < model.steps; ++s) {
    std::vector<int> from;
    for (std::size_t t = 0; t < model.transitions.size(); ++t) {
      const auto& after = model.transitions[t].after;
      if (std::find(after.begin(), after.end(), s) != after.end())
        from.push_back(id(after.size() > 1 ? "split" : "transition", t));
    }
    // The last one by a jump, where there are several.
    if (from.size() > 1 && s % 2 == 0) {
      chart.add("jumpStep", 9000 + static_cast<int>(s), "targetName=\"s" + std::to_string(s) + "\"",
                {from.back()});
      from.pop_back();
    }
    if (from.size() > 1)
      chart.add("selectionConvergence", id("merged", s), "", from), from = {id("merged", s)};
    chart.step(id("step", s), "s" + std::to_string(s), from, s == 0);
    if (leaving[s] > 1) chart.add("selectionDivergence", id("chosen", s), "", {id("step", s)});
  }
  for (std::size_t t = 0; t < model.transitions.size(); ++t) {
    const auto& one = model.transitions[t];
    std::vector<int> from;
    for (const auto s : one.before) from.push_back(id(leaving[s] > 1 ? "chosen" : "step", s));
    if (from.size() > 1)
      chart.add("simultaneousConvergence", id("joined", t), "", from), from = {id("joined", t)};
    chart.transition(id("transition", t), (one.negated ? "NOT i" : "i") + std::to_string(one.input), from,
                     one.priority > 0 ? "priority=\"" + std::to_string(one.priority) + "\"" : "", one.x);
    if (one.after.size() > 1) chart.add("simultaneousDivergence", id("split", t), "", {id("transition", t)});
  }
  int block = 0;
  for (std::size_t a = 0; a < model.actions.size(); ++a)
    for (const auto& one : model.actions[a])
      chart.action(
          id("block", static_cast<std::size_t>(block++)), id("step", one.step),
          ChartText::named(one.qualifier, a < variables_count ? "v" + std::to_string(a) : "count",
                           is_timed(one.qualifier) ? "T#" + std::to_string(one.duration) + "ms" : ""));
  std::vector<std::pair<std::string, std::string>> list = {{"n", "<INT/>"}};
  for (std::size_t i = 0; i < inputs; ++i) list.emplace_back("i" + std::to_string(i), "<BOOL/>");
  for (std::size_t a = 0; a < variables_count; ++a) list.emplace_back("v" + std::to_string(a), "<BOOL/>");
  return program(chart, list, actions({{"count", "n := n + 1;"}}));
}

class Evaluator {
 public:
  explicit Evaluator(const Model& model)
      : model_(model),
        active(model.steps),
        since(model.steps),
        time(model.steps),
        values(variables_count),
        actions_(model.actions.size()) {
    active[0] = true;
  }

  void scan(std::int64_t now, const std::vector<bool>& in) {
    for (std::size_t s = 0; s < model_.steps; ++s)
      if (active[s]) time[s] = now - since[s];
    for (std::size_t a = 0; a < actions_.size(); ++a) {
      const bool executes = control(a, now);
      if (a < variables_count)
        values[a] = executes;
      else if (executes || fell_)
        ++count;
    }
    std::vector<std::size_t> order(model_.transitions.size());
    for (std::size_t t = 0; t < order.size(); ++t) order[t] = t;
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
      const auto key = [&](const Model::Transition& t) {
        return std::pair(t.priority > 0 ? t.priority : 1000, t.x);
      };
      return key(model_.transitions[a]) < key(model_.transitions[b]);
    });
    std::vector<bool> claimed(model_.steps), next = active;
    std::vector<std::size_t> taken;
    for (const auto t : order) {
      const auto& one = model_.transitions[t];
      const auto all = [&](const auto& holds) {
        return std::all_of(one.before.begin(), one.before.end(), holds);
      };
      if (!all([&](std::size_t s) { return active[s] && !claimed[s]; }) || in[one.input] == one.negated)
        continue;
      for (const auto s : one.before) claimed[s] = true, next[s] = false;
      taken.push_back(t);
    }
    for (const auto t : taken)
      for (const auto s : model_.transitions[t].after) next[s] = true, since[s] = now, time[s] = 0;
    active = next;
  }

 private:
  struct State {
    std::map<std::string, bool> input;  // of the scan before, by qualifier
    bool stored = false, latched = false, q = false;
    std::optional<std::int64_t> timer;  // when its input became true
  };

  bool control(std::size_t a, std::int64_t now) {
    auto& state = actions_[a];
    std::map<std::string, bool> input;
    std::int64_t duration = 0;
    for (const auto& one : model_.actions[a]) {
      input[one.qualifier] = input[one.qualifier] || active[one.step];
      if (is_timed(one.qualifier)) duration = one.duration;
    }
    const auto on = [&](const char* q) { return input.contains(q) && input.at(q); };
    const auto rises = [&](const char* q) { return on(q) && !state.input[q]; };
    const auto timed_out = [&](bool running) {
      if (!running) return state.timer.reset(), false;
      if (!state.timer) state.timer = now;
      return now - *state.timer >= duration;
    };
    const bool reset = on("R");
    bool q = on("N");
    if (on("S")) state.stored = true;
    if (reset) state.stored = false;
    q = q || state.stored || rises("P");
    if (on("SD") || on("SL")) state.latched = true;
    if (input.contains("L")) q = (on("L") && !timed_out(on("L"))) || q;
    if (input.contains("L") && !on("L")) timed_out(false);
    if (input.contains("D")) q = timed_out(on("D")) || q;
    if (input.contains("DS") && timed_out(on("DS"))) state.latched = true;
    if (reset) state.latched = false;
    if (input.contains("DS")) q = q || state.latched;
    if (input.contains("SD")) q = timed_out(state.latched) || q;
    if (input.contains("SL")) q = (!timed_out(state.latched) && state.latched) || q;
    q = q && !reset;
    const bool pulse = rises("P1") || (input.contains("P0") && !on("P0") && state.input["P0"]);
    fell_ = state.q && !q;
    state.q = q;
    state.input = input;
    return q || pulse;
  }

  const Model& model_;

 public:
  std::vector<bool> active;
  std::vector<std::int64_t> since, time;
  std::vector<bool> values;
  int count = 0;

 private:
  std::vector<State> actions_;
  bool fell_ = false;
};

TEST(Chart, RandomOnesDoWhatTheRulesSay) {
  std::mt19937 random(61131);
  int moved = 0;
  for (int round = 0; round < 300; ++round) {
    const auto model = random_model(random);
    const auto xml = xml_of(model);
    SCOPED_TRACE(xml);
    LoadedChart logic(xml);
    Evaluator evaluator(model);
    auto before = evaluator.active;
    for (int scan = 0; scan < 40; ++scan) {
      std::vector<bool> in;
      for (std::size_t i = 0; i < inputs; ++i) {
        in.push_back(random() % 2 == 0);
        logic.set("i" + std::to_string(i), in.back());
      }
      logic.scan();
      evaluator.scan(scan * chart_period, in);
      for (std::size_t s = 0; s < model.steps; ++s) {
        const auto name = "s" + std::to_string(s);
        ASSERT_EQ(logic.is(name + ".X"), evaluator.active[s]) << name << " in scan " << scan;
        ASSERT_EQ(logic.get(name + ".T"), "T#" + std::to_string(evaluator.time[s]) + "ms")
            << name << " in scan " << scan;
      }
      for (std::size_t a = 0; a < variables_count; ++a)
        ASSERT_EQ(logic.is("v" + std::to_string(a)), evaluator.values[a]) << "v" << a << " in scan " << scan;
      ASSERT_EQ(logic.get("n"), std::to_string(evaluator.count)) << "in scan " << scan;
      moved += evaluator.active != before ? 1 : 0;
      before = evaluator.active;
    }
  }
  // Of 12000 scans; a chart that waits for an input that changes at random moves in every second one or
  // fewer.
  EXPECT_GT(moved, 2000) << "the charts hardly move: the test shows little";
}

}  // namespace
}  // namespace trunnion::st
