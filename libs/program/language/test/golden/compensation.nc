(=== outside corner of lines, lead in and lead out)
(Walking up from [0,0] with the tool left: x = -5. Right turn at [0,20]: a quarter about it,)
(clockwise. The walk to the right runs at y = 25 and ends square beside [20,20]; the way out is)
(straight.)
G0 X0 Y-20
G41 D1 G1 Y0 F100
Y20
X20
G40 X40 Y40
(=== inside corner of lines)
(Walking right with the tool left: y = 5; left turn at [30,0]: the offsets meet at [25,5].)
G41 D1 G1 X10 F100
X30
Y20
G40 X0
(=== G40 with I J leaves where the offset of a wall behind the contour is met)
(A wall that goes up from [30,0] has its offset at x = 25, one that goes down at x = 35.)
G41 D1 G1 X10 F100
X30
G40 X20 Y20 I0 J1
X0
(=== the wall may be an outside corner too, and the direction may stand before the move)
G41 D1 G1 X10 F100
X30
G40 J-2
X40 Y20
(=== a wall straight on is square as without it)
G41 D1 G1 X10 F100
X30
G40 X40 Y20 I1
(=== the wall turns with G68)
G68 X0 Y0 R90
G41 D1 G1 X10 F100
X30
G40 X20 Y20 J1
(=== on the right everything is mirrored)
G42 D1 G1 X10 F100
X30
Y-20
G40 X0
(=== a negative radius is the other side)
G10 L12 P1 R-5
G41 D1 G1 X10 F100
X30
G40 X50
(=== wear is added: 5 - 1)
G41 D2 G1 X10 F100
X30
G40 X50
(=== D0 is the contour itself)
G41 D0 G1 X10 F100
X30
Y10
G40 X50
(=== blocks that do not move in the plane act at the end of the move before)
G41 D1 G1 X10 F100
Z-5
X30
M8
G4 P100
Z-6
Y20
G40 X0
(=== tangent line to arc, inside: smaller radius, smaller feed)
(From inside, anticlockwise on a circle of radius 20 about [30,0]: the tool is on 15. F holds at the)
(contour: 100 * 15 / 20.)
G41 D1 G1 X10 Y-20 F100
X30
G3 X50 Y0 J20
G1 Y10
G40 X0
(=== outside of an arc: larger radius, larger feed)
G42 D1 G1 X10 Y-20 F100
X30
G3 X50 Y0 J20
G1 Y10
G40 X0
(=== outside corner from line to arc and from arc to line)
(A half circle of radius 10 about [30,0] below the line's end, tool outside: from [20,0] straight up)
(into the line would be tangent; here the line comes along X and turns right into it by 90 degrees.)
(Left of the line y = 5. At [20,0] the walk turns down: right turn, outside, arc from [20,5] to)
([25,0] about [20,0]. Inside the half circle the radius is 5. At [40,0] it goes up and turns right)
(again.)
G41 D1 G1 X10 F100
X20
G3 X40 I10
G1 X60
G40 X80
(=== inside corner from line to arc and from arc to line)
(Tool right, above is the material's other side: the line y = -5 meets the circle of 15 about [30,0])
(at x = 30 - sqrt[15^2 - 5^2] = 30 - 14.142 = 15.858, and again behind at 44.142. The arc then has)
(180 - 2 * asin[5/15] = 180 - 38.942 = 141.058 degrees; feed 100 * 15 / 10.)
G42 D1 G1 X-10 F100
X20
G3 X40 I10
G1 X60
G40 X80
(=== change of side: straight across)
G41 D1 G1 X10 F100
X30
G42 X50
G40 X60
(=== change of radius at an outside corner: straight, at an inside corner: where the offsets meet)
G41 D1 G1 X10 F100
X30
D3 Y-20
G40 Y-30
(=== back on the same way: half a circle around the end)
G41 D1 G1 X10 F100
X30
X10
G40 X0
(=== outside corner in rapid)
(The polygon around a quarter in rapid has one corner: [30 + 5, 5].)
G41 D1 G0 X10
X30
Y-20
G40 Y-30
(=== helix: the height is the programmed one)
G41 D1 G1 X10 Y-20 F100
X30
G3 X50 Y0 Z-4 J20
G1 Y10
G40 X0
(=== full circle inside a bore)
(Square beside [20,0], walking up: x = 15.)
G41 D1 G1 X20 F100
G3 I-20
G40 G1 X0
(=== ZX plane)
G18 G41 D1 G1 Z10 F100
Z30
X20
G40 Z0
(=== end of the program ends square)
G41 D1 G1 X10 F100
X30
M30
(=== off without a move: the next straight one leads out)
G41 D1 G1 X10 F100
X30
G40
M8
X50
(=== on without a move: the next straight one leads in)
G41 D1
M8
G1 X10 F100
X30
G40 X50
(=== work offsets and tool length come behind it)
G52 X100 Z1
G10 L10 P9 R7
G43 H9
G41 D1 G1 X10 Y0 Z0 F100
X30
G40 X50
(=== turned by G68)
G68 X0 Y0 R90
G41 D1 G1 X10 F100
X30
Y20
G40 X0
(=== a scaled contour keeps the tool's radius)
G51 X0 Y0 Z0 P2
G41 D1 G1 X10 F100
X30
Y20
G40 X0
(=== a mirror changes the side)
G51.1 X0
G41 D1 G1 X10 F100
X30
Y20
G40 X0
(=== a slot narrower than the tool cannot be resolved)
(Walking round the inside of a slot 4 wide with radius 5: beside the short wall the tool would go back. The)
(move to X30 is not out yet, for the interference check looks two moves ahead of it.)
G41 D1 G1 X10 F100
X30
Y4
X10
G40 X0
