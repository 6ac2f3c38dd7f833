(=== unclosed bracket)
G0 X[1+2
(=== division by zero)
G0 X1
X[1/0]
(=== square root of a negative number)
#1=SQRT[-1]
(=== program that is nowhere)
M98 P77
(=== recursion)
O5
M98 P5
M99
(=== number of three hundred digits, in short)
G0 X1000000000000
(=== a letter twice)
G0 X1 X2
(=== two codes of one group)
G0 G1 X1 F10
(=== arc whose end is off its circle)
(Radius 10 at the start and 11 at the end; 0.1 is allowed.)
G0 X10
G3 X0 Y11 I-10 F100
(=== radius too small for the way)
G2 X10 R4 F100
(=== a word nobody wants)
G0 X1 R5
(=== feed is missing)
G1 X1
