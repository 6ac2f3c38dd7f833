%
O9001 (Left channel: lines and a circle)
G21 G17 G90 G54
(The touch probe on and off)
M40
M41
T1 M6
S5000 M3
G0 X0 Y0 Z2
G1 X5 Y3 Z0 F4000
G2 X5 Y3 I2 J0
G1 X0 Y0
M5
M30
%
