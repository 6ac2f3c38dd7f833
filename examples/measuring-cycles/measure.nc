%
O0100 (ring gauge, block and boss of truth.yaml; results in #510 .. #537)
G21 G17 G90 G54 G94 G49 G40
G10 L2 P1 X10 Y20 Z-400
G10 L2 P2 X0 Y0 Z0
G10 L2 P3 X0 Y0 Z0
(the probe is tool 9: 60 mm to the centre of the ball, 3 mm more to its lowest point)
G10 L10 P9 R63
G53 G0 Z0
M40
G43 H9
(ring gauge: calibrate, then measure it as a bore)
G0 X-90.4 Y-19.7
G1 Z9 F3000
G65 P9810 D50 R3
G65 P9812 D50
#510=#130 #511=#131 #512=#133 #513=#134
G1 Z60 F3000
(boss: its centre becomes X0 Y0 of G55)
X-70 Y70.6
G65 P9812 D32 Z20 S2
#514=#130 #515=#131 #516=#133 #517=#135 #518=#136
G1 Z60 F3000
(block: top, left side, width and length)
X50 Y10
Z35
G65 P9811 Z30 S3
#519=#132 #520=#134
G65 P9813 X60 Z15
#521=#130 #522=#133
G65 P9813 Y40 Z15
#523=#131 #524=#133
G1 X8 F3000
Z15
G65 P9811 X20
#525=#130
(outer corner of the block at X- Y-: it becomes X20 Y-10 of G56)
G1 Y-20 F3000
G65 P9814 X20 Y-10 I15
#526=#130 #527=#131
G1 Z60 F3000
X5 Y-25
Z15
G65 P9814 X20 Y-10 I15 S3
G1 Z60 F3000
#528=#5241 #529=#5242
#530=#5261 #531=#5262 #532=#5263
#533=#560
(the same block turned by C: the angle of its left and of its front side)
C1.5 F3000
X8 Y4
Z15
G65 P9815 X20.9 I10
#534=#137 #535=#134
G1 Z60 F3000
X60 Y-25
Z15
G65 P9815 Y-11 I-20
#536=#137 #537=#134
G1 Z60 F3000
C0
M41
G49
G53 G0 Z0
M30
%
