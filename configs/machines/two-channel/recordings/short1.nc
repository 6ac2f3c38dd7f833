%
O9002 (Right channel: it dwells while the other one cuts)
G21 G17 G90 G54
S3000 M3
G0 X0 Y0 Z2
G1 X4 Y0 Z1 F3000
G4 X0.1
G3 X4 Y0 I0 J2
G0 Z2
M5
M30
%
