(=== order in a block: S T, M before, motion, M after)
M9 M3 G1 X1 M8 T7 S1000 F50
(=== clamps and other M act before the motion)
G0 X1 M10
X2 M999
(=== stop and end act after the motion)
G0 X1 M0
X2 M30
X3
(=== M2 ends)
M2
(=== dwell: P in milliseconds, X and U in seconds)
G4 P1500
G4 X1.5
G04 U2
G4 P0
(=== dwell does not disturb modal motion)
G1 X1 F10
G4 X3
X2
(=== tool length after the tool change, before the motion)
T1 M6 G43 H1 G0 Z10
(=== G40, G80, G94 and N are accepted)
N10 G40 G80 G49 G94 G17 G21 G54 G64 G90
N20 G0 X1
