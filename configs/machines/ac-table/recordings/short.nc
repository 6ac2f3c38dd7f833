%
O9001 (A corner and an arc with the tool tip, both rotary axes turning)
G21 G17 G90 G54 G94 G64
T1 M6
S6000 M3
G0 X0 Y0 A0 C0
G43.4 H1
G1 X2 Y1 A2 C3 F6000
X4 Y-1 A-1 C1
G2 X4 Y-1 I2 J0
G1 X0 Y0 A0 C0
G49
(A touch of the probe, and a thread)
G0 X2 Y0
G31 L2 X20 F600
G1 X#5061 F3000
G0 X0 Y0 Z20
S600 M3
G99 G84 X0 Y0 Z14 R18 F900
G80
G28 Z20
M5
M30
%
