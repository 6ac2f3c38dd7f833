(=== G70, a circle: from the first angle anticlockwise)
(Centre 5 0, radius 10, from 90 degrees in steps of 360 / 4: [5,10] [-5,0] [5,-10] [15,0].)
G99 G81 Z-1 R0 L0 F100
G70 X5 Y0 I10 J90 K4
(=== G70 with negative K goes clockwise)
G99 G81 Z-1 R0 L0 F100
G70 X5 Y0 I10 J90 K-2
(=== G71, an arc: P degrees from hole to hole)
G99 G81 Z-1 R0 L0 F100
G71 X0 Y0 I10 J0 P90 K2
(=== G78, a line at an angle)
G99 G81 Z-1 R0 L0 F100
G78 X1 Y2 I2 J90 K2
(=== G79, a grid walked to and fro)
(Spacing 10 and 2 holes along X, spacing 5 and 2 rows along Y.)
G99 G81 Z-1 R0 L0 F100
G79 X0 Y0 I10 P2 J5 K2
(=== K or L repeats a cycle at equal steps in G91)
G99 G81 Z-1 R0 L0 F100
G91 X3 K2
(=== in the plane ZX the holes go along Y)
(I 4 J 0: along Z, the first axis of ZX.)
G18 G99 G81 Y-1 R0 L0 F100
G78 Z0 X0 I4 J0 K2
