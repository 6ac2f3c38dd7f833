%
O9011 (A corner and an arc with the tool tip, both rotary axes turning)
G21 G17 G90 G54 G94 G64
T1 M6
S6000 M3
G0 X0 Y0 B0 C0
G43.4 H1
G1 X2 Y1 B2 C3 F6000
X4 Y-1 B-1 C1
G2 X4 Y-1 I2 J0
G1 X0 Y0 B0 C0
G49
M5
M30
%
