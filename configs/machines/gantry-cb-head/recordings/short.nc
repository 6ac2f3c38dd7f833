%
O9001 (Both motors of the gantry turn round while the head swings)
G21 G17 G90 G54 G64
T1 M6
S6000 M3
G0 X0 Y0 B0 C0
G43.4 H1
G1 X3 Y4 B1 C2 F3000
Y-2 B-1
X0 Y0 B0 C0
G49
M5
M30
%
