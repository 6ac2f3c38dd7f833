// SPDX-License-Identifier: Apache-2.0
// Wrong programs: the place and the sentence of the first error.
#include <gmock/gmock.h>

#include "plc/compile.hpp"
#include "plc/library/register_names.hpp"

namespace trunnion::st {
namespace {

struct Wrong {
  bool body;  ///< statements of line 3 of a program with the declarations below
  const char* text;
  const char* message;  ///< line:column: error: sentence
};

constexpr const char* program_before =
    "FUNCTION twice : INT VAR_INPUT v : INT; END_VAR twice := 2 * v; END_FUNCTION "
    "TYPE Point : STRUCT x, y : INT; END_STRUCT; Color : (red, green); END_TYPE\n"
    "PROGRAM main VAR i : INT; d : DINT; u : UINT; ul : ULINT; b : BOOL; w : WORD; by1 : BYTE; r : REAL; l : "
    "LREAL; "
    "t : TIME; s : STRING[5]; a : ARRAY[0..3] OF INT; m : ARRAY[1..2,1..2] OF INT; p : Point; c : Color; "
    "ton1 : TON; "
    "sub : INT (0..10); END_VAR VAR CONSTANT k : INT := 4; END_VAR\n";

const Wrong programs[] = {
    {true, "x := 1;", "3:1: error: there is no variable 'x'"},
    {true, "i := ;", "3:6: error: expected a value or a variable, found ';'"},
    {true, "i = 1;", "3:3: error: expected ':=' (an assignment; '=' compares), found '='"},
    {true, "i := 1", "3:7: error: expected ';' at the end of the statement, found 'END_PROGRAM'"},
    {true, "i := 1 + ;", "3:10: error: expected a value or a variable, found ';'"},
    {true, "i := (1 + 2;", "3:12: error: expected ')' behind the expression, found ';'"},
    {true, "i := 1.5;", "3:6: error: expected a whole number (INT), found a number with a decimal point"},
    {true, "i := d;", "3:6: error: expected INT, found DINT; convert with DINT_TO_INT"},
    {true, "i := TRUE;", "3:6: error: expected INT, found BOOL; convert with BOOL_TO_INT"},
    {true, "b := 1 + 1;", "3:8: error: BOOL is TRUE or FALSE, not 2"},
    {true, "b := i;", "3:6: error: expected BOOL, found INT; compare: value <> 0"},
    {true, "i := u;", "3:6: error: expected INT, found UINT; convert with UINT_TO_INT"},
    {true, "u := -1;", "3:6: error: -1 is outside 0 .. 65535 of UINT"},
    {true, "i := 40000;", "3:6: error: 40000 is outside -32768 .. 32767 of INT"},
    {true, "by1 := 256;", "3:8: error: 256 is outside 0 .. 255 of BYTE"},
    {true, "r := d;", "3:6: error: expected REAL, found DINT; convert with DINT_TO_REAL"},
    {true, "r := l;", "3:6: error: expected REAL, found LREAL; convert with LREAL_TO_REAL"},
    {true, "r := 1.0e60;", "3:6: error: the value is too large for REAL; use LREAL"},
    {true, "t := 5;", "3:6: error: expected TIME, found a number; write a time with its unit: T#100ms"},
    {true, "t := T#5x;",
     "3:6: error: T#5x: a time has numbers with the units d, h, m, s, ms, us, ns, the largest first, as "
     "T#1h30m or T#2.5s"},
    {true, "t := T#1s1h;",
     "3:6: error: T#1s1h: a time has numbers with the units d, h, m, s, ms, us, ns, the largest first, as "
     "T#1h30m or T#2.5s"},
    {true, "i := 'a';", "3:6: error: expected INT, found STRING[1]"},
    {true, "s := 5;", "3:6: error: expected STRING[5], found a number"},
    {true, "s := i + 'a';", "3:8: error: '+' is for numbers, not for STRING[1]"},
    {true, "b := i AND b;", "3:8: error: 'AND' between INT and BOOL is not defined"},
    {true, "i := i AND 3;", "3:8: error: AND is for BOOL and bit strings, not for INT"},
    {true, "i := b + 1;", "3:8: error: '+' is for numbers, not for BOOL; convert with BOOL_TO_USINT"},
    {true, "i := w + 1;", "3:8: error: '+' is for numbers, not for WORD; convert with WORD_TO_UINT"},
    {true, "d := ul + d;",
     "3:9: error: '+' between ULINT and DINT is not defined; convert one side, as with DINT_TO_ULINT"},
    {true, "b := ul > 2.5;",
     "3:9: error: '>' between ULINT and LREAL is not defined; convert one side, as with LREAL_TO_ULINT"},
    {true, "l := 2.5 * ul;",
     "3:10: error: '*' between LREAL and ULINT is not defined; convert one side, as with ULINT_TO_LREAL"},
    {true, "b := s = 1;", "3:8: error: '=' is for elementary values, not for STRING[5]"},
    {true, "b := p = p;", "3:8: error: '=' is for elementary values, not for Point"},
    {true, "b := c < red;", "3:8: error: enumerated values are compared by = and <> only"},
    {true, "b := c = 1;", "3:8: error: '=' between Color and a whole number is not defined"},
    {true, "c := yellow;", "3:6: error: there is no variable 'yellow'"},
    {true, "c := Color#yellow;", "3:12: error: Color has no value 'yellow'"},
    {true, "c := 1;", "3:6: error: expected Color, found a number"},
    {true, "a[4] := 1;", "3:3: error: index 4 is outside 0 .. 3 of the array"},
    {true, "a[1,1] := 1;", "3:2: error: the array has 1 dimension, not 2"},
    {true, "m[1] := 1;", "3:2: error: the array has 2 dimensions, not 1"},
    {true, "a[b] := 1;", "3:3: error: an index is a whole number, not BOOL"},
    {true, "i[0] := 1;", "3:2: error: INT is no array and has no index"},
    {true, "a := 1;", "3:6: error: expected ARRAY[0..3] OF INT, found a number"},
    {true, "p := a;", "3:6: error: expected Point, found ARRAY[0..3] OF INT"},
    {true, "p.z := 1;", "3:3: error: Point has no field 'z'"},
    {true, "i.x := 1;", "3:3: error: INT has no members; '.x' needs a structure or a function block"},
    {true, "k := 5;", "3:1: error: 'k' is a constant and cannot be written"},
    {true, "1 := i;", "3:1: error: expected a statement, found '1'"},
    {true, "twice(1) := 2;", "3:1: error: a call cannot be assigned to"},
    {true, "twice := 2;", "3:1: error: 'twice' is no variable; a function is called with parentheses"},
    {true, "i := twice();", "3:6: error: 'twice' needs a value for 'v'"},
    {true, "i := twice(1, 2);", "3:15: error: 'twice' has fewer parameters than arguments"},
    {true, "i := twice(w := 1);", "3:12: error: 'twice' has no parameter 'W'"},
    {true, "i := twice('a');", "3:12: error: expected INT, found STRING[1]"},
    {true, "i := twice(EN := i, 1);",
     "3:18: error: the condition of EN is BOOL, not INT; compare: value <> 0"},
    {true, "i := twice(EN := b, EN := b, 1);", "3:21: error: EN has two values"},
    {true, "i := twice(1, ENO => i);", "3:22: error: expected INT, found BOOL; convert with BOOL_TO_INT"},
    {true, "i := twise(1);", "3:6: error: there is no function 'twise'"},
    {true, "i := ton1;", "3:6: error: expected INT, found TON"},
    {true, "ton1.Q := TRUE;",
     "3:6: error: this output of a function block is set by the block alone and cannot be written"},
    {true, "ton1.M := TRUE;", "3:6: error: 'M' is inside TON; only its inputs and outputs are accessible"},
    {true, "ton1(IN := 1 + 1);", "3:14: error: BOOL is TRUE or FALSE, not 2"},
    {true, "ton1(XX := TRUE);", "3:6: error: 'TON' has no parameter 'XX'"},
    {true, "ton1(NOT ET => t);", "3:6: error: NOT is for BOOL and bit strings, not for TIME"},
    {true, "ton1(NOT IN => b);", "3:6: error: 'IN' is an input: write := value"},
    {true, "ton1(IN => b);", "3:6: error: 'IN' is an input: write := value"},
    {true, "ton1(Q := b);", "3:6: error: 'Q' is an output: write => variable"},
    {true, "ton1 := ton1;", "3:1: error: a function block cannot be assigned to; set its inputs"},
    {true, "TON(IN := b);",
     "3:1: error: 'TON' is a function block: declare an instance, name : TON; and call name(...)"},
    {true, "i := TON;", "3:6: error: 'TON' is a function block: declare an instance, name : TON;"},
    {true, "IF i THEN d := 1; END_IF;",
     "3:4: error: the condition of IF is BOOL, not INT; compare: value <> 0"},
    {true, "IF b := TRUE THEN d := 1; END_IF;",
     "3:6: error: expected THEN behind the condition ('=' compares, ':=' assigns), found ':='"},
    {true, "IF b d := 1; END_IF;", "3:6: error: expected THEN behind the condition of IF, found 'd'"},
    {true, "IF b THEN d := 1;", "4:1: error: expected END_IF at the end of IF, found 'END_PROGRAM'"},
    {true, "WHILE 1 DO d := 1; END_WHILE;", "3:7: error: the condition of WHILE is BOOL, not a whole number"},
    {true, "REPEAT d := 1; UNTIL i END_REPEAT;",
     "3:22: error: the condition of UNTIL is BOOL, not INT; compare: value <> 0"},
    {true, "FOR r := 1 TO 2 DO d := 1; END_FOR;", "3:5: error: the variable of FOR is an integer, not REAL"},
    {true, "FOR i := 1 TO 5 BY 0 DO d := 1; END_FOR;",
     "3:20: error: the step of FOR is 0: the loop would never end"},
    {true, "FOR i := 1 TO 'a' DO d := 1; END_FOR;", "3:15: error: expected INT, found STRING[1]"},
    {true, "FOR k := 1 TO 2 DO d := 1; END_FOR;", "3:5: error: 'k' is a constant and cannot be written"},
    {true, "CASE r OF 1: d := 1; END_CASE;",
     "3:6: error: the selector of CASE is an integer, a bit string or an enumeration, not REAL"},
    {true, "CASE i OF 1: d := 1; 1: d := 2; END_CASE;", "3:22: error: the value 1 is in two cases"},
    {true, "CASE i OF 5..3: d := 1; END_CASE;", "3:11: error: the range 5 .. 3 is empty"},
    {true, "CASE i OF d: d := 1; END_CASE;", "3:11: error: a value of CASE is a constant"},
    {true, "EXIT;", "3:1: error: EXIT is permitted in a loop only"},
    {true, "CONTINUE;", "3:1: error: CONTINUE is permitted in a loop only"},
    {true, "i := 5 / 0;", "3:8: error: division by zero"},
    {true, "i := SINT#200;", "3:11: error: 200 is outside -128 .. 127 of SINT"},
    {true, "i := 2#12;", "3:9: error: the digit '2' does not exist in base 2"},
    {true, "i := 99999999999999999999;",
     "3:6: error: the number is larger than 64 bits (18446744073709551615)"},
    {true, "s := 'abc;", "3:6: error: the string is not closed: write ' behind it"},
    {true, "s := '$Q';", "3:7: error: '$' begins $$, $', $\", $L, $N, $P, $R, $T or two hexadecimal digits"},
    {true, "i := @;", "3:6: error: unexpected character '@'"},
    {true, "{VERSION 2.0} i := 1;", "3:1: error: there are no pragmas in braces; write a comment, (* *)"},
    {true, "(* never", "3:1: error: the comment is not closed: write *) behind it"},
    {true, "d := 1; (* outer (* inner *)",
     "3:9: error: the comment is not closed: write *) behind it, or behind the one that begins in it at "
     "3:18"},
    {true, "b := w.%X16;", "3:8: error: %X16 is outside WORD, which has the parts 0 .. 15 of this size"},
    {true, "b := i.%X0;", "3:8: error: a part is of BYTE, WORD, DWORD or LWORD, not of INT"},
    {true, "b := %X0.8;", "3:6: error: '%X0.8': the bit is outside 0 .. 7"},
    {true, "b := %Z0.0;",
     "3:6: error: '%Z0.0': the areas are X Y F G R B W D T C K P, and I Q M of the standard"},
    {true, "i := %X512;", "3:6: error: '%X512': the number is outside 0 .. 511"},
    {true, "b := %G300;", "3:6: error: expected BOOL, found UINT; compare: value <> 0"},
    {true, "i := SHL(3, 1);", "3:6: error: SHL needs a typed literal, as WORD#16#FF"},
    {true, "r := SQRT(b);", "3:6: error: SQRT is for REAL and LREAL, not for BOOL"},
    {true, "i := LEN(5);", "3:6: error: argument 1 of LEN is a string, not a whole number"},
    {true, "i := MAX(i);", "3:6: error: MAX has 2 or more arguments, not 1"},
    {true, "s := LEFT(s);", "3:6: error: LEFT has 2 arguments, not 1"},
    {true, "b := NOT i;", "3:6: error: NOT is for BOOL and bit strings, not for INT"},
    {true, "i := -b;", "3:6: error: '-' is for numbers and times, not for BOOL"},
    {true, "u := -u;",
     "3:6: error: '-' would leave UINT, which has no negative values; convert to a signed type"},
    {true, "sub := 11;", "3:8: error: 11 is outside 0 .. 10 of INT (0..10)"},
    {true, "i := INT_TO_FOO(1);", "3:6: error: there is no function 'INT_TO_FOO'"},
    {true, "w := REAL_TO_WORD(r);",
     "3:6: error: there is no conversion from REAL to WORD; REAL and DWORD, LREAL and LWORD exchange their "
     "bits, "
     "integers their value"},
    {true, "r := LWORD_TO_REAL(16#0);",
     "3:6: error: there is no conversion from LWORD to REAL; REAL and DWORD, LREAL and LWORD exchange their "
     "bits, "
     "integers their value"},
    {true, "w := TRUNC_WORD(r);", "3:6: error: TRUNC gives an integer, not WORD"},
    {true, "i := BCD_TO_INT(w);",
     "3:6: error: decimal digits are converted between BYTE .. LWORD and USINT .. ULINT, not from WORD to "
     "INT"},
    {true, "w := TO_BCD_WORD(i);",
     "3:6: error: decimal digits are converted between BYTE .. LWORD and USINT .. ULINT, not from INT to "
     "WORD"},
    {true, "b := IS_VALID(i);", "3:6: error: IS_VALID is for REAL and LREAL, not for INT"},
    {true, "b := IS_VALID_BCD(u);", "3:6: error: IS_VALID_BCD is for BYTE .. LWORD, not for UINT"},
    {true, "i := TO_BIG_ENDIAN(1);", "3:6: error: TO_BIG_ENDIAN needs a typed literal, as WORD#16#FF"},
    {true, "s := TO_BIG_ENDIAN(s);",
     "3:6: error: TO_BIG_ENDIAN is for integers, bit strings, REAL, LREAL and times, not for STRING[5]"},
    {true, "i := ADD_INT(i, d);", "3:17: error: expected INT, found DINT; convert with DINT_TO_INT"},
    {true, "i := ADD_FOO(i, d);", "3:6: error: there is no function 'ADD_FOO'"},
    {true, "b := AND(b);", "3:6: error: AND has 2 or more arguments, not 1"},
    {true, "i := MOD(i, i, i);", "3:6: error: MOD has 2 arguments, not 3"},
    {true, "b := OR(IN1 := b, IN3 := b);",
     "3:19: error: OR has no free parameter for this argument; they are IN1 .. IN2"},
    {true, "i := p.x.y;", "3:10: error: INT has no members; '.y' needs a structure or a function block"},
    {true, "i := ABS(s);", "3:6: error: ABS is for numbers, not for STRING[5]"},
    {true, "d := d MOD r;", "3:8: error: MOD is for integers, not for LREAL"},
    {true, "ASSERT_TRUE(b);", "3:1: error: ASSERT_TRUE is for TEST only"},
    {true, "i := [1, 2];", "3:6: error: expected a value or a variable, found '['"},
    {true, "INT := 1;", "3:1: error: there is no variable 'INT'"},
    {true, "t := t * t;", "3:8: error: '*' between TIME and TIME is not defined"},
    {true, "t := t + 1;", "3:8: error: '+' between TIME and a whole number is not defined"},
    {false, "VAR i : INT; END_VAR",
     "1:1: error: expected PROGRAM, FUNCTION, FUNCTION_BLOCK, TEST, TYPE, VAR_GLOBAL or CONFIGURATION, found "
     "'VAR'"},
    {false, "PROGRAM main VAR i : INT; i := 1; END_PROGRAM",
     "1:29: error: expected ':' before the type of the variable, found ':='"},
    {false, "PROGRAM main VAR i : INTT; END_VAR END_PROGRAM", "1:22: error: there is no type 'INTT'"},
    {false, "PROGRAM main VAR i, i : INT; END_VAR i := 1; END_PROGRAM",
     "1:21: error: the variable 'i' is declared already in line 1"},
    {false, "PROGRAM main VAR i : INT := 'a'; END_VAR i := 1; END_PROGRAM",
     "1:29: error: expected INT, found STRING[1]"},
    {false, "PROGRAM main VAR a : ARRAY[5..1] OF INT; END_VAR a[1] := 1; END_PROGRAM",
     "1:28: error: the lower limit 5 is above the upper limit 1"},
    {false, "PROGRAM main VAR n : INT; a : ARRAY[1..n] OF INT; END_VAR a[1] := n; END_PROGRAM",
     "1:40: error: a constant is required here: a literal, a VAR CONSTANT or their combination"},
    {false, "PROGRAM main VAR a : ARRAY[1..2] OF INT := [1, 2, 3]; END_VAR a[1] := 1; END_PROGRAM",
     "1:44: error: more initial values than the 2 elements of the array"},
    {false, "PROGRAM main VAR x AT %X0.0 : INT; END_VAR x := 1; END_PROGRAM",
     "1:23: error: a bit is BOOL, not INT"},
    {false, "PROGRAM main VAR x AT %X0 : BOOL; END_VAR x := TRUE; END_PROGRAM",
     "1:23: error: %X0 is a register of 8 bits and cannot be BOOL"},
    {false, "PROGRAM main VAR x AT %G300 : DINT; END_VAR x := 1; END_PROGRAM",
     "1:23: error: %G300 is a register of 16 bits and cannot be DINT; it can be UINT or another integer or "
     "bit string of this size"},
    {false, "PROGRAM main VAR x AT Q0 : BOOL; END_VAR x := TRUE; END_PROGRAM",
     "1:23: error: expected an address like %R10.0 behind AT, found 'Q0'"},
    {false, "PROGRAM main VAR CONSTANT c : INT; END_VAR END_PROGRAM",
     "1:27: error: the constant 'c' has no value: write := value"},
    {false, "PROGRAM main VAR IF : INT; END_VAR END_PROGRAM",
     "1:18: error: 'IF' is a keyword and cannot be the name of a variable"},
    {false, "PROGRAM main VAR 1a : INT; END_VAR END_PROGRAM",
     "1:18: error: expected the name of a variable, found '1'"},
    {false, "PROGRAM main VAR s : STRING[0]; END_VAR s := ''; END_PROGRAM",
     "1:22: error: the length of a string is 1 .. 1000, not 0"},
    {false, "PROGRAM main VAR s : STRING; END_VAR s := \"a\"; END_PROGRAM",
     "1:43: error: expected STRING[80], found WSTRING[1]; convert with WSTRING_TO_STRING"},
    {false, "PROGRAM main : INT END_PROGRAM",
     "1:14: error: expected declarations (only a function has a result type), found ':'"},
    {false, "PROGRAM a END_PROGRAM PROGRAM A END_PROGRAM", "1:31: error: 'A' is declared already in line 1"},
    {false, "FUNCTION f : INT f := f(1); END_FUNCTION",
     "1:23: error: 'f' calls or contains itself; recursion is not permitted (IEC 61131-3, 6.6.1)"},
    {false, "FUNCTION f : INT VAR RETAIN n : INT; END_VAR f := n; END_FUNCTION",
     "1:18: error: a function keeps nothing: RETAIN is not permitted"},
    {false, "FUNCTION f : INT VAR t : TON; END_VAR f := 1; END_FUNCTION",
     "1:22: error: a function keeps nothing, so it cannot contain the function block 't'; pass it as "
     "VAR_IN_OUT"},
    {false, "FUNCTION_BLOCK B VAR b : B; END_VAR b(); END_FUNCTION_BLOCK",
     "1:26: error: 'B' calls or contains itself; recursion is not permitted (IEC 61131-3, 6.6.1)"},
    {false, "FUNCTION_BLOCK TON END_FUNCTION_BLOCK",
     "1:16: error: 'TON' is declared already in the standard library"},
    {false,
     "PROGRAM main VAR_INPUT EN : BOOL; END_VAR VAR n : INT; END_VAR IF EN THEN n := 1; END_IF; END_PROGRAM "
     "TEST 'a' main(EN := TRUE); END_TEST",
     "1:112: error: a program is called without arguments; assign program.variable before"},
    {false, "FUNCTION_BLOCK B VAR_INPUT i : INT R_EDGE; END_VAR END_FUNCTION_BLOCK",
     "1:36: error: R_EDGE and F_EDGE are for VAR_INPUT of programs and function blocks, and for BOOL"},
    {false, "FUNCTION F : INT VAR_INPUT i : BOOL F_EDGE; END_VAR F := 1; END_FUNCTION",
     "1:37: error: R_EDGE and F_EDGE are for VAR_INPUT of programs and function blocks, and for BOOL"},
    {false, "VAR_GLOBAL g : BOOL R_EDGE; END_VAR",
     "1:21: error: R_EDGE and F_EDGE are for VAR_INPUT of programs and function blocks, and for BOOL"},
    {false, "FUNCTION_BLOCK B VAR_INPUT i : BOOL R_EDGE; END_VAR i := TRUE; END_FUNCTION_BLOCK",
     "1:53: error: this output of a function block is set by the block alone and cannot be written"},
    {false, "FUNCTION ABS : INT ABS := 1; END_FUNCTION", "1:10: error: 'ABS' is a standard function"},
    {false, "TYPE T1 : STRUCT a : T1; END_STRUCT; END_TYPE", "1:6: error: the type 'T1' contains itself"},
    {false, "TYPE INT : DINT; END_TYPE", "1:6: error: 'INT' is a type of the standard"},
    {false, "TYPE C : (a, a); END_TYPE", "1:14: error: the enumerated value 'a' is declared twice"},
    {false, "TYPE S : INT (10..1); END_TYPE", "1:10: error: the lower limit 10 is above the upper limit 1"},
    {false, "TYPE L : REAL (low := 1); END_TYPE",
     "1:10: error: named values are of an integer or bit string of at most 32 bits, not of 'REAL'"},
    {false, "TYPE L : LINT (low, high); END_TYPE",
     "1:10: error: named values are of an integer or bit string of at most 32 bits, not of 'LINT'"},
    {false, "TYPE L : SINT (low := 200); END_TYPE", "1:23: error: 200 is outside -128 .. 127 of SINT"},
    {false, "TYPE L : SINT (low := 127, high); END_TYPE",
     "1:28: error: 128 of 'high' is outside -128 .. 127 of SINT"},
    {false, "TYPE S : REAL (1..2); END_TYPE", "1:10: error: a subrange is of an integer type, not of REAL"},
    {false, "TYPE S : STRUCT END_STRUCT; END_TYPE", "1:10: error: a structure has at least one field"},
    {false, "PROGRAM main VAR_EXTERNAL g : INT; END_VAR g := 1; END_PROGRAM",
     "1:27: error: there is no global variable 'g'"},
    {false, "VAR_GLOBAL g : DINT; END_VAR PROGRAM main VAR_EXTERNAL g : INT; END_VAR g := 1; END_PROGRAM",
     "1:56: error: the global variable 'g' has the type DINT, not INT"},
    {false, "VAR_GLOBAL g : INT; g : INT; END_VAR", "1:21: error: the global variable 'g' is declared twice"},
    {false, "PROGRAM main",
     "1:13: error: expected END_PROGRAM at the end of a program, found the end of the file"},
    {false, "PROGRAM main other(); END_PROGRAM PROGRAM other END_PROGRAM",
     "1:14: error: the program 'other' is run by its task; only a TEST calls it"},
    {false,
     "FUNCTION twice : INT VAR_INPUT v : INT; END_VAR twice := 2 * v; END_FUNCTION FUNCTION_BLOCK Blk "
     "VAR_INPUT e : BOOL; END_VAR VAR_OUTPUT q : BOOL; END_VAR VAR_IN_OUT z : INT; END_VAR VAR h : INT; "
     "END_VAR q := e; z := z + h; END_FUNCTION_BLOCK PROGRAM main VAR x : Blk; END_VAR x(e := TRUE); "
     "END_PROGRAM",
     "1:276: error: VAR_IN_OUT 'z' of 'Blk' needs a variable in every call"},
    {false,
     "FUNCTION twice : INT VAR_INPUT v : INT; END_VAR twice := 2 * v; END_FUNCTION FUNCTION_BLOCK Blk "
     "VAR_INPUT e : BOOL; END_VAR VAR_OUTPUT q : BOOL; END_VAR VAR_IN_OUT z : INT; END_VAR VAR h : INT; "
     "END_VAR q := e; z := z + h; END_FUNCTION_BLOCK PROGRAM main VAR x : Blk; END_VAR x(z := 5); "
     "END_PROGRAM",
     "1:283: error: a value cannot be written here: a variable is required"},
    {false,
     "FUNCTION twice : INT VAR_INPUT v : INT; END_VAR twice := 2 * v; END_FUNCTION FUNCTION_BLOCK Blk "
     "VAR_INPUT e : BOOL; END_VAR VAR_OUTPUT q : BOOL; END_VAR VAR_IN_OUT z : INT; END_VAR VAR h : INT; "
     "END_VAR q := e; z := z + h; END_FUNCTION_BLOCK PROGRAM main VAR x : Blk; d : DINT; END_VAR x(z := d); "
     "END_PROGRAM",
     "1:293: error: VAR_IN_OUT 'z' is INT, not DINT"},
    {false, "FUNCTION_BLOCK B VAR_INPUT i : INT; END_VAR i := 1; END_FUNCTION_BLOCK",
     "1:45: error: 'i' is an input of the function block and cannot be written"},
    {false, "PROGRAM main VAR_IN_OUT x : INT; END_VAR x := 5; END_PROGRAM",
     "1:25: error: nothing gives VAR_IN_OUT 'x' a variable; connect it in a CONFIGURATION, or use "
     "VAR_EXTERNAL"},
    {false, "FUNCTION_BLOCK B VAR_IN_OUT i : INT := 1; END_VAR i := 1; END_FUNCTION_BLOCK",
     "1:29: error: VAR_IN_OUT 'i' is the caller's variable and has no initial value"},
    {false, "FUNCTION f : INT VAR_TEMP x AT %X0.0 : BOOL; END_VAR f := 1; END_FUNCTION",
     "1:32: error: AT is for VAR of programs and function blocks and for VAR_GLOBAL"},
    {false, "PROGRAM main VAR p : ARRAY[1..2] OF INT := 5; END_VAR p[1] := 1; END_PROGRAM",
     "1:44: error: an array has its initial values in brackets: [1, 2, 5(0)]"},
};

TEST(Errors, SayWhereAndWhat) {
  for (const auto& wrong : programs) {
    const auto source =
        wrong.body ? std::string(program_before) + wrong.text + "\nEND_PROGRAM\n" : std::string(wrong.text);
    const auto result = compile({{"w.st", source}}, interface_registers());
    EXPECT_FALSE(result.good()) << wrong.text;
    std::string first;
    for (const auto& line : result.lines())
      if (first.empty() && line.find(": error: ") != std::string::npos) first = line;
    EXPECT_EQ(first, std::string("w.st:") + wrong.message) << wrong.text;
  }
}

TEST(Errors, SeveralAreReportedInOneRun) {
  const auto result = compile(
      {{"a.st",
        "PROGRAM a\nVAR i : INT; END_VAR\ni := x;\ni := TRUE;\nIF i THEN i := 'a'; END_IF;\nEND_PROGRAM\n"},
       {"b.st", "PROGRAM b\ny := 1;\nEND_PROGRAM\n"}},
      interface_registers());
  EXPECT_THAT(
      result.lines(),
      testing::ElementsAre("a.st:3:6: error: there is no variable 'x'",
                           "a.st:4:6: error: expected INT, found BOOL; convert with BOOL_TO_INT",
                           "a.st:5:4: error: the condition of IF is BOOL, not INT; compare: value <> 0",
                           "a.st:5:16: error: expected INT, found STRING[1]",
                           "b.st:2:1: error: there is no variable 'y'"));
  const auto syntax =
      compile({{"a.st", "PROGRAM a\nVAR i : INT; j INT; END_VAR\ni := ;\ni = 2;\nEND_PROGRAM\nFUNCTION\n"}},
              interface_registers());
  EXPECT_THAT(syntax.lines(),
              testing::ElementsAre(testing::HasSubstr("a.st:2:16: error: expected ':'"),
                                   testing::HasSubstr("a.st:3:6: error:"),
                                   testing::HasSubstr("a.st:4:3: error: expected ':='"),
                                   testing::HasSubstr("a.st:7:1: error: expected the name of a function")));
}

TEST(Errors, APragmaIsOne) {
  const auto result = compile(
      {{"a.st", "{AUTHOR me}\nPROGRAM a\nVAR i : INT; END_VAR\ni := {x := 1,\n y := 2} 1;\nEND_PROGRAM\n"}},
      interface_registers());
  EXPECT_THAT(result.lines(),
              testing::ElementsAre(testing::HasSubstr("a.st:1:1: error: there are no pragmas in braces"),
                                   testing::HasSubstr("a.st:4:6: error: there are no pragmas in braces")));
}

TEST(Errors, DeepNestingIsRefused) {
  const auto result = compile(
      {{"a.st", "PROGRAM a\nVAR i : INT; END_VAR\ni := " + std::string(100000, '(') + "1;\nEND_PROGRAM\n"}},
      interface_registers());
  EXPECT_FALSE(result.good());
  EXPECT_THAT(result.lines().front(), testing::HasSubstr("nesting"));
}

}  // namespace
}  // namespace trunnion::st
