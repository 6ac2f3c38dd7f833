O0002 (four touches of a sphere at a teaching point: the highest point and three points of the equator, 90 degrees apart)
(G65 P002 X_ Y_ Z_ Q_: teaching point in machine coordinates, where the probe touches the highest point of the sphere)
(Q: side that is left out, where the shaft is: 0 -Y, 1 +X, 2 +Y, 3 -X; without Q 0)
(#52004 .. #52010: safe height, F1 F2 F3, radius of the sphere, tool length, tool radius, as for %001)
(#50 .. #61: X Y Z of the four touches, machine coordinates; #62 #63 #64: centre of the ball's sphere; #65: its radius)
IF [[#24 EQ #0] || [#25 EQ #0] || [#26 EQ #0]] THEN #3000=21 (P002 needs X Y Z, the teaching point)
#30=#4003
G90 G94
#2=#5021-#5041
#3=#5022-#5042
#4=#5023-#5043
#10=#24-#2
#11=#25-#3
#12=#26-#4+#52004
#1=#52008+#52010
G1 X#10 Y#11 F#52005
Z#12
G65 P9801 X0 Y0 Z-1 D[2*#52004] J#52006 K#52007 R1
#50=#141+#2
#51=#142+#3
#52=#143+#4
#13=#143-#1
(The sides +X, +Y, -X, -Y without the one at the shaft)
#20=0
#21=0
WHILE [#20 LT 4] DO 1
#22=ROUND[COS[90*#20]]
#23=ROUND[SIN[90*#20]]
#27=#20
IF [#20 EQ 0] THEN #28=1
IF [#20 EQ 1] THEN #28=2
IF [#20 EQ 2] THEN #28=3
IF [#20 EQ 3] THEN #28=0
IF [#28 EQ #17+0] GOTO 100
G1 X[#10+#22*[#1+#52004]] Y[#11+#23*[#1+#52004]] F#52005
Z#13
G65 P9801 X[-#22] Y[-#23] Z0 D[2*#52004] J#52006 K#52007 R1
#21=#21+1
#[50+3*#21]=#141+#2
#[51+3*#21]=#142+#3
#[52+3*#21]=#143+#4
G1 Z#12 F#52005
N100 #20=#20+1
END 1
G1 X#10 Y#11 F#52005
(The sphere through four points: 2 [Pi - P0] c = [Pi - P0] [Pi - P0] with c from P0, by Cramer's rule)
#1=#53-#50
#2=#54-#51
#3=#55-#52
#4=#56-#50
#5=#57-#51
#6=#58-#52
#7=#59-#50
#8=#60-#51
#9=#61-#52
#10=[#1*#1+#2*#2+#3*#3]/2
#11=[#4*#4+#5*#5+#6*#6]/2
#12=[#7*#7+#8*#8+#9*#9]/2
#13=#1*[#5*#9-#6*#8]-#2*[#4*#9-#6*#7]+#3*[#4*#8-#5*#7]
IF [ABS[#13] LT 1] THEN #3000=22 (the four touches lie in a plane: check the teaching point)
#14=[#10*[#5*#9-#6*#8]-#2*[#11*#9-#6*#12]+#3*[#11*#8-#5*#12]]/#13
#15=[#1*[#11*#9-#6*#12]-#10*[#4*#9-#6*#7]+#3*[#4*#12-#11*#7]]/#13
#16=[#1*[#5*#12-#11*#8]-#2*[#4*#12-#11*#7]+#10*[#4*#8-#5*#7]]/#13
#62=#50+#14
#63=#51+#15
#64=#52+#16
#65=SQRT[#14*#14+#15*#15+#16*#16]
IF [ABS[#65-#52008-#52010] GT 0.5] THEN #3000=23 (the measured radius differs by more than 0.5 mm: check probe and sphere)
G#30
M99
