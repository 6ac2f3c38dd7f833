(=== M98 calls behind the motion of its block, L times)
G91 G0 X1 M98 P20 L2
X10
M30
O20
Y1
M99
(=== without L the digits before the last four count)
G91 G0
M98 P30020
M30
O20
Y1
M99
(=== a program of the store is called by its number)
(O0200 goes to X1.)
G0 M98 P200
Y2
M30
(=== M99 P returns to a block of the caller)
G0 M98 P20
X1
N7 X2
M30
O20
Y1
M99 P7
