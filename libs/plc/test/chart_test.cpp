// SPDX-License-Identifier: Apache-2.0
// Sequential function charts: the rules of evolution, and random charts against an evaluator of this test.
#include <gmock/gmock.h>

#include <algorithm>
#include <functional>
#include <map>
#include <optional>
#include <random>

#include "plc/library/register_names.hpp"
#include "plc/machine/verify.hpp"
#include "plc/tools/program_run.hpp"
#include "plcopen_documents.hpp"

namespace trunnion::st {
namespace {

using testing::HasSubstr;

constexpr std::int64_t period = 10;  // ms between two scans

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

std::string program(const ChartText& chart, const std::vector<std::pair<std::string, std::string>>& list,
                    const std::string& parts = "") {
  return project("<pou name=\"main\" pouType=\"program\">\n<interface>" + variables("localVars", list) +
                 "</interface>\n" + parts + "<body>" + chart.body() + "</body>\n</pou>\n");
}

std::string actions(const std::vector<std::pair<std::string, std::string>>& list) {
  std::string text = "<actions>";
  for (const auto& [name, code] : list)
    text += "<action name=\"" + name + "\"><body>" + ChartText::st(code) + "</body></action>";
  return text + "</actions>";
}

class Loaded {
 public:
  explicit Loaded(const std::string& xml)
      : compilation(compile({{"chart.xml", xml}}, interface_registers())), run(checked(compilation)) {}
  void scan(int times = 1) {
    for (int i = 0; i < times; ++i) {
      const auto fault = run.scan("", period * 1000000);
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
  ProgramRun run;

 private:
  static const Compilation& checked(const Compilation& compilation) {
    if (!compilation.good()) throw std::runtime_error(testing::PrintToString(compilation.lines()));
    EXPECT_EQ(verify(*compilation.code), "");
    return compilation;
  }
};

std::string first_message(const std::string& xml) {
  for (const auto& line : compile({{"chart.xml", xml}}, interface_registers()).lines())
    if (line.find(": error: ") != std::string::npos) return line;
  return "";
}

const std::vector<std::pair<std::string, std::string>> bits = {
    {"a", "<BOOL/>"}, {"b", "<BOOL/>"}, {"q", "<BOOL/>"}, {"n", "<INT/>"}};

TEST(Chart, GoesFromStepToStepOneTransitionInEachScan) {
  ChartText chart;
  chart.step(1, "rest", {5}, true);
  chart.transition(2, "a", {1});
  chart.step(3, "work", {2});
  chart.transition(5, "NOT a;", {3});
  chart.action(6, 3, ChartText::named("N", "q"));
  Loaded logic(program(chart, bits));
  logic.scan(3);
  EXPECT_EQ(logic.active({"rest", "work"}), "rest");
  EXPECT_EQ(logic.get("rest.T"), "T#20ms") << "active since the first scan";
  logic.set("a", true);
  logic.scan();  // the transition is taken at the end of this scan
  EXPECT_EQ(logic.active({"rest", "work"}), "work");
  EXPECT_FALSE(logic.is("q"));
  logic.scan();
  EXPECT_TRUE(logic.is("q"));
  logic.set("a", false);
  logic.scan();
  EXPECT_EQ(logic.active({"rest", "work"}), "rest");
  EXPECT_EQ(logic.get("work.T"), "T#20ms") << "a step that is left keeps its time";
  logic.scan();
  EXPECT_FALSE(logic.is("q"));
}

TEST(Chart, OfASelectionTheFirstTrueTransitionByPriorityThenFromTheLeftIsTaken) {
  for (const bool with_priority : {false, true}) {
    ChartText chart;
    chart.step(1, "start", {}, true);
    chart.add("selectionDivergence", 2, "", {1});
    chart.transition(3, "a", {2}, with_priority ? "priority=\"2\"" : "", 10);
    chart.transition(4, "b", {2}, with_priority ? "priority=\"1\"" : "", 20);
    chart.step(5, "left", {3});
    chart.step(6, "right", {4});
    chart.transition(7, "FALSE", {5});
    chart.transition(8, "FALSE", {6});
    chart.add("selectionConvergence", 9, "", {7, 8});
    chart.add("jumpStep", 10, "targetName=\"start\"", {9});
    Loaded logic(program(chart, bits));
    logic.set("a", true), logic.set("b", true);
    logic.scan();
    EXPECT_EQ(logic.active({"start", "left", "right"}), with_priority ? "right" : "left");
  }
}

TEST(Chart, SimultaneousSequencesBeginTogetherAndWaitForEachOther) {
  ChartText chart;
  chart.step(1, "start", {13}, true);
  chart.transition(2, "a", {1});
  chart.add("simultaneousDivergence", 3, "", {2});
  chart.step(4, "one", {3});
  chart.step(5, "two", {3});
  chart.transition(6, "b", {5});
  chart.step(7, "three", {6});
  chart.add("simultaneousConvergence", 8, "", {4, 7});
  chart.transition(13, "TRUE", {8});
  Loaded logic(program(chart, bits));
  const std::vector<std::string> all = {"start", "one", "two", "three"};
  logic.set("a", true);
  logic.scan();
  EXPECT_EQ(logic.active(all), "one two");
  logic.set("a", false);
  logic.scan(5);
  EXPECT_EQ(logic.active(all), "one two") << "the convergence waits";
  logic.set("b", true);
  logic.scan();
  EXPECT_EQ(logic.active(all), "one three");
  logic.scan();
  EXPECT_EQ(logic.active(all), "start");
}

TEST(Chart, AnActionIsExecutedOnceMoreAfterItsStepAndP1AndP0OnceEach) {
  ChartText chart;
  chart.step(1, "rest", {4}, true);
  chart.transition(2, "a", {1});
  chart.step(3, "work", {2});
  chart.transition(4, "NOT a", {3});
  chart.action(
      5, 3,
      ChartText::named("N", "count") + ChartText::named("P1", "entry") + ChartText::named("P0", "leave"));
  Loaded logic(program(
      chart, {{"a", "<BOOL/>"}, {"n", "<INT/>"}, {"ins", "<INT/>"}, {"outs", "<INT/>"}},
      actions({{"count", "n := n + 1;"}, {"entry", "ins := ins + 1;"}, {"leave", "outs := outs + 1;"}})));
  logic.set("a", true);
  logic.scan(6);  // the first one takes the transition, five have the step
  EXPECT_EQ(logic.get("n"), "5");
  EXPECT_EQ(logic.get("ins"), "1");
  EXPECT_EQ(logic.get("outs"), "0");
  logic.set("a", false);
  logic.scan();  // still in the step
  EXPECT_EQ(logic.get("n"), "6");
  logic.scan(5);
  EXPECT_EQ(logic.get("n"), "7") << "once more with the step inactive";
  EXPECT_EQ(logic.get("outs"), "1");
  EXPECT_EQ(logic.get("ins"), "1");
}

TEST(Chart, ActionsMayBeInOtherLanguagesAndTransitionsHaveNames) {
  ChartText chart;
  chart.step(1, "rest", {4}, true);
  chart.add("transition", 2, "", {1}, "<condition><reference name=\"ready\"/></condition>");
  chart.step(3, "work", {2});
  chart.add("transition", 4, "", {3}, "<condition><reference name=\"b\"/></condition>");
  chart.action(5, 3, ChartText::named("N", "lamp"));
  DiagramText ladder;
  ladder.coil("q", {ladder.contact("a", {ladder.rail()}, "edge=\"rising\"")});
  const auto parts = "<actions><action name=\"lamp\"><body>" + ladder.ladder() +
                     "</body></action></actions><transitions><transition name=\"ready\"><body>" +
                     ChartText::st(":= n > 3;") + "</body></transition></transitions>";
  Loaded logic(program(chart, bits, parts));
  logic.scan(3);
  EXPECT_TRUE(logic.is("rest.X"));
  logic.run.set("n", "4");
  logic.scan();
  logic.set("a", true);
  logic.scan();
  EXPECT_TRUE(logic.is("q"));
  logic.scan();
  EXPECT_FALSE(logic.is("q"));
  logic.set("b", true);
  logic.scan();
  EXPECT_TRUE(logic.is("rest.X"));
}

TEST(Chart, WrongOnesSayWhichElement) {
  const auto with = [](const std::function<void(ChartText&)>& change) {
    ChartText chart;
    chart.step(1, "rest", {4}, true);
    chart.transition(2, "a", {1});
    chart.step(3, "work", {2});
    chart.transition(4, "b", {3});
    change(chart);
    return first_message(program(chart, bits));
  };
  EXPECT_EQ(with([](ChartText&) {}), "");
  EXPECT_THAT(with([](ChartText& c) { c.step(7, "REST", {}); }), HasSubstr("there are two steps 'REST'"));
  EXPECT_THAT(with([](ChartText& c) { c.step(7, "alone", {}); }),
              HasSubstr("the network of the step 'alone' has no initial step"));
  EXPECT_THAT(with([](ChartText& c) { c.transition(7, "a", {3}), c.step(8, "third", {7}, true); }),
              HasSubstr("the network of the step 'rest' has 2 initial steps; one is allowed"));
  EXPECT_THAT(with([](ChartText& c) { c.step(7, "third", {3}); }),
              HasSubstr("two steps follow each other; a transition is missing"));
  EXPECT_THAT(with([](ChartText& c) { c.transition(7, "a", {2}); }),
              HasSubstr("two transitions follow each other"));
  EXPECT_THAT(with([](ChartText& c) { c.transition(7, "a", {3}); }),
              HasSubstr("no step follows the transition"));
  EXPECT_THAT(with([](ChartText& c) { c.add("jumpStep", 7, "targetName=\"none\"", {4}); }),
              HasSubstr("there is no step 'none'"));
  EXPECT_THAT(with([](ChartText& c) { c.action(7, 3, ChartText::named("X", "q")); }),
              HasSubstr("the qualifier 'X' is not known"));
  EXPECT_THAT(with([](ChartText& c) { c.action(7, 3, ChartText::named("D", "q")); }),
              HasSubstr("the qualifier D needs a duration, as T#2s"));
  EXPECT_THAT(with([](ChartText& c) { c.action(7, 2, ChartText::named("N", "q")); }),
              HasSubstr("the action block is not connected with a step"));
  EXPECT_THAT(with([](ChartText& c) { c.action(7, 3, ChartText::named("N", "none")); }),
              HasSubstr("there is no variable 'none'"));
  EXPECT_THAT(with([](ChartText& c) {
                c.action(7, 3, ChartText::named("D", "q", "T#1s")),
                    c.action(8, 1, ChartText::named("L", "q", "T#1s"));
              }),
              HasSubstr("the action 'q' has two qualifiers with a duration"));
  const auto message =
      with([](ChartText& c) { c.transition(7, "n", {3}), c.add("jumpStep", 8, "targetName=\"rest\"", {7}); });
  EXPECT_THAT(message, HasSubstr("INT"));
  EXPECT_THAT(message, HasSubstr("(POU 'main', transition with localId 7)"));
  EXPECT_THAT(with([](ChartText& c) { c.add("macroStep", 7, "name=\"m\"", {}); }),
              HasSubstr("'macroStep' is not available in a sequential function chart"));
}

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
                      std::int64_t(below(5)) * period};
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
    Loaded logic(xml);
    Evaluator evaluator(model);
    auto before = evaluator.active;
    for (int scan = 0; scan < 40; ++scan) {
      std::vector<bool> in;
      for (std::size_t i = 0; i < inputs; ++i) {
        in.push_back(random() % 2 == 0);
        logic.set("i" + std::to_string(i), in.back());
      }
      logic.scan();
      evaluator.scan(scan * period, in);
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
