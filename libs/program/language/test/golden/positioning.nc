(=== further reference positions, the second without P)
G30 P4 X1
G30 Y2
(=== back over the point of the way there)
G91 G28 X10 Z20
G90 G29 X3 Z4
(=== the way back takes only the axes named)
G28 X10 Z20
G29 X3
(=== single-direction positioning)
(X arrives in plus direction by 0.5, Y in minus by 0.25, Z has no side.)
G60 X10 Y20 Z30
(=== single-direction positioning in a frame)
G55 G60 X10
(=== skip move)
G31 L2 G91 X20 F100
(=== skip input 1 by default)
F50 G31 X20 A5
(=== lead of a helix counts its turns)
(10 mm at a lead of 4 and half a turn for the end: 2.5 turns.)
G0 X10
G3 X-10 Z10 I-10 K4 F100
(=== a lead of 0 says nothing)
G0 X10
G3 X-10 Y0 Z10 I-10 J0 K0 F100
(and of an arc in the plane)
X10 I10 K0
(=== a lead beside L says nothing)
G0 X10
G3 X-10 Z10 I-10 K4 L2 F100
(=== constant surface speed and back to the speed before)
(200 m/min at X 40 are 200000 / 80 pi = 795.77 1/min, of which whole ones are kept.)
S500 G0 X40
G92 S3000
G96 S120
S200
G97
G97 S600
(=== the limit of the surface speed counts at the centre, and a new one is told)
G92 S3000
G96 S100
G92 S2000
G92 S2000
G97
(=== surface speed in feet)
G92 S3000
G20 G96 S100
(=== limit of the spindle moves nothing)
G92 S3000
(=== the skip input by P)
G31 P3 X20 F100
(=== skip moves with inputs of their own)
F100 G31.1 X5
G31.2 X10
G31.3 X20 F50
