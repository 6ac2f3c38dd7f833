// SPDX-License-Identifier: Apache-2.0
// POINTER TO, ADR, SIZEOF.
#include <gmock/gmock.h>

#include <algorithm>

#include "plc/machine/pointer.hpp"
#include "plc/machine/verify.hpp"
#include "translated.hpp"

namespace trunnion::st::pointers_test {
namespace {

using testing::HasSubstr;

constexpr const char* types = "TYPE Pt : STRUCT x, y : INT; next : POINTER TO Pt; END_STRUCT; END_TYPE\n";

TEST(Pointers, ReachVariablesOfTheirType) {
  Translated program(
      "VAR x : INT := 3; p, q : POINTER TO INT; s : Pt; ps : POINTER TO Pt; t : TON; pon : POINTER TO TON;\n"
      "done, same : BOOL; text : STRING[5]; ptext : POINTER TO STRING[5]; END_VAR",
      "p := ADR(x); p^ := p^ + 4; q := p; same := q = p AND p <> NULL AND NOT (p = 0);\n"
      "ps := ADR(s); ps^.y := 5; ps^.next := ps; ps^.next^.x := 6; pon := ADR(t);\n"
      "pon^(IN := TRUE, PT := T#0s); done := pon^.Q; ptext := ADR(text); ptext^ := CONCAT(ptext^, 'ab');",
      types);
  EXPECT_EQ(verify(*program.compilation.code), "");
  EXPECT_EQ(program.get("p"), "NULL");
  EXPECT_EQ(program.scan(), "");
  EXPECT_EQ(program.get("x") + " " + program.get("same"), "7 TRUE");
  EXPECT_EQ(program.get("s.x") + " " + program.get("s.y"), "6 5");
  EXPECT_EQ(program.get("done") + program.get("text"), "TRUE'ab'");
  EXPECT_THAT(program.get("p"), HasSubstr("byte 0 of the variable at cell "));
}

// REAL has 4 bytes: ADR(a[1]) + 4 is a[2], and so is the second element from a[1] on.
TEST(Pointers, MoveThroughArrays) {
  Translated program(
      "VAR a : ARRAY[0..3] OF REAL := [1.0, 2.0, 3.0, 4.5]; all : POINTER TO ARRAY[0..99] OF REAL;\n"
      "p : POINTER TO REAL; sum : REAL; i : INT; m : ARRAY[1..2, 1..3] OF INT; pm : POINTER TO INT;\n"
      "far : DINT; END_VAR",
      "all := ADR(a); FOR i := 0 TO 3 DO sum := sum + all^[i]; END_FOR;\n"
      "p := ADR(a[1]); p := p + SIZEOF(REAL); p^ := 7.5; all := p - 4; all^[2] := all^[1] + 1.0;\n"
      "i := 2; far := ADR(a[i + 1]) - ADR(a); pm := ADR(m[1, 1]); pm := 2 * 4 + pm; pm^ := 9;");
  EXPECT_EQ(program.scan(), "");
  EXPECT_EQ(program.get("sum"), "10.5");
  EXPECT_EQ(program.get("a"), "[1.0, 2.0, 7.5, 8.5]");
  EXPECT_EQ(program.get("far"), "12");                // three elements of 4 bytes
  EXPECT_EQ(program.get("m"), "[0, 0, 0, 0, 9, 0]");  // 8 bytes behind the first of 2 bytes: the fifth
}

// A byte 0 is the end of the text, whatever is behind it; from behind a text grows when its first byte comes.
TEST(Pointers, ReachTheBytesOfStrings) {
  Translated program(
      "VAR s : STRING[10] := 'abc'; e : STRING[8]; p : POINTER TO BYTE; all : POINTER TO ARRAY[1..10] OF "
      "BYTE;\nn, size : INT; c, behind : BYTE; cut : STRING[10] := 'abcdef'; again : STRING[10]; END_VAR",
      "p := ADR(s); p^ := 65; p := p + LEN(s); c := p^; p^ := 100; p := p + 1; p^ := 0; n := LEN(s);\n"
      "p := ADR(e) + 2; p^ := 0; p := p - 1; p^ := 66; p := p - 1; p^ := 65; size := SIZEOF(s);\n"
      "all := ADR(cut); all^[3] := 0; behind := all^[5]; again := cut; all^[3] := 99;");
  EXPECT_EQ(program.scan(), "");
  EXPECT_EQ(program.get("s") + " " + program.get("n") + " " + program.get("c"), "'Abcd' 4 0");
  EXPECT_EQ(program.get("e"), "'AB'");
  EXPECT_EQ(program.get("size"), "11");  // with the byte 0
  EXPECT_EQ(program.get("again") + " " + program.get("behind"), "'ab' 101");
  EXPECT_EQ(program.get("cut"), "'abcdef'");
}

// 1.0 is 16#3F800000, 16#40490FDB the REAL next to pi; the low byte comes first; -2 is 16#FFFE.
TEST(Pointers, ReachTheBytesOfNumbers) {
  Translated program(
      "VAR r : REAL := 1.0; pd : POINTER TO DWORD; d : DWORD; i : INT := -2; pb : POINTER TO BYTE; b, one : "
      "BYTE;\nbytes : ARRAY[0..3] OF BYTE; pw : POINTER TO WORD; w : WORD; flag : BOOL; back : DWORD := "
      "16#3F800000; pr : POINTER TO REAL; pi : POINTER TO INT; words : ARRAY[0..1] OF WORD; END_VAR",
      "pd := ADR(r); d := pd^; pd^ := 16#40490FDB; pb := ADR(i); b := pb^; pb^ := 0;\n"
      "pd := ADR(bytes); pd^ := 16#04030201; pw := ADR(bytes[1]); w := pw^; pb := ADR(flag); pb^ := 5;\n"
      "one := pb^; pr := ADR(back); pr^ := pr^ + 1.0; pi := ADR(words); pi^ := -1; pw := pi; pi := pi + 1;\n"
      "pi^ := 0;");
  EXPECT_EQ(program.scan(), "");
  EXPECT_EQ(program.get("d") + " " + program.get("r"), "1065353216 3.1415927");
  EXPECT_EQ(program.get("b") + " " + program.get("i"), "254 -256");              // 16#FE, then 16#FF00
  EXPECT_EQ(program.get("bytes") + " " + program.get("w"), "[1, 2, 3, 4] 770");  // 2 + 3 * 256
  EXPECT_EQ(program.get("flag") + " " + program.get("one"), "TRUE 1");
  EXPECT_EQ(program.get("back"), "1073741824");  // 2.0 is 16#40000000
  EXPECT_EQ(program.get("words"), "[255, 0]");   // 16#FFFF, then its high byte and the next low one are 0
}

// 'a' is 16#61 and 'A' without bit 5; bit 16 of -2 counts 65536; bit 31 of a REAL is its sign.
TEST(Pointers, ReachTheBitsOfBytes) {
  Translated program(
      "VAR text : STRING[5] := 'ab'; i : DINT := -2; r : REAL := 1.0; pb : POINTER TO BYTE; pw : POINTER TO "
      "WORD;\npd : POINTER TO DWORD; bit, sign : BOOL; w : WORD; END_VAR",
      "pb := ADR(text); bit := pb^.%X6; pb^.%X5 := FALSE; pd := ADR(i); pd^.%X16 := FALSE; pd := ADR(r);\n"
      "pd^.%X31 := TRUE; sign := pd^.%W1.%X15; pw := ADR(w); pw^.%B1 := 16#12;");
  EXPECT_EQ(program.scan(), "");
  EXPECT_EQ(program.get("bit") + program.get("text"), "TRUE'Ab'");
  EXPECT_EQ(program.get("i"), "-65538");
  EXPECT_EQ(program.get("r") + program.get("sign"), "-1.0TRUE");
  EXPECT_EQ(program.get("w"), "4608");  // 16#1200
}

TEST(Pointers, AreParametersAndResults) {
  Translated program(
      "VAR a : ARRAY[1..3] OF INT := [4, 5, 6]; total : INT; c : Count; text : STRING[20] := 'a b c';\n"
      "u : STRING[20]; END_VAR VAR_EXTERNAL g : INT; END_VAR",
      "total := sum(ADR(a), SIZEOF(a)); c(s := text); u := upper('xyZ'); middle(ADR(a))^ := 50;",
      "VAR_GLOBAL g : INT; pg : POINTER TO INT := ADR(g); END_VAR\n"
      "FUNCTION sum : INT VAR_INPUT p : POINTER TO ARRAY[0..999] OF INT; size : UINT; END_VAR\n"
      "VAR i : INT; END_VAR FOR i := 0 TO UINT_TO_INT(size / 2) - 1 DO sum := sum + p^[i]; END_FOR;\n"
      "pg^ := sum; END_FUNCTION\n"
      "FUNCTION middle : POINTER TO INT VAR_INPUT p : POINTER TO INT; END_VAR middle := p + 2; "
      "END_FUNCTION\n"
      "FUNCTION upper : STRING[20] VAR_INPUT s : STRING[20]; END_VAR VAR p : POINTER TO BYTE; i : INT; "
      "END_VAR\n"
      "upper := s; p := ADR(upper); FOR i := 1 TO LEN(s) DO IF p^ >= 97 THEN p^ := p^ AND 16#DF; END_IF;\n"
      "p := p + 1; END_FOR; END_FUNCTION\n"
      "FUNCTION_BLOCK Count VAR_IN_OUT s : STRING[20]; END_VAR VAR_OUTPUT n : INT; END_VAR\n"
      "VAR p : POINTER TO ARRAY[1..20] OF BYTE; i : INT; END_VAR p := ADR(s); n := 0;\n"
      "FOR i := 1 TO LEN(s) DO IF p^[i] = 32 THEN n := n + 1; END_IF; END_FOR; END_FUNCTION_BLOCK\n");
  EXPECT_EQ(program.scan(), "");
  EXPECT_EQ(program.get("total") + " " + program.get("g"), "15 15");
  EXPECT_EQ(program.get("c.n") + program.get("u"), "2'XYZ'");
  EXPECT_EQ(program.get("a"), "[4, 50, 6]");
}

TEST(Pointers, AreElementsBehindPointers) {
  Translated program(
      "VAR x : INT := 5; list : ARRAY[0..1] OF POINTER TO INT; all : POINTER TO ARRAY[0..1] OF POINTER TO "
      "INT;\nb : POINTER TO BYTE; low : BYTE; pp : POINTER TO POINTER TO INT; END_VAR",
      "list[1] := ADR(x); all := ADR(list); all^[1]^ := 6; b := all^[1]; low := b^; pp := ADR(list[1]);\n"
      "pp^^ := pp^^ + 1; pp^ := NULL;");
  EXPECT_EQ(program.scan(), "");
  EXPECT_EQ(program.get("x") + " " + program.get("low") + " " + program.get("list[1]"), "7 6 NULL");
}

// The PLC stops and names the place; nothing beside the variable is read or written.
TEST(Pointers, StopOutsideTheirVariable) {
  const auto fault_of = [](const std::string& use) {
    Translated program(
        "VAR x, i : INT; p : POINTER TO INT; a : ARRAY[0..3] OF REAL; all : POINTER TO ARRAY[0..99] OF REAL; "
        "r : REAL; s : STRING[10]; b : POINTER TO BYTE; times : ARRAY[0..1] OF TIME; t : POINTER TO TIME; v "
        ": TIME; whole : ARRAY[0..99] OF REAL; pts : ARRAY[0..1] OF Pt; pp : POINTER TO Pt;\n"
        "none : REF_TO INT; point : REF_TO Pt; row : REF_TO ARRAY[0..3] OF REAL; END_VAR",
        use, types);
    const auto fault = program.scan();
    EXPECT_THAT(fault, HasSubstr("t.st:5:")) << use;
    return fault;
  };
  for (const char* use :
       {"p^ := 1;", "i := p^;", "pp^.x := 1;", "r := all^[1];", "p := NULL; p := p + 2; p^ := 1;",
        "p := ADR(none^); p^ := 1;", "p := ADR(point^.y); i := p^;", "all := ADR(row^[1]); all^[0] := 1.0;"})
    EXPECT_THAT(fault_of(use), HasSubstr("a reference to no variable")) << use;
  EXPECT_THAT(fault_of("p := ADR(x) + 2; p^ := 1;"),
              HasSubstr("a pointer to byte 3 of a variable with the bytes 0 .. 1"));
  EXPECT_THAT(fault_of("p := ADR(x) - 1; i := p^;"),
              HasSubstr("a pointer to byte -1 of a variable with the bytes 0 .. 1"));
  // all^[4] is byte 16 .. 19 of 4 times 4 bytes; whole is 400 of them.
  EXPECT_THAT(fault_of("all := ADR(a); r := all^[4];"),
              HasSubstr("byte 19 of a variable with the bytes 0 .. 15"));
  EXPECT_THAT(fault_of("all := ADR(a); whole := all^;"),
              HasSubstr("byte 399 of a variable with the bytes 0 .. 15"));
  EXPECT_THAT(fault_of("all := ADR(a); i := 100; r := all^[i];"), HasSubstr("index 100 is outside 0 .. 99"));
  EXPECT_THAT(fault_of("b := ADR(s) + 10; b^ := 1;"),
              HasSubstr("byte 10 of a variable with the bytes 0 .. 9"));
  EXPECT_THAT(fault_of("b := ADR(s) + 11; b^ := b^;"),
              HasSubstr("byte 11 of a variable with the bytes 0 .. 10"));
  EXPECT_THAT(fault_of("t := ADR(times) + 1; v := t^;"),
              HasSubstr("a pointer to a variable of another type"));
  EXPECT_THAT(fault_of("pp := ADR(pts) + 1; i := pp^.x;"),
              HasSubstr("a pointer to a variable of another type"));
}

TEST(Pointers, AreRefusedWithOneClearLine) {
  const auto first = [](const std::string& statements, const std::string& before = "") {
    const auto lines =
        compile({{"t.st", before +
                              "PROGRAM main VAR p : POINTER TO INT; q : POINTER TO BYTE; t : TIME; pt : "
                              "POINTER TO TIME; ps : POINTER TO STRING; x : INT; d : DWORD; lamp AT %Y0.1 : "
                              "BOOL; pb : POINTER TO BOOL; END_VAR " +
                              statements + " ; END_PROGRAM\n"}},
                interface_registers())
            .lines();
    const auto found = std::find_if(lines.begin(), lines.end(), [](const std::string& line) {
      return line.find(": error: ") != std::string::npos;
    });
    return found == lines.end() ? std::string() : *found;
  };
  EXPECT_EQ(first("p := ADR(x); q := p; q := ADR(x); p := 0; p := NULL;"), "");
  EXPECT_THAT(first("q := ADR(t);"),
              HasSubstr("expected POINTER TO BYTE, found POINTER TO TIME; of other types"));
  EXPECT_THAT(first("pt := q;"),
              HasSubstr("expected POINTER TO TIME, found POINTER TO BYTE; of other types"));
  EXPECT_THAT(first("ps := q;"), HasSubstr("expected POINTER TO STRING[80], found POINTER TO BYTE"));
  EXPECT_THAT(first("p := x;"),
              HasSubstr("expected POINTER TO INT, found INT; a pointer is ADR of a variable"));
  EXPECT_THAT(first("p := 5;"), HasSubstr("found a number; a pointer is ADR of a variable"));
  EXPECT_THAT(first("x := p;"), HasSubstr("expected INT, found POINTER TO INT"));
  EXPECT_THAT(first("d := p;"), HasSubstr("expected DWORD, found POINTER TO INT"));
  EXPECT_THAT(first("p := ADR(5);"), HasSubstr("a variable is required"));
  EXPECT_THAT(first("pb := ADR(lamp);"), HasSubstr("registers and parts of variables have no address"));
  EXPECT_THAT(first("pb := ADR(%X0.1);"), HasSubstr("registers and parts of variables have no address"));
  EXPECT_THAT(first("pb := ADR(d.%X1);"), HasSubstr("registers and parts of variables have no address"));
  EXPECT_THAT(first("p := p * 2;"), HasSubstr("is not defined; a pointer moves by a whole number of bytes"));
  EXPECT_THAT(first("p := p + 1.5;"), HasSubstr("a pointer moves by a whole number of bytes"));
  EXPECT_THAT(first("IF p > x THEN ; END_IF;"), HasSubstr("pointers are compared with pointers and NULL"));
  EXPECT_THAT(first("x := SIZEOF(5);"), HasSubstr("SIZEOF is for variables and types"));
  EXPECT_THAT(first("x := SIZEOF();"), HasSubstr("SIZEOF has one variable"));
  EXPECT_THAT(first("", "VAR_GLOBAL RETAIN k : POINTER TO INT; END_VAR "),
              HasSubstr("RETAIN is not permitted"));
  EXPECT_THAT(first("", "TYPE P : POINTER TO Q; Q : POINTER TO ARRAY[0..1] OF P; END_TYPE "),
              HasSubstr("contains itself"));
  EXPECT_THAT(first("", "FUNCTION_BLOCK B VAR p : POINTER TO B; END_VAR p := ADR(THIS); END_FUNCTION_BLOCK "),
              HasSubstr("the size of 'B' is not known inside of it"));
  EXPECT_THAT(
      first("",
            "FUNCTION f : INT VAR_IN_OUT a : ARRAY[*] OF INT; END_VAR VAR p : POINTER TO INT; END_VAR "
            "p := ADR(a); f := p^; END_FUNCTION "),
      HasSubstr("ARRAY[*] has no pointer"));
  EXPECT_THAT(first("",
                    "FUNCTION_BLOCK B VAR p : POINTER TO INT; END_VAR METHOD m VAR i : INT; END_VAR p := "
                    "ADR(i); END_METHOD END_FUNCTION_BLOCK "),
              HasSubstr("may be gone when the pointer is used"));
  // f may keep the pointer, directly and through g.
  const std::string keeps =
      "FUNCTION f VAR_IN_OUT v : INT; END_VAR VAR p : POINTER TO INT; END_VAR p := ADR(v); END_FUNCTION "
      "FUNCTION g VAR_IN_OUT w : INT; END_VAR f(v := w); END_FUNCTION ";
  EXPECT_EQ(first("g(w := x);", keeps), "");
  EXPECT_THAT(first("", keeps + "FUNCTION_BLOCK B METHOD m VAR i : INT; END_VAR g(w := i); END_METHOD "
                                "END_FUNCTION_BLOCK "),
              HasSubstr("'i' is gone after the method, but VAR_IN_OUT 'w' has pointers"));
}

// They have one field of the same name, but of 2 and of 21 bytes.
TEST(Pointers, TellStructuresWithoutNameApart) {
  const std::string declarations =
      "VAR a : STRUCT x : INT; END_STRUCT; pa : POINTER TO STRUCT x : INT; END_STRUCT;\n"
      "b : STRUCT x : STRING[20]; END_STRUCT; pb : POINTER TO STRUCT x : STRING[20]; END_STRUCT; END_VAR\n";
  Translated program(declarations, "pa := ADR(a); pa^.x := 3; pb := ADR(b); pb^.x := 'text';");
  EXPECT_EQ(program.scan(), "");
  EXPECT_EQ(program.get("a.x") + program.get("b.x"), "3'text'");
  for (const char* wrong : {"pa := ADR(b);", "a := b;", "b := pa^;"}) {
    const auto text = "PROGRAM main " + declarations + wrong + " END_PROGRAM\n";
    EXPECT_FALSE(compile({{"t.st", text}}, interface_registers()).good()) << wrong;
  }
}

TEST(Pointers, BeginWithTheirInitialValuesInNewPrograms) {
  const auto translated = [](const std::string& more) {
    return compile({{"t.st", "PROGRAM main VAR x : INT; p : POINTER TO INT; END_VAR p := ADR(x); " + more +
                                 " END_PROGRAM\n"}},
                   interface_registers());
  };
  const auto running = translated(""), next = translated("p := p + SIZEOF(x);");
  ASSERT_TRUE(running.good() && next.good());
  const Changeover change{Variables(running), Variables(next)};
  EXPECT_THAT(change.losses(),
              testing::Contains(HasSubstr("main.p (POINTER TO INT) names a variable by its place")));
}

// A value of a pointer counts the entries of the table, so other tables are another layout.
TEST(Pointers, AreOfTheLayoutOfVariables) {
  const auto layout = [](const std::string& statements) {
    return compile({{"t.st", "PROGRAM main VAR x : WORD; y : INT; p : POINTER TO BYTE; END_VAR " +
                                 statements + " END_PROGRAM\n"}},
                   interface_registers())
        .layout();
  };
  EXPECT_EQ(layout("p := ADR(x); p := ADR(y);"), layout("p := ADR(x); p := ADR(y);"));
  EXPECT_NE(layout("p := ADR(x); p := ADR(y);"), layout("p := ADR(y); p := ADR(x);"));
}

TEST(Pointers, CountBytesWithinTheirLimits) {
  const auto pointer = pointer_cell(2000, 3);
  EXPECT_EQ(pointer_address(pointer), 2000u);
  EXPECT_EQ(pointer_number(pointer), 16000u);  // 8 for each cell
  EXPECT_EQ(pointer_offset(pointer_moved(pointer, 0xffffffffu)), -1) << "32 bits with sign";
  EXPECT_EQ(pointer_number(pointer_moved(pointer, 0xffffffffu)), 15999u);
  EXPECT_EQ(pointer_moved(pointer_moved(pointer, 0xffffffffu), 1), pointer);
  constexpr std::int64_t farthest = (1 << 27) - 1;
  EXPECT_EQ(pointer_offset(pointer_moved(pointer, 0x7fffffffu)), farthest);
  EXPECT_EQ(pointer_offset(pointer_moved(pointer, 0x80000000u)), -farthest);
  EXPECT_EQ(pointer_moved(null_pointer, 4), null_pointer);
  EXPECT_EQ(pointer_number(null_pointer), 0u);
  EXPECT_EQ(pointer_cell(most_cells, 3), null_pointer);
}

TEST(Pointers, AreVerifiedBeforeTheyRun) {
  Translated program("VAR x, i : INT; p : POINTER TO INT; END_VAR", "p := ADR(x); p^ := 1; i := p^;");
  auto code = *program.compilation.code;
  ASSERT_EQ(code.pointed.size(), 1u);
  const auto decoded = decode(encode(code));
  ASSERT_TRUE(decoded);
  EXPECT_EQ(decoded->pointed, code.pointed);
  for (const auto change :
       {+[](Pointed& p) { p.cells = 2; }, +[](Pointed& p) { p.bytes = 9; }, +[](Pointed& p) { p.form = 7; },
        +[](Pointed& p) { p.count = 0; }, +[](Pointed& p) { p.view = Pointed::View{3}; },
        +[](Pointed& p) { p.view = Pointed::View::string; }}) {
    auto other = code;
    change(other.pointed[0]);
    EXPECT_NE(verify(other), "");
  }
  // The longest STRING has 1000 bytes and the byte 0.
  for (const auto& [bytes, good] : {std::pair{1001u, true}, std::pair{1002u, false}}) {
    auto other = code;
    other.pointed.push_back({Pointed::View::string, 7, 1, 200, bytes, 0});
    EXPECT_EQ(verify(other).empty(), good) << bytes;
  }
  for (auto& in : code.code)
    if (in.op == Op::point_load) in.c = 1;
  EXPECT_THAT(verify(code), HasSubstr("has a wrong operand"));
}

}  // namespace
}  // namespace trunnion::st::pointers_test
