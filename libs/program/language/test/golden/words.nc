(=== head, sequence numbers, comments of both kinds and a block with nothing in it)
%1234
N10 G0 X1 (the first) Y1 ; and the rest of the line
; a line of its own

N20 X2
M30
X3
(=== a tape mark before the program is none, one behind it ends it)
%
O0007
G0 X1
%
X2
(=== blocks to skip are run unless somebody skips them)
/G0 X1
/3 X2
M2
(=== numbers: signs, points at either end, leading zeros, small letters, no blanks)
(The G of a word may have leading zeros as well.)
g00x+1.y-.5z007
x1.5E3M5
