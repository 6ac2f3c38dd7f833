(=== quarter anticlockwise)
(From [10,0] about the origin: a quarter anticlockwise ends at [0,10], clockwise the way there is 270)
(degrees.)
G0 X10
G3 X0 Y10 I-10 F100
(=== three quarters clockwise)
G0 X10
G2 X0 Y10 I-10 J0 F100
(=== R takes the short arc, negative R the long one)
G0 X10
G3 X0 Y10 R10 F100
G0 X10 Y0
G3 X0 Y10 R-10
(=== full circle from the centre alone)
G0 X10
G2 I-10 F100
(=== L counts begun turns)
G0 X10
G2 X10 I-10 L3 F100
G3 X0 Y10 I-10 L2
(=== helix: the centre stays at the start's height)
G0 X10 Z5
G3 X0 Y10 Z7 I-10 A30 F100
(=== plane ZX takes I and K)
(ZX plane: anticlockwise about +Y goes from Z to X. From Z10 a quarter anticlockwise about the origin)
(ends at X10.)
G18 G0 Z10
G3 X10 Z0 K-10 F100
(=== plane YZ takes J and K)
G19 G0 Y10
G3 Y0 Z10 J-10 F100
(=== arcs are modal)
G0 X10
G3 X0 Y10 I-10 F100
X-10 Y0 J-10
(=== inches scale centre and radius)
G20 G91 G3 X-1 Y1 I-1 F1
