O0101 (prepares %001 for examples/probe-sphere: measures the sphere at A0 C0, then sets the inputs and the teaching points)
G21 G17 G90 G94 G40 G80 G49 G54
#52000=1
#52002=4
#52003=6
#52004=5
#52005=2000
#52006=200
#52007=50
#52008=12.5
#52009=150
#52010=3
#52011=0
#52012=0
G0 G53 Z0
G0 G53 X120.4 Y59.7
A0 C0
M40
G1 G53 Z-160 F2000
G65 P9802 D25 R3 S5 I2000 J200 K50
(The offsets of the AC trunnion machine: X0 Y0 Z-400 of C, 0 of A)
G65 P9803 X#115 Y#116 Z#117 U0 V0 W-400 J0
G0 G53 Z0
M41
M30
