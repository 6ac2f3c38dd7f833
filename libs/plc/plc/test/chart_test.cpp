// SPDX-License-Identifier: Apache-2.0
// Sequential function charts: the rules of evolution, and what is wrong.
#include "chart_documents.hpp"

#include <gmock/gmock.h>

#include <functional>

namespace trunnion::st::chart_test {
namespace {

using testing::HasSubstr;

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
  LoadedChart logic(program(chart, bits));
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
    LoadedChart logic(program(chart, bits));
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
  LoadedChart logic(program(chart, bits));
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
  LoadedChart logic(program(
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
  LoadedChart logic(program(chart, bits, parts));
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

TEST(Chart, ConditionsMayBeLaddersAndFunctionBlockDiagrams) {
  DiagramText ladder, blocks;
  ladder.coil("go", {ladder.contact("b", {ladder.contact("a", {ladder.rail()})})});
  blocks.out("back",
             {blocks.block("GE", "", {{"IN1", {blocks.in("n")}}, {"IN2", {blocks.in("3")}}}, {"OUT"})});
  ChartText chart;
  chart.step(1, "rest", {4}, true);
  chart.add("transition", 2, "", {1}, "<condition><reference name=\"go\"/></condition>");
  chart.step(3, "work", {2});
  chart.add("transition", 4, "", {3},
            "<condition><inline name=\"back\">" + blocks.blocks() + "</inline></condition>");
  chart.action(5, 3,
               "<action qualifier=\"N\"><inline>" + ChartText::st("n := n + 1;") + "</inline></action>");
  LoadedChart logic(program(chart, bits,
                            "<transitions><transition name=\"go\"><body>" + ladder.ladder() +
                                "</body></transition></transitions>"));
  logic.set("a", true);
  logic.scan();
  EXPECT_EQ(logic.active({"rest", "work"}), "rest");
  logic.set("b", true);
  logic.scan();
  EXPECT_EQ(logic.active({"rest", "work"}), "work");
  logic.set("a", false);
  logic.scan(2);
  EXPECT_EQ(logic.active({"rest", "work"}), "work");
  logic.scan();  // n is 3
  EXPECT_EQ(logic.active({"rest", "work"}), "rest");
}

TEST(Chart, AMacroStepStandsForItsChart) {
  ChartText inside;
  inside.step(1, "first", {});
  inside.transition(2, "b", {1});
  inside.step(3, "second", {2});
  ChartText chart;
  chart.step(1, "rest", {4}, true);
  chart.transition(2, "a", {1});
  chart.add("macroStep", 3, "name=\"work\"", {2}, "<body>" + inside.body() + "</body>");
  chart.transition(4, "NOT a", {3});
  LoadedChart logic(program(chart, bits));
  const std::vector<std::string> all = {"rest", "first", "second"};
  logic.set("a", true);
  logic.scan();
  EXPECT_EQ(logic.active(all), "first");
  logic.set("a", false);
  logic.scan();
  EXPECT_EQ(logic.active(all), "first") << "the macro step ends with its last step only";
  logic.set("b", true);
  logic.scan();
  EXPECT_EQ(logic.active(all), "second");
  logic.scan();
  EXPECT_EQ(logic.active(all), "rest");
}

TEST(Chart, WrongConditionsAndMacroStepsAreNamed) {
  const auto with = [](const std::string& element) {
    ChartText chart;
    chart.step(1, "rest", {2}, true);
    chart.text += element;
    return first_message(program(chart, bits));
  };
  DiagramText ladder;
  ladder.coil("q", {ladder.contact("a", {ladder.rail()})});
  const auto transition = [&](const std::string& name) {
    return "<transition localId=\"2\">" + ChartText::point({1}) + "<condition><inline name=\"" + name +
           "\">" + ladder.ladder() + "</inline></condition></transition>";
  };
  EXPECT_THAT(with(transition("go")),
              HasSubstr("nothing in the condition writes to 'go', the name of the transition"));
  EXPECT_THAT(with(transition("")), HasSubstr("the condition needs a name"));
  ChartText two;
  two.step(1, "x", {});
  two.step(2, "y", {});
  EXPECT_THAT(
      with("<transition localId=\"2\">" + ChartText::point({3}) + "</transition><macroStep localId=\"3\">" +
           ChartText::point({2}) + "<body>" + two.body() + "</body></macroStep>"),
      HasSubstr("here are 2 and 2"));
  EXPECT_THAT(with("<macroStep localId=\"2\"/>"), HasSubstr("the macro step has no body in SFC"));
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
  EXPECT_THAT(with([](ChartText& c) { c.add("leftPowerRail", 7, "", {}); }),
              HasSubstr("'leftPowerRail' is not available in a sequential function chart"));
}

}  // namespace
}  // namespace trunnion::st::chart_test
