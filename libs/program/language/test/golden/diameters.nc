(=== absolute and incremental, but not I and R)
G18 G0 X20 Z0
G91 X10
G90 G2 X10 Z0 I-5 F100
(=== offsets of the program are diameters, those of the table are not)
G52 X20
G0 X0
G10 L2 P1 X20
X0
