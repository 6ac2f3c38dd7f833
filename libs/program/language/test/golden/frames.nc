(=== scaling about a point)
G51 X10 Y0 Z0 P2
G0 X11 Y1
(=== scaling per axis, off again goes on from the position)
G51 X0 Y0 Z0 I2 J3
G0 X1 Y1 Z1
G50
G91 X1
(=== scaling without a point is about the position)
G0 X10
G51 P2
G0 X11
(=== incremental words are scaled too)
G51 X5 Y5 Z5 P0.5
G91 G0 X4
(=== a negative factor mirrors, and a circle turns round)
G51 X0 Y0 Z0 I-1
G0 X10
G3 X0 Y10 I-10 F100
(=== equal factors scale circles)
G51 X0 Y0 Z0 P2
G0 X10
G3 X0 Y10 R10 F100
(=== mirror about a coordinate, per axis and off)
G51.1 X10
G0 X11 Y1
G24 Y0
X11 Y1
G50.1 X0
X11 Y1
G25
X11 Y1
(=== two mirrors leave the sense of a circle)
G51.1 X0 Y0
G0 X10
G3 X0 Y10 I-10 F100
(=== a mirrored rotary axis)
G51.1 A0
G0 A30
(=== rotation about a point)
([10, 0] turned by 90 degrees about [5, 0] is [5, 5].)
G68 X5 Y0 R90
G0 X10 Y0
(=== rotation turns the centre of a circle)
G68 X0 Y0 P90
G0 X10
G3 X0 Y10 I-10 F100
(=== rotation in ZX)
G18 G68 X0 Z0 R90
G0 Z10
(=== incremental angles add)
G68 X0 Y0 R30
G91 G68 X0 Y0 R60
G90 G0 X10
(=== G69 goes on from the position)
G68 X0 Y0 R90
G0 X10
G69
G0 X1
(=== mirror, then scaling, then rotation, then offsets, whatever the order they were called in)
(mirror: X 1 -> -1; scaling by 2: -2, Y 0; rotation by 90, mirrored: -90 about 0: [0, 2]; G52 X100: [100, 2].)
G68 X0 Y0 R90
G51 X0 Y0 Z0 P2
G51.1 X0
G52 X100
G0 X1 Y0
(=== the centre of rotation is scaled with the drawing)
(The centre [10, 0] is scaled to [20, 0] and the point [11, 0] to [22, 0]: 2 beside it, so 2 above)
(it.)
G51 X0 Y0 Z0 P2
G68 X10 Y0 R90
G0 X11 Y0
(=== a frame moves nothing by itself)
G0 X3 Y4
G68 X0 Y0 R90
G51 P2
G51.1 X7
G0 A1
(=== polar words)
(radius 10 at 90, 180 degrees; radius 20 at 180; 90 degrees on: 270.)
G16 G0 X10 Y90
Y180
X20
G91 Y90
G90 G15 X1
(=== an incremental polar radius is about the position)
G0 X5
G16 G91 X10 Y90
