// SPDX-License-Identifier: Apache-2.0
// Words of other controls are refused by name, with what to write here.
#include "language/foreign_words.hpp"

#include <gtest/gtest.h>

#include <map>

#include "test_machine.hpp"

namespace trunnion::language::test {
namespace {

/// Tool length 1 is in the table, and the logic has M3 to M9.
Interpretation run_foreign(const std::string& program, ProgramDialect dialect = ProgramDialect::iso) {
  TestMachine machine;
  machine.lengths = {{1, 100.0}};
  machine.functions.emplace().add("3 4 5; 6; 7 8 9");
  machine.dialect = dialect;
  return run(machine, program);
}

struct Foreign {
  const char* program;
  unsigned line, column;
  const char* text;  ///< behind that of alarm 1540
};

TEST(ForeignWords, AreRefusedByNameWithWhatToWriteHere) {
  for (const Foreign& foreign : {
           Foreign{"0  BEGIN PGM PART MM\n", 1, 4, ": BEGIN, Heidenhain: post it as ISO code"},
           {"L X+10 R0 FMAX\n", 1, 1, ": L, Heidenhain: post it as ISO code"},
           {"12 L Z+100 R0 FMAX M3\n", 1, 4, ": L, Heidenhain: post it as ISO code"},
           {"PLANE SPATIAL SPA+0 SPB+30 SPC+0 STAY\n", 1, 1, ": PLANE, Heidenhain: write G68.2 or G68.3"},
           {"CYCL DEF 200 DRILLING\n", 1, 1, ": CYCL, Heidenhain: post it as ISO code"},
           {"TOOL CALL 5 Z S3000\n", 1, 1, ": TOOL, Heidenhain: post it as ISO code"},
           {"G0 X1\nQ1 = 5\n", 2, 1, ": Q1, Heidenhain: write #100=_"},
           {"N30 G1 X10 F100*\n", 1, 16, ": *, Heidenhain: post for Fanuc"},
           {"G0 X1\nN20 TRAORI\n", 2, 5, ": TRAORI, Siemens: write G43.4 H_"},
           {"trafoof\n", 1, 1, ": trafoof, Siemens: write G49"},
           {"MCALL CYCLE81(10,0,1,-5)\n", 1, 1, ": MCALL, Siemens: write G81 and others, or G66"},
           {"G0 SUPA Z0\n", 1, 4, ": SUPA, Siemens: write G53"},
           {"DIAMON\n", 1, 1, ": DIAMON, Siemens: set 04c032 = 1"},
           {"G500\n", 1, 1, ": G500, Siemens: write G54 to G59, or G53"},
           {"G505\n", 1, 1, ": G505, Siemens: write G54.1 P_"},
           {"ROT Z30\n", 1, 1, ": ROT, Siemens: write G68, G68.3"},
           {"AROT Z30\n", 1, 1, ": AROT, Siemens: write G91 G68 R_"},
           {"TRANS X10\n", 1, 1, ": TRANS, Siemens: write G52"},
           {"MSG(\"CHECK\")\n", 1, 1, ": MSG, Siemens: write a comment ( )"},
           {"R1=5\n", 1, 1, ": R1, Siemens: write #100=_"},
           {"G64 SOFT\n", 1, 5, ": SOFT, Siemens: leave it out"},
           {"ORIWKS\n", 1, 1, ": ORIWKS, Siemens: leave it out"},
           {"G2 X10 Y0 CR=5 F100\n", 1, 11, ": CR, Siemens: write R_"},
           {"G1 X=IC(5) F100\n", 1, 4, ": X, Siemens: write X[_] or X#_"},
           {"G71 G90 G17\n", 1, 1, ": G71, Siemens, NUM, Heidenhain: write G21"},
           {"G4 F2\n", 1, 1, ": G4, Siemens: write G4 P_ or X_"},
           {"IF R1>5 GOTOF NEXT\n", 1, 4, ": R1, Siemens: write #100"},
           {"G15 H1\n", 1, 5, ": H1, Okuma: write G54 to G59, G54.1 P_"},
           {"G0 Z100 G56 H02\n", 1, 13, ": H02, Okuma: write G43 H_"},
           {"VC1=5\n", 1, 1, ": VC, Okuma: write #100"},
           {"CALL OO88 X10 Y0 Z0\n", 1, 1, ": CALL, Okuma: write G68.2 and G53.1"},
           {"NOEX VC1=VC2+1\n", 1, 1, ": NOEX, Okuma: write #100=_"},
           {"IF [1 EQ 1] N100\n", 1, 13, ": N100, Okuma: write IF [_] GOTO _"},
           {"G169\n", 1, 1, ": G169, Okuma: write G43.4 H_"},
           {"G43.4 H1 P1\n", 1, 10, ": P1, Fanuc: leave it out"},
           {"G234 H1\n", 1, 1, ": G234, Haas: write G43.4 H_"},
           {"UNo. MAT. INITIAL-Z\n", 1, 1, ": UNo, Mazatrol: convert it to EIA"},
           {"L1=5\n", 1, 1, ": L1, NUM: set 04c959 = 1"},
           {"G71U1.5R0.5\n", 1, 1, ": G71, Fanuc, Haas: not on this control yet"},
           {"G70 P1 Q2 F0.1\n", 1, 1, ": G70, Fanuc, Haas: not on this control yet"},
           {"G71 P46 Q55 D0.025\n", 1, 13, ": D0.025, Fanuc, Haas: not on this control yet"},
           {"N0000 T1.1\nN0010 M6\n", 1, 7, ": T1.1, Fagor: write T_ D_"},
           {"G0 X1\nM3 P100\n", 2, 4, ": P100, Snapmaker: write M3 S_"},
           {"PRINT \"x-offset = \";#100;\"mm\"\n", 1, 1, ": PRINT, Kinetic-NC: write DPRNT[_] or #3006"},
           {"O0001\n[BILLET X58.74 Z125\n", 2, 1, ": [, Denford: put the line in brackets ( )"},
           {": (PGM, NAME=\"1001\")\n; T1\n: G90\nG17\n", 1, 1, ": :, Acramatic: write O_ or N_"},
       }) {
    const Interpretation result = run_foreign(foreign.program);
    SCOPED_TRACE(foreign.program);
    ASSERT_EQ(result.last, Step::alarm);
    EXPECT_EQ(result.alarm.number, AlarmNumber::foreign_word) << result.alarm.text.data();
    EXPECT_EQ(result.alarm.line, foreign.line);
    EXPECT_EQ(result.alarm.column, foreign.column);
    EXPECT_EQ(std::string(result.alarm.text.data()),
              std::string(alarm_text(AlarmNumber::foreign_word)) + foreign.text);
    EXPECT_NE(result.alarm.foreign, nullptr);
  }
}

TEST(ForeignWords, AnMCodeKeepsItsAlarmWhichNamesTheParameters) {
  const Interpretation result = run_foreign("G0 X1 M128\n");
  EXPECT_EQ(result.alarm.number, AlarmNumber::unknown_m);
  EXPECT_TRUE(result.commands.empty());
  EXPECT_EQ(std::string(result.alarm.text.data()),
            std::string(alarm_text(AlarmNumber::unknown_m)) + ": M128, Heidenhain: write G43.4 H_");
  TestMachine machine;
  machine.functions.emplace().add("128");
  EXPECT_EQ(run(machine, "M128\n").alarm.number, AlarmNumber::none) << "the logic of the machine has it";
}

TEST(ForeignWords, OtherFaultsKeepTheirAlarm) {
  using enum AlarmNumber;
  for (const auto& [program, number] : {std::pair{"#1=2+*3\n", operand_missing},
                                        {"H1\n", unused_word},
                                        {"G90 H1\n", unused_word},
                                        {"G1 X1 F1 R5\n", unused_word},
                                        {"G4\n", missing_word},
                                        {"G71 X0 Y0 I10 J0 P15 K4\n", pattern_without_cycle},
                                        {"DO #1\n", number_missing},
                                        {"G0 X Y1\n", number_missing},
                                        {"TRAORIX\n", unknown_instruction},
                                        {"G3.7\n", unknown_g},
                                        {"M999\n", unknown_m},
                                        {"G0 X1 @5\n", unknown_character}}) {
    const Interpretation result = run_foreign(program);
    EXPECT_EQ(result.alarm.number, number) << program;
    EXPECT_EQ(result.alarm.foreign, nullptr) << program;
  }
}

TEST(ForeignWords, NumProgramsHaveTheirOwnAlarms) {
  const Interpretation result = run_foreign("%1\nTRAORI\n", ProgramDialect::num);
  EXPECT_EQ(result.last, Step::alarm);
  EXPECT_NE(result.alarm.number, AlarmNumber::foreign_word);
}

/// A line with the word of the row, and `with` before it.
std::string sample_of(const ForeignWord& row) {
  // Where the word alone is none, or something else.
  static const std::map<std::string_view, std::string> special = {
      {"*", "X1*"}, {"R#", "IF R1"}, {"P#", "G43.4 H1 P1"}, {"L#", "G43.4 H1 L1"}, {"Q#", "G43.5 H1 Q1"}};
  const auto found = special.find(row.word);
  if (found != special.end() && !row.with.starts_with('M')) return found->second;
  if (row.with.size() == 1) return std::string(row.word) + " " + std::string(row.with) + "1";
  std::string line;
  const auto add = [&](std::string_view pattern) {
    for (const char c : pattern)
      if (c != '^') line += c == '#' ? '1' : c == '?' ? '5' : c == '@' ? 'X' : c;
  };
  if (!row.with.empty() && row.with.front() != '-') {
    add(row.with);
    line += ' ';
  }
  add(row.word);
  return line;
}

TEST(ForeignWords, EveryRowIsFoundByItsWord) {
  for (const ForeignWord& row : foreign_words) {
    const std::string line = sample_of(row);
    const Interpretation result = run_foreign(line + "\n");
    EXPECT_EQ(result.alarm.foreign, &row)
        << line << ": " << result.alarm.text.data() << ", the row of "
        << (result.alarm.foreign == nullptr ? "nothing" : std::string(result.alarm.foreign->word));
    EXPECT_NE(std::string(result.alarm.text.data()).find(row.shown), std::string::npos) << line;
  }
}

TEST(ForeignWords, MCodesByTheirNumber) {
  ASSERT_NE(foreign_m(128), nullptr);
  EXPECT_EQ(foreign_m(128)->word, "M128");
  EXPECT_EQ(foreign_m(8), nullptr);
  EXPECT_EQ(foreign_m(12), nullptr) << "a part of M128";
}

}  // namespace
}  // namespace trunnion::language::test
