(=== P and Q of modal codes in a block that drills)
G99 G82 Z-1 R0 P100 L0 F100
G64 P0.5 X1
G5.1 Q1 X2
(=== P and L of a call while a cycle is on)
G99 G81 Z-1 R0 L0 F100
M98 P200 L2
(=== the words stay behind the next cycle code)
(The dwell of G82 stays as well; G85 has none.)
G0 Z10
G99 G81 X1 Z-5 R2 F100
G82 X2 P500
G85 X3
G82 X4
(=== G80 forgets the words)
G99 G81 X1 Z-5 R2 F100
G80
G81 X2
(=== so does a motion code)
G99 G81 X1 Z-5 R2 F100
G0 Z2
G81 X2
(=== a code of a block that does something else begins without the words of a cycle that is over)
G99 G81 X1 Z-5 R2 F100
G80
G81 G4 P100
X2
(=== a peck of drilling is none of tapping)
(F / S is a lead of 1 mm.)
S100 F100 G99 G83 X0 Z-5 R0 Q3
G84 X1
(=== depth and R behind the code)
G81 F100
X1 Z-5 R2
X2
(=== words in any sequence, G98 in a later block)
G0 Z10
F100 R2 Z-5 G81 G99 X1
G98 Y1
(=== G80 with an axis word moves as before the cycle)
G1 F100 X1
G99 G81 X2 Z-5 R2
G80 X3
(=== incremental R and depth, repetitions by K)
(R at 10 - 7 = 3, Z at 3 - 8 = -5.)
G0 Z10
G91 G99 G81 X5 Z-8 R-7 K2 F100
(=== Q0 drills in one stroke, with its dwell)
G99 G83 X0 Z-5 R2 Q0 P250 F100
G73 X1
(=== Q0 means nothing where there are no pecks)
G99 G81 X0 Z-5 R2 Q0 F100
S100 G84 X1 Q0
