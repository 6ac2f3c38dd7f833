(=== drilling, back to the level before)
G0 Z10
G81 X1 Y2 Z-5 R2 F100
X3
G80
X4
(=== G99 stays at R)
G0 Z10
G99 G81 X1 Z-5 R2 F100
X3
G98 X4
(=== dwell at the bottom)
G82 X0 Z-5 R2 P500 F100
(=== chip breaking)
(Depths 2 - 3 = -1, -4, then the rest to -5; back by 0.5 between.)
G99 G73 X0 Z-5 R2 Q3 F100
(=== deep drilling)
(Out to R after every peck, down again to 1 above the last depth.)
G99 G83 X0 Z-5 R2 Q3 F100
(=== a peck that fits makes no rest)
G99 G83 X0 Z-4 R2 Q3 F100
(=== rounding makes no peck)
(0.3 - 3 * 0.1 is 5.6e-17 above 0 in binary numbers: no fourth peck.)
G99 G73 X0 Z0 R0.3 Q0.1 F100
(=== a peck deeper than the hole)
G99 G83 X0 Z-4 R2 Q30 F100
(=== incremental words: R from the level, Z from R, holes on a line by L)
(R at 10 - 7 = 3, Z at 3 - 8 = -5.)
G0 Z10
G91 G99 G81 X5 Y1 Z-8 R-7 L3 F100
(=== repetitions by K at one place in G90)
G99 G81 X1 Z-1 R1 K2 F100
(=== K0 keeps the words and drills nothing)
G81 X9 Z-1 R1 K0 F100
X1
(=== blocks without a place drill nothing)
G81 X1 Z-1 R1 F100
F200
M8
(=== a motion code ends the cycle)
G81 X1 Z-1 R1 F100
G1 X2
(=== M codes act after the whole hole)
G99 G81 X1 Z-1 R1 F100 M9 M30
(=== a table turns with the first positioning)
G99 G81 X1 B90 Z-1 R1 F100
(=== drilling along Y in ZX)
G18 G0 Y10
G99 G81 Z1 X2 Y-5 R2 F100
(=== drilling along X in YZ, upwards)
G19 G99 G83 Y1 X7 R2 Q3 F100
(=== cycles go through the frames)
(Turned to Y10, which the mirror keeps.)
G68 X0 Y0 R90
G51.1 X0
G52 Z100
G99 G81 X10 Y0 Z-1 R1 F100
(=== inches)
(R 0, pecks of 2.54 mm to -5.08, clearance 1 mm.)
G20 G99 G83 X0 Z-0.2 R0 Q0.1 F10
