// SPDX-License-Identifier: Apache-2.0
// The standard function blocks by scans (IEC 61131-3:2013, tables 43 to 46), and the PID of the manuals.
#include "translated.hpp"

namespace trunnion::st {
namespace {

/// `output` after each scan of `call`, in which IN is the scan's character; '1' is TRUE. Scans are 10 ms
/// apart.
std::string trace(const std::string& block, const std::string& call, const std::string& output,
                  const std::string& inputs, const std::string& others = "") {
  Translated program("VAR x, y : BOOL; b : " + block + "; END_VAR", "b(" + call + ");");
  std::string result;
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    program.set("x", inputs.substr(i, 1));
    if (!others.empty()) program.set("y", others.substr(i, 1));
    EXPECT_EQ(program.scan(), "");
    const auto value = program.get("b." + output);
    result += value == "TRUE" ? "1" : value == "FALSE" ? "0" : value + " ";
  }
  return result;
}

TEST(Bistable, SetOrResetDominates) {
  EXPECT_EQ(trace("SR", "S1 := x, R := y", "Q1", "010011", "000101"), "011011");
  EXPECT_EQ(trace("RS", "S := x, R1 := y", "Q1", "010011", "000101"), "011010");
}

TEST(Edges, LastOneScan) {
  EXPECT_EQ(trace("R_TRIG", "CLK := x", "Q", "0110100"), "0100100");
  // Table 44: Q := NOT CLK AND NOT M; M := NOT CLK; M is FALSE at the first call, which also gives an edge.
  EXPECT_EQ(trace("F_TRIG", "CLK := x", "Q", "0110100"), "1001010");
  EXPECT_EQ(trace("F_TRIG", "CLK := x", "Q", "1100"), "0010");
  EXPECT_EQ(trace("FALLING_EDGE", "CLK := x", "Q", "0110100"), "0001010");
  // As R_TRIG does at a first TRUE.
  EXPECT_EQ(trace("R_TRIG", "CLK := x", "Q", "1100"), "1000");
}

TEST(Counters, CountRisingEdges) {
  EXPECT_EQ(trace("CTU", "CU := x, R := y, PV := 2", "CV", "0101101", "0000010"), "0 1 1 2 2 0 1 ");
  EXPECT_EQ(trace("CTU", "CU := x, R := y, PV := 2", "Q", "0101101", "0000010"), "0001100");
  EXPECT_EQ(trace("CTD", "CD := x, LD := y, PV := 2", "CV", "0101010", "1000000"), "2 1 1 0 0 -1 -1 ");
  EXPECT_EQ(trace("CTD", "CD := x, LD := y, PV := 2", "Q", "0101010", "1000000"), "0001111");
  EXPECT_EQ(trace("CTUD", "CU := x, CD := y, PV := 1", "CV", "0101001", "0001010"), "0 1 1 1 1 0 1 ");
  EXPECT_EQ(trace("CTUD", "CU := x, CD := y, PV := 1", "QU", "0101001", "0001010"), "0111101");
  EXPECT_EQ(trace("CTUD", "CU := x, CD := y, PV := 1", "QD", "0101001", "0001010"), "1000010");
  // R and LD prevail over edges, R over LD; an edge that they hide is not counted afterwards.
  EXPECT_EQ(trace("CTUD", "CU := x, R := y, PV := 2", "CV", "0101011101", "0000011000"),
            "0 1 1 2 2 0 0 0 0 1 ");
  EXPECT_EQ(trace("CTUD", "CU := x, R := y, PV := 2", "QU", "0101011101", "0000011000"), "0001100000");
  EXPECT_EQ(trace("CTUD", "CU := x, R := y, PV := 2", "QD", "0101011101", "0000011000"), "1000011110");
  EXPECT_EQ(trace("CTUD", "CD := x, LD := y, PV := 2", "CV", "0101011101", "1000011000"),
            "2 1 1 0 0 2 2 2 2 1 ");
  EXPECT_EQ(trace("CTUD", "CD := x, LD := y, PV := 2", "QU", "0101011101", "1000011000"), "1000011110");
  EXPECT_EQ(trace("CTUD", "CD := x, LD := y, PV := 2", "QD", "0101011101", "1000011000"), "0001100000");
  EXPECT_EQ(trace("CTUD", "CU := x, R := y, LD := y, PV := 2", "CV", "0101", "0001"), "0 1 1 0 ");
}

// Two more edges at the limit do not pass it.
TEST(Counters, OfEveryTypeCountUpToItsLimits) {
  struct Limits {
    const char *suffix, *low, *above_low, *below_high, *high;
  };
  for (const auto& limits : {Limits{"", "-32768", "-32767", "32766", "32767"},
                             {"_INT", "-32768", "-32767", "32766", "32767"},
                             {"_DINT", "-2147483648", "-2147483647", "2147483646", "2147483647"},
                             {"_LINT", "-9223372036854775808", "-9223372036854775807", "9223372036854775806",
                              "9223372036854775807"},
                             {"_UDINT", "0", "1", "4294967294", "4294967295"},
                             {"_ULINT", "0", "1", "18446744073709551614", "18446744073709551615"}}) {
    SCOPED_TRACE(limits.suffix);
    const auto last = [&](const std::string& block, const std::string& call, const std::string& start) {
      Translated program("VAR x : BOOL; b : " + block + limits.suffix + "; END_VAR", "b(" + call + ");");
      program.set("b.CV", start);
      std::string values;
      for (const char* x : {"1", "0", "1", "0", "1"}) {
        program.set("x", x);
        EXPECT_EQ(program.scan(), "");
        if (*x == '1') values += program.get("b.CV") + " ";
      }
      return values + program.get(block == "CTUD" ? "b.QU" : "b.Q");
    };
    const auto up = std::string(limits.high) + " " + limits.high + " " + limits.high + " TRUE";
    EXPECT_EQ(last("CTU", "CU := x, PV := " + std::string(limits.high), limits.below_high), up);
    EXPECT_EQ(last("CTUD", "CU := x, PV := " + std::string(limits.high), limits.below_high), up);
    const auto down = std::string(limits.low) + " " + limits.low + " " + limits.low;
    EXPECT_EQ(last("CTD", "CD := x", limits.above_low), down + " TRUE");
    EXPECT_EQ(last("CTUD", "CD := x, PV := " + std::string(limits.high), limits.above_low), down + " FALSE");
  }
}

// Scans at 0, 10, 20 ... ms; 20 ms are reached in the second scan behind the edge.
TEST(Timers, FollowTheDiagramsOfTheStandard) {
  EXPECT_EQ(trace("TON", "IN := x, PT := T#20ms", "Q", "0111100110"), "0001100000");
  EXPECT_EQ(trace("TON", "IN := x, PT := T#20ms", "ET", "01111001"),
            "T#0ms T#0ms T#10ms T#20ms T#20ms T#0ms T#0ms T#0ms ");
  EXPECT_EQ(trace("TOF", "IN := x, PT := T#20ms", "Q", "0110000100"), "0111100111");
  EXPECT_EQ(trace("TOF", "IN := x, PT := T#20ms", "ET", "0110000"),
            "T#0ms T#0ms T#0ms T#0ms T#10ms T#20ms T#20ms ");
  EXPECT_EQ(trace("TP", "IN := x, PT := T#20ms", "Q", "0100110111"), "0110110110");
  EXPECT_EQ(trace("TP", "IN := x, PT := T#20ms", "ET", "0111100"),
            "T#0ms T#0ms T#10ms T#20ms T#20ms T#0ms T#0ms ");
  EXPECT_EQ(trace("TON", "IN := x, PT := T#0s", "Q", "010"), "010");
}

TEST(Timers, OfLtimeAreTheSame) {
  for (const char* suffix : {"_TIME", "_LTIME"}) {
    const std::string time = std::string(suffix) == "_TIME" ? "T#20ms" : "LT#20ms";
    const auto of = [&](const std::string& block, const char* inputs) {
      return trace(block + suffix, "IN := x, PT := " + time, "Q", inputs);
    };
    EXPECT_EQ(of("TON", "0111100110"), "0001100000");
    EXPECT_EQ(of("TOF", "0110000100"), "0111100111");
    EXPECT_EQ(of("TP", "0100110111"), "0110110110");
  }
  Translated program("VAR t : TON_LTIME; END_VAR", "t(IN := TRUE, PT := LT#10ms1ns);");
  program.scan(), program.scan();
  EXPECT_EQ(program.get("t.Q"), "FALSE");
  EXPECT_EQ(program.get("t.ET"), "LT#10ms");
  EXPECT_EQ(program.run.machine().next_timer_end(10000000), 10000001);
  program.scan();
  EXPECT_EQ(program.get("t.Q"), "TRUE");
}

TEST(Timers, AreKnownToTheService) {
  Translated program("VAR t : ARRAY[1..3] OF TOF; END_VAR", "t[2](IN := %X0.0, PT := T#35ms);");
  EXPECT_EQ(program.compilation.code->timers.size(), 3u);
  program.set("%X0.0", "TRUE");
  program.scan();
  EXPECT_FALSE(program.run.machine().next_timer_end(0));
  program.set("%X0.0", "FALSE");
  program.scan();  // at 10 ms
  EXPECT_EQ(program.run.machine().next_timer_end(10000000), 45000000);
  EXPECT_FALSE(program.run.machine().timer_due(44999999));
  EXPECT_TRUE(program.run.machine().timer_due(45000000));
}

// Kp 100 %, Ts 1, Ti 10, Td 2, target 1000. With e = 1000, 1000, 1000, 500, 500 the increments
// (e - e1) + Ts/Ti e + Td/Ts (e - 2 e1 + e2) are 3100, -1900, 100, -1450, 1050.
TEST(Pid, GivesTheNumbersOfTheManual) {
  Translated program(
      "VAR r AT %B420 : ARRAY[0..15] OF DINT; out AT %B44 : DINT; actual : DINT; done : BOOL; first : BOOL "
      ":= TRUE; END_VAR",
      "IF first THEN r[4] := 1; r[5] := 100; r[6] := 10; r[7] := 2; first := FALSE; END_IF;\n"
      "done := PID(S1 := 1000, S2 := actual, S3 := r, S4 := out);");
  std::string outputs;
  for (const char* actual : {"0", "0", "0", "500", "500"}) {
    program.set("actual", actual);
    EXPECT_EQ(program.scan(), "");
    outputs += program.get("out") + " ";
  }
  EXPECT_EQ(outputs, "3100 1200 1300 -150 900 ");
  EXPECT_EQ(program.get("%B431"), "500");  // S3+11, the last deviation
}

TEST(Pid, LimitsReversesFiltersAndKeepsItsPeriod) {
  Translated program(
      "VAR r : ARRAY[0..15] OF DINT := [3(0), 50, 1, 100, 0, 0, 400, -200, 0]; out, actual, target : DINT; "
      "done : BOOL; END_VAR",
      "done := PID(target, actual, r, out);");
  program.set("target", "1000");
  program.scan();
  EXPECT_EQ(program.get("out"), "400");  // e = 1000 - 0: increment 1000, limited
  program.set("actual", "2000");
  program.scan();
  // Filtered sample 0.5 * 0 + 0.5 * 2000 = 1000: e = 0, increment -1000 from 400, limited at -200.
  EXPECT_EQ(program.get("r[1]"), "1000");
  EXPECT_EQ(program.get("out"), "-200");
  program.set("r[10]", "25");  // Tc 25 ms: of the scans every 10 ms the first and then each third computes
  program.set("r[3]", "0"), program.set("r[8]", "0"), program.set("r[9]", "0");
  std::string computed;
  for (int i = 0; i < 6; ++i) program.scan(), computed += program.get("done") == "TRUE" ? "1" : "0";
  EXPECT_EQ(computed, "001001");
  Translated reverse("VAR r : ARRAY[0..15] OF DINT := [5(0), 100, 9(0), 1]; out : DINT; done : BOOL; END_VAR",
                     "done := PID(1000, 0, r, out);");
  reverse.scan();
  EXPECT_EQ(reverse.get("out"), "-1000");
}

// S3+13 is retained: another PLC, or one whose time began again, may have left any value.
TEST(Pid, ComputesWhateverTimeItsRegistersHaveKept) {
  for (const char* kept : {"5000000", "-5000000", "2147483647", "-2147483648"}) {
    Translated program("VAR r : ARRAY[0..15] OF DINT; out : DINT; done : BOOL; END_VAR",
                       "done := PID(1000, 0, r, out);");
    program.set("r[5]", "100"), program.set("r[10]", "25"), program.set("r[13]", kept);
    EXPECT_EQ(program.scan(), "");
    EXPECT_EQ(program.get("done"), "TRUE") << kept;
    EXPECT_EQ(program.get("out"), "1000") << kept;  // e - e1 = 1000
  }
}

// 2^31 ms are 2147483648 ms. Computed at 2147483640 ms, each third scan from there on is 30 ms later.
TEST(Pid, KeepsItsPeriodBeyondTwentyFiveDays) {
  Translated program("VAR r : ARRAY[0..15] OF DINT; out : DINT; done : BOOL; END_VAR",
                     "done := PID(1000, 0, r, out);");
  program.set("r[10]", "25");
  program.scan();
  std::string computed;
  for (int i = 0; i < 10; ++i) {
    EXPECT_EQ(program.scan(i == 0 ? std::int64_t{2147483640} * 1000000 : default_period), "");
    computed += program.get("done") == "TRUE" ? "1" : "0";
  }
  EXPECT_EQ(computed, "1001001001");
}

}  // namespace
}  // namespace trunnion::st
