%
O1002 (The sub-spindle takes the part over while both spindles turn, and it is parted off)
G21 G18 G90 G54 G40 G94
M64
G53 G0 X300 Z400
G53 G0 W520
T3 M6
(Sub-spindle: open the chuck, pass the index mark)
M65
M11
M19
M5
(It faces the main spindle, so it turns the other way round)
M64
S1000 M3
M81 R0
G4 X1
(Over the part; W is the distance of the chucks)
G53 G0 W150
G53 G1 W105 F1000
(A part in both chucks must not be worked against)
M82
M65
M10
M64
M8
(Part off)
G95
G0 Z-55
X44
G1 X-1 F0.1
(It is separate: without M85, M84 waits for the spindles to stand)
M85
G0 X60
M9
G53 G0 X300
(Away with the part, then each for itself)
G94
G53 G1 W200 F2000
M84
M5
G53 G0 W520
M30
%
