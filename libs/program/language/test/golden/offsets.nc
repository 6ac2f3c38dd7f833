(=== additional offset)
G54.1 P48 G0 X1 Z1
(=== local offset adds to every work offset)
(G54: 10 + 1, 20 + 1. G55: 100 + 10 + 1; Y stays at the machine's 21.)
G52 X10 Y20
G0 X1 Y1
G55 X1
G52 X0 Y0
X1
(=== an incremental local offset moves on)
G52 X10
G91 G52 X5
G90 G0 X0
(=== G92 gives the position its name, in every work offset)
(At machine X10: X0 is 10 from then on; in G55 it is 100 + 10.)
G0 X10
G92 X0
G0 X1
G55 X1
G92.1
X1
(=== G92 counts the tool length)
G43 H1
G92 Z5
G0 Z6
(=== table offset changes at once and is passed on)
G10 L2 P1 X5 Y6
G0 X1
G91 G10 L2 P1 X2
G90 X1
G10 L20 P2 Z4
G54.1 P2 Z0
(=== offset of another number moves nothing)
G10 L2 P3 X5
G0 X1
(=== tool length and wear by the program)
(50 + 0.5, then 40 + 0.5, then 40 + 0.5 + 0.25)
G43 H1 G0 Z0
G10 L10 P1 R40
G43 H1 Z0
G91 G10 L11 P1 R0.25
G90 G43 H1 Z0
(=== radius and its wear)
G20 G10 L12 P1 R1
G10 L13 P1 R0
(=== length and radius in one block, T selects nothing)
G10 P9 Z128 R6 T01
G43 H9 G0 Z0
(=== parameters)
G10 L50
N10010 R3
N100 P1 R2.5
G11
G10 L50 P40030 R500
(=== G44 subtracts)
G44 H1 G0 Z100
(=== H alone exchanges the length, H0 takes it away)
H0 G0 Z1
G43 H1
Z1
H0 Z1
