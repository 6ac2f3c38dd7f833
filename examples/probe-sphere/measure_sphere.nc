O0100 (measures the sphere of examples/probe-sphere with the macros of examples/calibration/programs)
(#500 #501 #502: centre in machine coordinates; #503: radius at which the ball touched)
G21 G17 G90 G94 G40 G80 G49 G54
G0 G53 Z0
G0 G53 X120.4 Y59.7
A0 C0
M40
G1 G53 Z-160 F2000
G65 P9802 D25 R3 S5 I2000 J200 K50
#500=#115
#501=#116
#502=#117
#503=#113
G0 G53 Z0
M41
M30
