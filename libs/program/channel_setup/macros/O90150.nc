O90150 (rectangular pocket about the position)
(G65 P90150 X_ Y_ Z_ R_ [C_ Q_ I_ K_ D_ F_ E_]: X Y: its length along X and Y; Z: its bottom, R: where the passes begin and to)
(which the tool goes in rapid, program coordinates; C: radius of its corners, the smallest possible without it; Q: depth of a)
(pass, one pass without it; I: step from path to path, 0.7 of the cutter diameter without it, at most 0.85; K: allowance on the)
(wall; D: number of the cutter radius, the active one without it; F: feed, E: feed into the depth, F without it)
(The tool goes counter-clockwise, from the middle to the wall, and ends over the middle at R.)
IF [[#24 LE 0] || [#25 LE 0]] THEN #3000=80 (P90150 needs the lengths X and Y above 0)
IF [[#26 EQ #0] || [#18 EQ #0]] THEN #3000=81 (P90150 needs the bottom Z and the level R)
IF [#18 LE #26] THEN #3000=82 (P90150: R must be above Z)
IF [[#7 EQ #0] && [#4107 EQ 0]] THEN #3000=83 (P90150 needs the cutter radius D)
IF [[#4002 NE 17] || [#4007 NE 40] || [#4009 NE 80]] THEN #3000=84 (P90150 needs G17, G40 and G80)
IF [[#4011 NE 50] || [#4018 NE 15] || [#4005 EQ 93]] THEN #3000=85 (P90150 needs G50, G15, and G94 or G95)
IF [#9 EQ #0] THEN #9=#4109
IF [#9 LE 0] THEN #3000=86 (P90150 needs the feed F)
IF [#8 EQ #0] THEN #8=#9
IF [#6 LT 0] THEN #3000=87 (P90150: the allowance K must not be below 0)
IF [#7 NE #0] THEN D#7
#27=#4199
IF [#27 LE 0] THEN #3000=88 (P90150: the tool D has no radius)
(#1 #2: half the outermost path along X and Y, #5: radius of its corners)
#1=#24/2-#27-#6
#2=#25/2-#27-#6
IF [[#1 LT 0] || [#2 LT 0]] THEN #3000=89 (P90150: the tool does not fit into the pocket)
#5=0
IF [#3 NE #0] THEN #5=#3-#27-#6
IF [#5 LT -0.00001] THEN #3000=90 (P90150: C must be at least the cutter radius and K)
IF [[#5 GT [#1+0.00001]] || [#5 GT [#2+0.00001]]] THEN #3000=91 (P90150: C must be at most half of X and of Y)
IF [#4 EQ #0] THEN #4=1.4*#27
IF [[#4 LE 0] || [#4 GT 1.7*#27]] THEN #3000=92 (P90150: the step I must be above 0 and at most 0.85 of the cutter diameter)
IF [#17 EQ #0] THEN #17=#18-#26
IF [#17 LE 0] THEN #3000=93 (P90150: the depth Q must be above 0)
(#11 paths inside of the outermost one, #12 apart: the innermost is within the cutter radius of the middle.)
#10=#1
IF [#2 LT #1] THEN #10=#2
#11=0
#12=0
IF [#10 GT #27] THEN #11=FUP[[#10-#27]/#4]
IF [#11 GT 0] THEN #12=[#10-#27]/#11
#13=FUP[[#18-#26]/#17-0.000001]
#14=[#18-#26]/#13
#33=#4030
#30=#4003
#29=#4001
#28=#4109
#31=#5001
#32=#5002
G90 G91.1 G0 Z#18
#15=1
WHILE [#15 LE #13]
G1 Z[#18-#15*#14] F#8
#16=#11
WHILE [#16 GE 0]
#20=#1-#16*#12
#21=#2-#16*#12
#22=#5-#16*#12
IF [#22 LT 0.00001] THEN #22=0
(Half a circle that touches leads from path to path.)
IF [#16 EQ #11]
G1 X#31 Y[#32-#21] F#9
ELSE
G3 X#31 Y[#32-#21] I0 J[0-#12/2]
ENDIF
G1 X[#31+#20-#22]
IF [#22 GT 0] THEN G3 X[#31+#20] Y[#32-#21+#22] I0 J#22
G1 Y[#32+#21-#22]
IF [#22 GT 0] THEN G3 X[#31+#20-#22] Y[#32+#21] I[0-#22] J0
G1 X[#31-#20+#22]
IF [#22 GT 0] THEN G3 X[#31-#20] Y[#32+#21-#22] I0 J[0-#22]
G1 Y[#32-#21+#22]
IF [#22 GT 0] THEN G3 X[#31-#20+#22] Y[#32-#21] I#22 J0
G1 X#31
#16=#16-1
ENDW
G1 X#31 Y#32
#15=#15+1
ENDW
G0 Z#18
G#30 G#33
IF [#28 GT 0] THEN F#28
IF [#29 LE 3] THEN G#29
M99
