(=== G65 gives letters as Fanuc's list I numbers them)
(1+2+..+9 = 45, +11+13 = 69; 17+18+..+26 = 215)
G65 P10 A1 B2 C3 I4 J5 K6 D7 E8 F9 H11 M13 Q17 R18 S19 T20 U21 V22 W23 X24 Y25 Z26
M30
O10
G0 X[#1+#2+#3+#4+#5+#6+#7+#8+#9+#11+#13] Y[#17+#18+#19+#20+#21+#22+#23+#24+#25+#26]
M99
(=== sets of I J K become #4 to #33 by list II)
G65 P10 A1 B2 C3 I4 J5 K6 I7 J8 K9 I10
M30
O10
G0 X#4 Y#8 Z#10 A#1 B#2 C#3
M99
(=== a letter that does not go on begins the next set)
G65 P10 J5 I7 K9 K12
M30
O10
G0 X#5 Y#7 Z#9 A#12 B#4
M99
(=== of D and the second I, which are both #7, the later counts)
G65 P10 I4 I7 D70
G65 P10 D70 I4 I7
M30
O10
G0 X#7
M99
(=== arguments may be computed, and a vacant one is not given)
#1=5
G65 P10 A[#1*2] B#2
M30
O10
G0 X#1
IF #2 EQ #0
Y1
ENDIF
M99
(=== a macro has variables of its own, a subprogram those of its caller)
#1=1 #100=1
G65 P10
G0 X#1 Y#100
M98 P10
X#1
M30
O10
#1=7 #100=2
M99
(=== L repeats a macro, each time with its arguments)
G91
G65 P10 L3 A1
M30
O10
#1=#1+1
G0 X#1
M99
(=== macros nest)
G65 P10 A1
M30
O10
G0 X#1
G65 P11 A[#1+1]
Y#1
M99
O11
X#1
M99
(=== G66 calls after each block that moves until G67, but not at once)
G66 P10 A5
G0 X1
F100
X2 Y1
G67
X3
M30
O10
G91 G0 Z#1
G90
M99
(=== G66 calls behind all that a block of a cycle makes)
G0 Z5
G66 P10
G81 X1 Z-2 R1 F100
X2
G67
X3 L0
M30
O10
M8
M99
(=== G66 calls behind a hole that begins and ends where the tool is)
G66 P10
G81 Z-2 R0 F100
M30
O10
M8
M99
(=== G66.1 gives each block to the macro, with G L N P, until G67)
G66.1 P10
N7 G1 X5 L2 P3
M8
G67
G0 X1
M30
O10
G0 X#24 Y#10 Z#12 A#14 B#16 C#13
M99
(=== a second G66 is called first, the first at each of its moves)
G66 P10
G66 P11
G0 X1
G67
M30
O10
Y1
M99
O11
Z1
M99
(=== moves in a subprogram are followed by the modal call too)
G66 P10
M98 P20
G67
M30
O10
G91 G0 Z1
G90
M99
O20
G0 X1
X2
M99
(=== AR tells what was given, and whether in G90 or G91)
G91
G65 P10 A0
G90
G65 P10 B1
M30
O10
G90 G0 X[AR[#1]] Y[AR[#2]] Z[AR[#3]]
M99
(=== M99 P returns to a block of the caller)
G0 X1
M98 P10
X2
N7 X3
M30
O10
N7 Y1
M99 P7
(=== M99 P may return to before the call)
G0
N7 X[#1+1]
#1=#1+1
IF[#1GE3]GOTO9
M98 P10
N9 M30
O10
M99 P7
(=== a jump stays in its program)
G0 X1
M98 P10
M30
O10
GOTO 5
X2
N5 X3
M99
(=== a message stops the program until it is read)
G0 X1
#3006=12 (CHECK THE TOOL)
X2
M30
