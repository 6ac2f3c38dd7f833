O9815 (measure the angle of a side that is nearly along X or Y)
(G65 P9815 X_ | Y_ I_ [Q_ J_ K_]: the probe on, beside the side, at the height to measure)
(X or Y: where the side is expected, workpiece coordinates; it is touched there, and I farther along Y or X, mm, either sign)
(Q: search distance beyond, 10 mm without it; #137: angle of the side to its axis, deg, positive counterclockwise)
(#130 or #131: the side at the first touch, workpiece coordinates; #134: the second touch less the first)
#130=#0 #131=#0 #132=#0 #133=#0 #134=#0 #135=#0 #136=#0 #137=#0
IF [[#24 NE #0]+[#25 NE #0] NE 1] THEN #3000=44 (P9815 needs one of X Y)
IF [#4 EQ #0] THEN #3000=45 (P9815 needs I)
IF [#4 EQ 0] THEN #3000=45 (P9815 needs I)
G65 P9819
#10=#5041
#11=#5042
#30=#4003
G90 G94
IF [#24 NE #0]
G65 P9811 X#24 Q#17 J#5 K#6
#14=#130
G1 Y[#11+#4] F1000
G65 P9811 X#24 Q#17 J#5 K#6
#15=#130
G1 Y#11 F1000
#137=ATAN[[#14-#15]/#4]
#130=#14
ELSE
G65 P9811 Y#25 Q#17 J#5 K#6
#14=#131
G1 X[#10+#4] F1000
G65 P9811 Y#25 Q#17 J#5 K#6
#15=#131
G1 X#10 F1000
#137=ATAN[[#15-#14]/#4]
#131=#14
ENDIF
G#30
#134=#15-#14
M99
