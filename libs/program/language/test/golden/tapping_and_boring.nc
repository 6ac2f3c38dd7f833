(=== rigid tapping: the spindle stands before it is coupled, and turns again when the cycle ends)
(500 mm/min at 400 1/min: 1.25 mm a turn.)
S400 M3 F500 G99 G84 X1 Z-5 R2 P100
X2
G80
(=== M5 with the cycle keeps the spindle off)
S400 M4
F500 G99 G84 X0 Z-5 R0 M5
G0 Z1
(=== M4 behind the cycle takes the place of the spindle's return)
S400 M3 F500 G99 G84 X0 Z-5 R0
M4 G80
(=== left-hand thread with the lead as feed)
G95 S400 F1.5 G74 X0 Z-5 R2
(=== tapping in pecks, with the spindle as W axis)
S100 G95 F1 G99 G84 X0 Z-5 R0 Q3 J6
(=== boring, out at feed)
G99 G85 X0 Z-5 R2 F100
(=== boring, out at feed with dwell)
G89 X0 Z-5 R2 P250 F100
(=== boring, spindle stop)
M4 G86 X0 Z-5 R2 F100
(=== boring, out by hand)
G88 X0 Z-5 R2 P100 F100
(=== fine boring)
G99 G76 X1 Y1 Z-5 R2 Q0.5 F100
(=== shift by I and J)
G99 G76 X0 Z-5 R2 I0.3 J-0.4 F100
(=== back boring)
G0 Z10
M3 G87 X0 Z-5 R-20 Q0.5 F100
(=== the shift takes the letters of the plane: K and I in ZX)
G18 G99 G76 Y-5 R2 K0.25 I0.5 F100
(=== G84.2 and G84.3 are G84 and G74)
G95 S400 F1.5 G99 G84.2 X0 Z-5 R2
G84.3 X1
