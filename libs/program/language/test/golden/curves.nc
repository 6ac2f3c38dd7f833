(=== polygon: the first point may be left out)
G6.2 P2 K0 F100
K0 X5
K1 Y5
K2
K2
G0 X1
(=== incremental points and frames)
G52 X100
G68 X0 Y0 R90
G0 X0 Y0
G91 G6.2 P2 K0 F100
K0 X5
K1 Y5
K2
K2
