// SPDX-License-Identifier: Apache-2.0
// PLCopen XML: the same logic in ladder, function blocks, instruction list and Structured Text does the same.
#include <gmock/gmock.h>

#include <random>

#include "checked_compilation.hpp"
#include "plc/library/register_names.hpp"
#include "plc/tools/source_run.hpp"
#include "plcopen_documents.hpp"

namespace trunnion::st {
namespace {

using testing::HasSubstr;

class Loaded {
 public:
  explicit Loaded(const std::string& xml, const std::string& text = "")
      : compilation(compile({{"logic.xml", xml}, {"t.st", text}}, interface_registers())),
        run(checked(compilation)) {}
  void scan(std::int64_t period = default_period) {
    const auto fault = run.scan("", period);
    EXPECT_EQ(fault.kind, FaultKind::none) << fault_line(compilation, run.machine(), fault);
  }
  std::string get(const std::string& path) { return run.get(path); }
  void set(const std::string& path, const std::string& value) { run.set(path, value); }

  Compilation compilation;
  SourceRun run;
};

std::vector<std::string> messages(const std::string& xml) {
  return compile({{"logic.xml", xml}}, interface_registers()).lines();
}
/// The first error.
std::string first_message(const std::string& xml) {
  for (const auto& line : messages(xml))
    if (line.find(": error: ") != std::string::npos) return line;
  return "";
}

const std::vector<std::pair<std::string, std::string>> three = {
    {"a", "<BOOL/>"}, {"b", "<BOOL/>"}, {"q", "<BOOL/>"}};

/// A program main in ladder with the BOOL variables a, b, q.
std::string ladder(const DiagramText& body, const std::string& more = "") {
  return project(pou("main", "program", variables("localVars", three) + more, body.ladder()));
}

// A random circuit: contacts in series and in parallel.
struct Circuit {
  enum class Kind { contact, series, parallel } kind = Kind::contact;
  std::string variable, edge;
  bool negated = false;
  std::vector<Circuit> parts;
};

Circuit random_circuit(std::mt19937& random, int depth, const std::vector<std::string>& names) {
  Circuit c;
  const auto choice = random() % 3;
  if (depth == 0 || choice == 0) {
    c.variable = names[random() % names.size()];
    c.negated = random() % 3 == 0;
    if (!c.negated && random() % 5 == 0) c.edge = random() % 2 == 0 ? "rising" : "falling";
    return c;
  }
  c.kind = choice == 1 ? Circuit::Kind::series : Circuit::Kind::parallel;
  for (auto n = 2 + random() % 2; n > 0; --n) c.parts.push_back(random_circuit(random, depth - 1, names));
  return c;
}

DiagramText::Sources as_ladder(const Circuit& c, DiagramText& text, DiagramText::Sources from) {
  if (c.kind == Circuit::Kind::contact)
    return {text.contact(
        c.variable, from,
        (c.negated ? "negated=\"true\"" : "") + (c.edge.empty() ? "" : " edge=\"" + c.edge + "\""))};
  if (c.kind == Circuit::Kind::series) {
    for (const auto& part : c.parts) from = as_ladder(part, text, from);
    return from;
  }
  DiagramText::Sources all;
  for (const auto& part : c.parts)
    for (const auto& one : as_ladder(part, text, from)) all.push_back(one);
  return all;
}

struct Edges {
  std::vector<std::pair<std::string, std::string>> instances;
  std::string calls;
  std::string add(const Circuit& c) {
    const auto name = "e" + std::to_string(instances.size());
    instances.emplace_back(name, c.edge == "rising" ? "R_TRIG" : "FALLING_EDGE");
    calls += name + "(CLK := " + c.variable + "); ";
    return name;
  }
};

std::string as_blocks(const Circuit& c, DiagramText& text, Edges& edges) {
  if (c.kind == Circuit::Kind::contact) {
    if (c.edge.empty()) return text.in(c.variable, c.negated ? "negated=\"true\"" : "");
    const auto name = edges.add(c);
    return text.block(edges.instances.back().second, name, {{"CLK", {text.in(c.variable)}}}, {"Q"}) + ".Q";
  }
  std::vector<std::pair<std::string, DiagramText::Sources>> inputs;
  for (const auto& part : c.parts)
    inputs.push_back({"IN" + std::to_string(inputs.size() + 1), {as_blocks(part, text, edges)}});
  return text.block(c.kind == Circuit::Kind::series ? "AND" : "OR", "", inputs, {"OUT"}) + ".OUT";
}

std::string as_text(const Circuit& c, Edges& edges) {
  if (c.kind == Circuit::Kind::contact)
    return c.edge.empty() ? (c.negated ? "NOT " : "") + c.variable : edges.add(c) + ".Q";
  std::string text = "(";
  for (const auto& part : c.parts)
    text += (text == "(" ? "" : c.kind == Circuit::Kind::series ? " AND " : " OR ") + as_text(part, edges);
  return text + ")";
}

// Coils: plain, negated, set, reset.
const char* const coil_attributes[] = {"", "negated=\"true\"", "storage=\"set\"", "storage=\"reset\""};
std::string as_assignment(int kind, const std::string& name, const std::string& value) {
  if (kind < 2) return name + " := " + (kind == 1 ? "NOT " : "") + value + ";\n";
  return "IF " + value + " THEN " + name + (kind == 2 ? " := TRUE" : " := FALSE") + "; END_IF;\n";
}

TEST(Plcopen, RandomCircuitsDoTheSameInLadderFunctionBlocksAndText) {
  int ones = 0, values = 0;
  for (unsigned seed = 0; seed < 150; ++seed) {
    std::mt19937 random(seed);
    std::vector<std::string> names = {"a", "b", "c", "d"};
    DiagramText ladder, blocks;
    Edges block_edges, text_edges;
    std::string statements;
    std::vector<std::pair<std::string, std::string>> outputs;
    const auto rail = ladder.rail();
    for (int n = 0; n < 3; ++n) {
      const auto circuit = random_circuit(random, 3, names);
      // The last coil also acts on the first output: behind the others, in all of them.
      const auto output = n == 2 && random() % 2 == 0 ? std::string("q0") : "q" + std::to_string(n);
      const auto kind = static_cast<int>(random() % 4);
      ladder.y = blocks.y = n * 100;
      ladder.coil(output, as_ladder(circuit, ladder, {rail}), coil_attributes[kind]);
      blocks.out(output, {as_blocks(circuit, blocks, block_edges)}, coil_attributes[kind]);
      text_edges.calls.clear();
      const auto value = as_text(circuit, text_edges);
      statements += text_edges.calls + as_assignment(kind, output, value);
      if (output == "q" + std::to_string(n)) outputs.emplace_back(output, "<BOOL/>"), names.push_back(output);
    }
    const auto inputs =
        variables("inputVars", {{"a", "<BOOL/>"}, {"b", "<BOOL/>"}, {"c", "<BOOL/>"}, {"d", "<BOOL/>"}});
    const auto with = [&](const Edges& edges) {
      std::vector<std::pair<std::string, std::string>> locals;
      for (const auto& [name, type] : edges.instances) locals.emplace_back(name, derived(type));
      return inputs + variables("outputVars", outputs) + variables("localVars", locals);
    };
    const auto xml =
        project(pou("Ladder", "functionBlock", with({}), ladder.ladder()) +
                pou("Blocks", "functionBlock", with(block_edges), blocks.blocks()) +
                pou("Text", "functionBlock", with(text_edges),
                    "<ST><xhtml xmlns=\"http://www.w3.org/1999/xhtml\">" + statements + "</xhtml></ST>"));
    std::string main = "PROGRAM main VAR a, b, c, d : BOOL; l : Ladder; f : Blocks; t : Text; END_VAR\n";
    for (const auto* name : {"l", "f", "t"})
      main += std::string(name) + "(a := a, b := b, c := c, d := d);\n";
    Loaded loaded(xml, main + "END_PROGRAM\n");
    for (int scan = 0; scan < 40; ++scan) {
      for (const auto* name : {"a", "b", "c", "d"})
        if (random() % 3 == 0) loaded.set(std::string("main.") + name, random() % 2 == 0 ? "TRUE" : "FALSE");
      loaded.scan();
      for (const auto& [name, type] : outputs) {
        const auto expected = loaded.get("main.t." + name);
        ++values, ones += expected == "TRUE" ? 1 : 0;
        ASSERT_EQ(loaded.get("main.l." + name), expected) << "seed " << seed << " scan " << scan << "\n"
                                                          << xml;
        ASSERT_EQ(loaded.get("main.f." + name), expected) << "seed " << seed << " scan " << scan << "\n"
                                                          << xml;
      }
    }
  }
  EXPECT_GT(ones, values / 10) << "the circuits do something";
  EXPECT_LT(ones, values * 9 / 10);
}

// The power behind a is that before the first coil has written, as on the rung.
TEST(Plcopen, PowerThatSeveralElementsTakeIsComputedOnce) {
  DiagramText d;
  const auto x = d.contact("a", {d.rail()}, "negated=\"true\"");
  d.y = 1;
  d.coil("a", {x}, "storage=\"set\"");
  d.y = 2;
  d.coil("q", {x});
  Loaded loaded(ladder(d));
  loaded.scan();
  EXPECT_EQ(loaded.get("a"), "TRUE");
  EXPECT_EQ(loaded.get("q"), "TRUE");
  loaded.scan();
  EXPECT_EQ(loaded.get("q"), "FALSE");
}

TEST(Plcopen, CoilsPassThePowerAndDetectEdges) {
  DiagramText d;
  d.coil("q", {d.coil("b", {d.contact("a", {d.rail()})}, "edge=\"rising\"")}, "edge=\"falling\"");
  Loaded loaded(ladder(d));
  std::string b, q;
  for (const char c : std::string("01101")) {
    loaded.set("a", std::string(1, c));
    loaded.scan();
    b += loaded.get("b") == "TRUE" ? '1' : '0', q += loaded.get("q") == "TRUE" ? '1' : '0';
  }
  EXPECT_EQ(b, "01001");
  EXPECT_EQ(q, "00010");
}

// A contact senses a change: there is none at the first scan, while F_TRIG has one (table 44).
TEST(Plcopen, AFallingContactIsOffAtTheFirstScan) {
  DiagramText d;
  d.coil("q", {d.contact("a", {d.rail()}, "edge=\"falling\"")});
  Loaded loaded(ladder(d));
  std::string q;
  for (const char c : std::string("00110")) {
    loaded.set("a", std::string(1, c));
    loaded.scan();
    q += loaded.get("q") == "TRUE" ? '1' : '0';
  }
  EXPECT_EQ(q, "00001");
}

TEST(Plcopen, FunctionBlocksStandInARung) {
  DiagramText d;
  const auto timer =
      d.block("TON", "t", {{"IN", {d.contact("a", {d.rail()})}}, {"PT", {d.in("T#20ms")}}}, {"Q", "ET"});
  d.coil("q", {timer + ".Q"});
  d.out("elapsed", {timer + ".ET"});
  Loaded loaded(ladder(d, variables("localVars", {{"t", derived("TON")}, {"elapsed", "<TIME/>"}})));
  loaded.set("a", "TRUE");
  loaded.scan(), loaded.scan();
  EXPECT_EQ(loaded.get("q"), "FALSE");
  EXPECT_EQ(loaded.get("elapsed"), "T#10ms");
  loaded.scan();
  EXPECT_EQ(loaded.get("q"), "TRUE");
}

// Without EN nothing is written; ENO is EN.
TEST(Plcopen, EnableHoldsBackFunctionsBlocksAndTheirOutputs) {
  DiagramText d;
  const auto power = d.contact("a", {d.rail()});
  const auto sum =
      d.block("ADD", "", {{"EN", {power}}, {"IN1", {d.in("n")}}, {"IN2", {d.in("1")}}}, {"ENO", "OUT"});
  d.out("n", {sum + ".OUT"});
  const auto count = d.block("CTU", "c", {{"EN", {sum + ".ENO"}}, {"CU", {d.in("b")}}, {"PV", {d.in("9")}}},
                             {"ENO", "Q", "CV"});
  d.out("counted", {count + ".CV"});
  d.coil("q", {count + ".ENO"});
  Loaded loaded(
      ladder(d, variables("localVars", {{"n", "<INT/>"}, {"counted", "<INT/>"}, {"c", derived("CTU")}})));
  std::string n, counted;
  for (const char c : std::string("0110101")) {
    loaded.set("a", std::string(1, c));
    loaded.set("b", loaded.get("b") == "TRUE" ? "FALSE" : "TRUE");
    loaded.scan();
    EXPECT_EQ(loaded.get("q"), c == '1' ? "TRUE" : "FALSE");
    n += loaded.get("n"), counted += loaded.get("counted");
  }
  EXPECT_EQ(n, "0122334");
  // b is 1 0 1 0 1 0 1; of the scans with EN, 2 3 5 7, it rises in 3, and is still 1 in 5 and 7.
  EXPECT_EQ(counted, "0011111");
}

// main: IF a THEN jump to done; n := n + 1; done: IF b THEN return; m := m + 1; and up to n = 5 back to
// again.
TEST(Plcopen, JumpsAndReturnsLeaveOutNetworks) {
  DiagramText d;
  const auto rail = d.rail();
  const auto label = [&](double y, const char* name) {
    d.y = y, d.add("label", std::string("label=\"") + name + "\"", {}, "");
  };
  d.y = 10, d.add("jump", "label=\"done\"", {d.contact("a", {rail})}, "");
  label(19, "again");
  d.y = 20, d.out("n", {d.block("ADD", "", {{"IN1", {d.in("n")}}, {"IN2", {d.in("1")}}}, {"OUT"})});
  d.y = 30, d.add("jump", "label=\"again\"",
                  {d.block("LT", "", {{"IN1", {d.in("n")}}, {"IN2", {d.in("5")}}}, {"OUT"})}, "");
  label(39, "done");
  d.y = 40, d.add("return", "", {d.contact("b", {rail})}, "");
  d.y = 50, d.out("m", {d.block("ADD", "", {{"IN1", {d.in("m")}}, {"IN2", {d.in("1")}}}, {"OUT"})});
  d.y = 60, d.coil("q", {rail});
  Loaded loaded(ladder(d, variables("localVars", {{"n", "<INT/>"}, {"m", "<INT/>"}})));
  loaded.set("a", "TRUE"), loaded.set("b", "TRUE");
  loaded.scan();
  EXPECT_EQ(loaded.get("n") + loaded.get("m") + loaded.get("q"), "00FALSE");
  loaded.set("b", "FALSE");
  loaded.scan();
  EXPECT_EQ(loaded.get("n") + loaded.get("m") + loaded.get("q"), "01TRUE");
  loaded.set("a", "FALSE");
  loaded.scan();
  EXPECT_EQ(loaded.get("n") + loaded.get("m"), "52");
}

TEST(Plcopen, AnEndlessLoopEndsWithAFaultAtItsPlace) {
  DiagramText d;
  d.y = 1, d.add("label", "label=\"x\"", {}, "");
  d.y = 2, d.add("jump", "label=\"x\"", {d.rail()}, "");
  const auto compilation = compile({{"logic.xml", ladder(d)}}, interface_registers());
  ASSERT_TRUE(compilation.good()) << testing::PrintToString(compilation.lines());
  SourceRun run(compilation);
  EXPECT_EQ(run.scan("").kind, FaultKind::budget);
}

// executionOrderId 1 reads what 2 has written in the scan before.
TEST(Plcopen, BlocksAreExecutedInTheOrderOfTheirNumbers) {
  const auto body = [](const char* first, const char* second) {
    DiagramText d;
    d.y = 1, d.out("b", {d.in("a")}, std::string("executionOrderId=\"") + first + "\"");
    d.y = 2, d.out("q", {d.in("b")}, std::string("executionOrderId=\"") + second + "\"");
    return project(pou("main", "program", variables("localVars", three), d.blocks()));
  };
  for (const bool later : {false, true}) {
    Loaded loaded(later ? body("2", "1") : body("1", "2"));
    loaded.set("a", "TRUE");
    loaded.scan();
    EXPECT_EQ(loaded.get("q"), later ? "FALSE" : "TRUE");
  }
}

TEST(Plcopen, ConnectorsContinueElsewhere) {
  DiagramText d;
  d.y = 50, d.add("connector", "name=\"power\"", {d.contact("a", {d.rail()})}, "");
  d.y = 10, d.coil("q", {d.add("continuation", "name=\"power\"", {}, "<connectionPointOut/>")});
  Loaded loaded(ladder(d));
  loaded.set("a", "TRUE");
  loaded.scan();
  EXPECT_EQ(loaded.get("q"), "TRUE");
}

TEST(Plcopen, FunctionsOfTheUserHaveFurtherOutputs) {
  DiagramText d;
  const auto split = d.block("Split", "", {{"v", {d.in("17")}}}, {"Split", "rest"});
  d.out("n", {split + ".Split"});
  d.out("m", {split + ".rest"});
  Loaded loaded(ladder(d, variables("localVars", {{"n", "<INT/>"}, {"m", "<INT/>"}})),
                "FUNCTION Split : INT VAR_INPUT v : INT; END_VAR VAR_OUTPUT rest : INT; END_VAR\n"
                "Split := v / 5; rest := v MOD 5; END_FUNCTION\n");
  loaded.scan();
  EXPECT_EQ(loaded.get("n") + loaded.get("m"), "32");
}

TEST(Plcopen, TypesAndVariablesOfEveryKind) {
  const std::string types =
      "<dataType name=\"Color\"><baseType><enum><values><value name=\"red\"/><value name=\"green\" "
      "value=\"5\"/>"
      "</values></enum></baseType></dataType>"
      "<dataType name=\"Percent\"><baseType><subrangeSigned><range lower=\"0\" "
      "upper=\"100\"/><baseType><INT/>"
      "</baseType></subrangeSigned></baseType><initialValue><simpleValue "
      "value=\"50\"/></initialValue></dataType>"
      "<dataType name=\"Place\"><baseType><struct><variable name=\"x\"><type><LREAL/></type><initialValue>"
      "<simpleValue value=\"1.5\"/></initialValue></variable><variable name=\"color\"><type><derived "
      "name=\"Color\"/>"
      "</type></variable></struct></baseType></dataType>";
  const std::string interface =
      "<localVars retain=\"true\"><variable name=\"hours\"><type><UDINT/></type></variable></localVars>"
      "<localVars constant=\"true\"><variable name=\"last\"><type><INT/></type><initialValue><simpleValue "
      "value=\"3\"/>"
      "</initialValue></variable></localVars>"
      "<localVars><variable name=\"list\"><type><array><dimension lower=\"0\" "
      "upper=\"last\"/><baseType><INT/></baseType>"
      "</array></type><initialValue><arrayValue><value><simpleValue value=\"7\"/></value>"
      "<value repetitionValue=\"3\"><simpleValue value=\"8\"/></value></arrayValue></initialValue></variable>"
      "<variable name=\"place\"><type><derived name=\"Place\"/></type><initialValue><structValue>"
      "<value member=\"color\"><simpleValue value=\"green\"/></value></structValue></initialValue></variable>"
      "<variable name=\"share\"><type><derived name=\"Percent\"/></type></variable>"
      "<variable name=\"text\"><type><string length=\"9\"/></type><initialValue><simpleValue value=\"'ab'\"/>"
      "</initialValue></variable>"
      "<variable name=\"door\" address=\"%IX16.0\"><type><BOOL/></type></variable></localVars>"
      "<tempVars><variable name=\"t\"><type><BOOL/></type></variable></tempVars>"
      "<externalVars><variable name=\"shared\"><type><WORD/></type></variable></externalVars>";
  Loaded loaded(project(
      pou("main", "program", interface,
          "<ST><xhtml>t := door; hours := hours + SEL(t, UDINT#1, UDINT#2);\nshared := 16#AA;</xhtml></ST>"),
      types,
      "<configuration name=\"c\"><resource name=\"r\"><globalVars><variable name=\"shared\"><type><WORD/>"
      "</type></variable></globalVars></resource></configuration>"));
  loaded.set("%X16.0", "TRUE");
  loaded.scan();
  EXPECT_EQ(loaded.get("hours"), "2");
  EXPECT_EQ(loaded.get("list[0]") + loaded.get("list[3]"), "78");
  EXPECT_EQ(loaded.get("place.x") + loaded.get("place.color"), "1.5green");
  EXPECT_EQ(loaded.get("share"), "50");
  EXPECT_EQ(loaded.get("text"), "'ab'");
  EXPECT_EQ(loaded.get("shared"), "170");
  EXPECT_EQ(loaded.compilation.code->retained.size(), 1u);
}

// ((a OR b) AND NOT q) into q, a counter by CAL, and a jump over an assignment.
TEST(Plcopen, InstructionListsInTheDocument) {
  const auto xml =
      project(pou("main", "program",
                  variables("localVars", three) +
                      variables("localVars", {{"n", "<INT/>"}, {"m", "<INT/>"}, {"c", derived("CTU")}}),
                  "<IL><xhtml>LD a\nOR b\nANDN q\nST q\n"
                  "CAL c(CU := q, PV := 3)\nLD c.CV\nMUL( n\nADD 1\n)\nST m\n"
                  "LD a\nJMPCN over\nLD n\nADD 1\nST n\n"
                  "over: LD b\nRETC\nLD m\nST m\n</xhtml></IL>"));
  Loaded loaded(xml);
  loaded.set("a", "TRUE");
  std::string q, m;
  for (int i = 0; i < 4; ++i) {
    loaded.scan();
    q += loaded.get("q") == "TRUE" ? '1' : '0', m += loaded.get("m");
  }
  EXPECT_EQ(q, "1010");
  // CV is 1 1 2 2 and n, before it is counted, 0 1 2 3: 1 * 1, 1 * 2, 2 * 3, 2 * 4.
  EXPECT_EQ(m, "1268");
  EXPECT_EQ(loaded.get("n"), "4");
}

TEST(Plcopen, ErrorsNameTheUnitTheNetworkAndTheElement) {
  DiagramText d;
  d.y = 10, d.coil("q", {d.contact("a", {d.rail()})});
  d.y = 20, d.coil("q", {d.contact("missing", {"1"})});
  const auto text = first_message(ladder(d));
  EXPECT_THAT(text, HasSubstr("logic.xml:"));
  EXPECT_THAT(
      text,
      HasSubstr("error: there is no variable 'missing' (POU 'main', network 2, contact with localId 4)"));
  // In the line of the contact.
  const auto xml = ladder(d);
  const auto line =
      1 + std::count(xml.begin(), xml.begin() + static_cast<std::ptrdiff_t>(xml.find("missing")), '\n');
  EXPECT_THAT(text, HasSubstr("logic.xml:" + std::to_string(line) + ":"));
}

TEST(Plcopen, ErrorsInTextHaveTheLineOfTheDocument) {
  const auto xml = project(pou("main", "program", "", "<ST><xhtml>\n\n  x := 1;</xhtml></ST>"));
  const auto line =
      1 + std::count(xml.begin(), xml.begin() + static_cast<std::ptrdiff_t>(xml.find("x := 1")), '\n');
  EXPECT_THAT(first_message(xml), HasSubstr("logic.xml:" + std::to_string(line) +
                                            ":3: error: there is no variable 'x' (POU 'main')"));
}

TEST(Plcopen, WhatIsWrongIsSaid) {
  const auto says = [](const std::string& xml, const std::string& text) {
    EXPECT_THAT(first_message(xml), HasSubstr(text)) << xml;
  };
  says("<project", "this is no XML document");
  says("", "this is no XML document");
  says("<html/>", "expected the element project of PLCopen XML");
  says(project(pou("main", "organism", "", "<ST/>")), "program, function or functionBlock, not 'organism'");
  says(project(pou("ma in", "program", "", "<ST/>")), "'ma in' is no name");
  says(project(pou("main", "program", "", "<CFC/>")), "a body in 'CFC' is not available");
  says(project(pou("main", "program", "", "<SFC/>")), "the chart has no step");
  says(project(pou("main", "program", variables("localVars", {{"p", "<pointer/>"}}), "<ST/>")),
       "the type 'pointer' is not available");
  const auto with = [](auto add) {
    DiagramText d;
    add(d);
    return ladder(d, variables("localVars", {{"n", "<INT/>"}}));
  };
  says(with([](auto& d) { d.coil("q", {}); }), "the coil is not connected");
  says(with([](auto& d) { d.coil("q", {"77"}); }), "there is no element with the localId '77'");
  says(with([](auto& d) { d.coil("q; a", {d.rail()}); }), "expected one value or variable, found ';'");
  says(with([](auto& d) { d.coil("q", {d.contact("n", {d.rail()})}); }), "contact with localId 2");
  says(with([](auto& d) { d.coil("q", {"2"}), d.contact("a", {"2"}); }), "the connections form a circle");
  says(with([](auto& d) { d.add("jump", "label=\"x\"", {d.rail()}, ""); }), "there is no label 'x'");
  says(with([](auto& d) { d.coil("q", {d.add("continuation", "name=\"x\"", {}, "")}); }),
       "there is no connector 'x'");
  says(with([](auto& d) {
         d.out("n", {d.block("ADD", "", {{"IN1", {"2.OUT"}}, {"IN2", {d.in("n")}}}, {"OUT"}) + ".OUT"});
       }),
       "is used before it is executed");
  says(with([](auto& d) {
         d.out("n", {d.block("ADD", "", {{"IN1", {}}, {"IN2", {d.in("n")}}}, {"OUT"})});
       }),
       "the input 'IN1' is not connected");
  says(with([](auto& d) { d.block("Nothing", "", {}, {"OUT"}); }), "there is no function 'Nothing'");
  says(with([](auto& d) { d.add("actionBlock", "", {}, ""); }), "'actionBlock' is not available");
}

}  // namespace
}  // namespace trunnion::st
