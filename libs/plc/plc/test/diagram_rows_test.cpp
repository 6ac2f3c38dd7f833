// SPDX-License-Identifier: Apache-2.0
// What the standard's tables of diagrams and charts have and no other test covers (libs/plc/plc/conformance).
#include <gmock/gmock.h>

#include <tuple>

#include "chart_documents.hpp"

namespace trunnion::st {
namespace {

using Pairs = std::vector<std::pair<std::string, std::string>>;

/// A document and Structured Text that are translated together.
class Drawn {
 public:
  explicit Drawn(const std::string& xml, const std::string& text = "")
      : compilation(compile({{"drawn.xml", xml}, {"t.st", text}}, interface_registers())),
        run(checked(compilation)) {}
  void scan() {
    const auto fault = run.scan("");
    EXPECT_EQ(fault.kind, FaultKind::none) << fault_line(compilation, run.machine(), fault);
  }
  std::string get(const std::string& path) { return run.get(path); }

  Compilation compilation;
  SourceRun run;
};

std::string main_of(const DiagramText& body, const Pairs& list) {
  return project(pou("main", "program", variables("localVars", list), body.blocks()));
}

/// A parameter of a block, connected with the element `from`.
std::string connected(const std::string& list, const std::string& name, const std::string& from) {
  return "<" + list + "><variable formalParameter=\"" + name + "\">" + DiagramText::point({from}) +
         "</variable></" + list + ">";
}

TEST(Plcopen, BlocksHaveNegatedInputsAndOutputs) {
  DiagramText d;
  d.out("q", {d.block("AND", "", {{"!IN1", {d.in("a")}}, {"IN2", {d.in("b")}}}, {"OUT"}) + ".OUT"});
  const auto latch =
      d.add("block", "typeName=\"SR\" instanceName=\"s\"", {},
            connected("inputVariables", "S1", d.in("b")) +
                "<inOutVariables/><outputVariables><variable formalParameter=\"Q1\" negated=\"true\">"
                "<connectionPointOut/></variable></outputVariables>");
  d.out("off", {latch + ".Q1"});
  Drawn drawn(main_of(
      d, {{"a", "<BOOL/>"}, {"b", "<BOOL/>"}, {"q", "<BOOL/>"}, {"off", "<BOOL/>"}, {"s", derived("SR")}}));
  drawn.scan();
  EXPECT_EQ(drawn.get("q") + drawn.get("off"), "FALSETRUE");
  drawn.run.set("b", "TRUE");
  drawn.scan();
  EXPECT_EQ(drawn.get("q") + drawn.get("off"), "TRUEFALSE");
}

TEST(Plcopen, InOutVariablesOfBlocksAndFunctionsAreConnected) {
  DiagramText d;
  const auto n = d.add("inOutVariable", "", {}, "<connectionPointOut/><expression>n</expression>");
  d.add("block", "typeName=\"Adder\" instanceName=\"adder\"", {},
        connected("inputVariables", "x", d.in("2")) + connected("inOutVariables", "sum", n) +
            "<outputVariables/>");
  d.y = 100;
  const auto m = d.add("inOutVariable", "", {}, "<connectionPointOut/><expression>m</expression>");
  const auto raised = d.add("block", "typeName=\"Raised\"", {},
                            "<inputVariables/>" + connected("inOutVariables", "v", m) +
                                "<outputVariables><variable formalParameter=\"Raised\"><connectionPointOut/>"
                                "</variable></outputVariables>");
  d.out("r", {raised + ".Raised"});
  Drawn drawn(
      main_of(d, {{"n", "<INT/>"}, {"m", "<INT/>"}, {"r", "<INT/>"}, {"adder", derived("Adder")}}),
      "FUNCTION_BLOCK Adder VAR_INPUT x : INT; END_VAR VAR_IN_OUT sum : INT; END_VAR\n"
      "sum := sum + x; END_FUNCTION_BLOCK\n"
      "FUNCTION Raised : INT VAR_IN_OUT v : INT; END_VAR v := v + 1; Raised := 10 * v; END_FUNCTION\n");
  drawn.scan(), drawn.scan();
  EXPECT_EQ(drawn.get("n"), "4");
  EXPECT_EQ(drawn.get("m"), "2");
  EXPECT_EQ(drawn.get("r"), "20");
}

TEST(Plcopen, InputsOfBlocksAreAssignedInANetworkBefore) {
  DiagramText d;
  d.y = 10, d.out("c.PV", {d.in("1")});
  d.y = 20;
  d.out("q", {d.block("CTU", "c", {{"CU", {d.in("TRUE")}}}, {"Q", "CV"}) + ".Q"});
  Drawn drawn(main_of(d, {{"q", "<BOOL/>"}, {"c", derived("CTU")}}));
  drawn.scan();
  EXPECT_EQ(drawn.get("q"), "TRUE");
  EXPECT_EQ(drawn.get("c.PV"), "1");
}

TEST(Plcopen, BlocksAreCalledThroughInOutAndExternalVariables) {
  const auto counting = [](const std::string& instance) {
    DiagramText d;
    d.out("n", {d.block("CTU", instance, {{"CU", {d.in("TRUE")}}}, {"CV"}) + ".CV"});
    return d.blocks();
  };
  const auto unit = [&](const std::string& name, const std::string& list, const std::string& instance) {
    return pou(name, "functionBlock",
               variables("outputVars", {{"n", "<INT/>"}}) + variables(list, {{instance, derived("CTU")}}),
               counting(instance));
  };
  Drawn drawn(project(unit("Given", "inOutVars", "c") + unit("Shared", "externalVars", "x")),
              "VAR_GLOBAL x : CTU; END_VAR\n"
              "PROGRAM main VAR g : Given; s : Shared; own : CTU; END_VAR g(c := own); s(); END_PROGRAM\n");
  drawn.scan();
  EXPECT_EQ(drawn.get("own.CV") + drawn.get("x.CV"), "11");
  EXPECT_EQ(drawn.get("g.n") + drawn.get("s.n"), "11");
}

// What the function changes does not change what was loaded before.
TEST(Plcopen, FunctionsAreInstructionsOfLists) {
  const auto list = [](const std::string& code) {
    return project(pou("main", "program", variables("localVars", {{"x", "<INT/>"}, {"r", "<INT/>"}}),
                       "<IL><xhtml>" + code + "</xhtml></IL>"));
  };
  const std::string raised =
      "FUNCTION Raised : INT VAR_IN_OUT v : INT; END_VAR v := v + 1; Raised := v; END_FUNCTION\n"
      "FUNCTION Clear VAR_IN_OUT v : INT; END_VAR v := 0; END_FUNCTION\n";
  for (const auto& [code, x, r] : {std::tuple{"LD 3\nST x\nLD x\nADD(\nRaised(v := x)\n)\nST r", "4", "7"},
                                   {"LD -9\nST x\nLD x\nABS\nMAX 4, x\nST r", "-9", "9"},
                                   {"Raised(x)\nRaised(x)\nST r", "2", "2"}}) {
    Drawn drawn(list(code), raised);
    drawn.scan();
    EXPECT_EQ(drawn.get("x"), x) << code;
    EXPECT_EQ(drawn.get("r"), r) << code;
  }
  const auto refused = [&](const std::string& code) {
    const auto lines = compile({{"drawn.xml", list(code)}, {"t.st", raised}}, interface_registers()).lines();
    for (const auto& line : lines)
      if (line.find(": error: ") != std::string::npos) return line;
    return std::string();
  };
  EXPECT_THAT(refused("LOAD x\nST r"), testing::HasSubstr("unknown instruction 'LOAD'"));
  EXPECT_THAT(refused("LD x\nLOAD r"), testing::HasSubstr("unknown instruction 'LOAD'"));
  EXPECT_THAT(refused("LOAD(x)\nST r"), testing::HasSubstr("there is no function 'LOAD'"));
  EXPECT_THAT(refused("ABS\nST r"), testing::HasSubstr("there is no current result: LD comes first"));
  EXPECT_THAT(refused("Clear(x)\nST r"), testing::HasSubstr("has no result"));
}

// The action has no qualifier: as N.
TEST(Chart, ActionsAndTransitionsMayBeInstructionListsAndBlocks) {
  const auto list = [](const std::string& code) {
    return "<IL><xhtml xmlns=\"http://www.w3.org/1999/xhtml\"><![CDATA[" + code + "]]></xhtml></IL>";
  };
  DiagramText lamp;
  lamp.out("q", {lamp.in("a")});
  ChartText chart;
  chart.step(1, "rest", {4}, true);
  chart.add("transition", 2, "", {1}, "<condition><reference name=\"go\"/></condition>");
  chart.step(3, "work", {2});
  chart.transition(4, "FALSE", {3});
  chart.action(5, 1, "<action><reference name=\"count\"/></action>");
  chart.action(6, 3, ChartText::named("N", "lamp"));
  LoadedChart logic(program(chart, {{"a", "<BOOL/>"}, {"q", "<BOOL/>"}, {"n", "<INT/>"}},
                            "<actions><action name=\"count\"><body>" + list("LD n\nADD 1\nST n") +
                                "</body></action><action name=\"lamp\"><body>" + lamp.blocks() +
                                "</body></action></actions><transitions><transition name=\"go\"><body>" +
                                list("LD n\nGT 1\nST go") + "</body></transition></transitions>"));
  logic.set("a", true);
  logic.scan();
  EXPECT_EQ(logic.active({"rest", "work"}), "rest");
  logic.scan();  // n is 2
  EXPECT_EQ(logic.active({"rest", "work"}), "work");
  EXPECT_FALSE(logic.is("q"));
  logic.scan();
  EXPECT_EQ(logic.get("n"), "3") << "once more with the step inactive";
  EXPECT_TRUE(logic.is("q"));
}

}  // namespace
}  // namespace trunnion::st
