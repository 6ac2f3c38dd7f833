(=== rapid and line, F and motion are modal)
G0 X10 Y20
G1 Z-5 F100
X30
(=== blanks are optional, case is free, points are optional)
g0x10y20.
G 1 z -.5 f+100.0
(=== a move to where the tool is makes no command)
G0 X0
G1 X0 F50
G91 X0
(=== modal state of a block without a move counts)
G1 F50 G91
X1
X1
(=== incremental words)
G91 G0 X1 Y2
X1
G90 X1
(=== inches scale lengths and feed)
(1 inch = 25.4 mm; rotary words are degrees in either unit; F10 inch/min = 254 mm/min.)
G20 G1 X1 A90 U2 F10
G21 X1
(=== F of rotary axes alone is degrees per minute in inches too)
G20 G1 C90 F360
(=== nine axes)
G0 X1 Y2 Z3 A4 B5 C6 U7 V8 W9
(=== rotary axes are absolute degrees)
G0 C350
C10
C-730
(=== work offset is added to absolute words only)
(G55 = [100, 200, 300, A10, C20].)
G55 G0 X1 A5
G91 X1
G54 G90 X1
(=== tool length is added to Z)
G0 Z100
G43 H1 Z100
G18 Z90
G49
Z90
(=== H0 has length zero)
G43 H0 Z1
G43 H2
G43 H2
(=== machine coordinates know no offset, length or G91, and stay one block)
G55 G0 X0
G43 H1 G91
G53 X10 Z20
X1
G53 G1 X11.5 F10
(=== reference return goes over the point given, named axes only)
G0 X10 Y10 Z10
G28 X20 Z30
G91 G28 Z0
(=== incremental reference return of one axis)
G0 X10 Z10
G91 G28 Z5
(=== inverse time wants F in each block and does not scale it)
G93 G20 G1 X1 F2
X2 F4
(=== feed per revolution)
G95 G1 X1 F0.2
