(=== G1000 to G1999 are programs of USERDEF.CYC, the letters X and Z are variables 23 and 25)
G0 X10
G1007 X2 Z3
X20
M30
(=== an M code of the parameters calls a cycle)
M130 H6
M30
(=== the alarm of a cycle stops the program)
G0 X1
G1010
M30
