O9814 (measure a corner whose sides are along X and Y)
(G65 P9814 X_ Y_ [I_ S_ Q_ J_ K_]: the probe on, beside the corner, at the height to measure)
(X Y: where the corner is expected, workpiece coordinates; I: the corner is an outer one, and I how far along its sides it)
(is touched, mm: the probe begins outside of both; S: 1 .. 6, work offset G54 .. G59 in which the corner gets X Y)
(Q: search distance beyond, 10 mm without it; #130 #131: corner, workpiece coordinates)
#130=#0 #131=#0 #132=#0 #133=#0 #134=#0 #135=#0 #136=#0
IF [[#24 EQ #0] || [#25 EQ #0]] THEN #3000=31 (P9814 needs X and Y)
G65 P9819 S#19
#10=#5041
#11=#5042
#12=SIGN[#24-#10]
#13=SIGN[#25-#11]
IF [#12*#13 EQ 0] THEN #3000=32 (P9814: the probe is on a side of the expected corner)
#30=#4003
G90 G94
IF [#4 EQ #0]
G65 P9811 X#24 Q#17 J#5 K#6
#14=#130
G65 P9811 Y#25 Q#17 J#5 K#6
ELSE
IF [#4 LE 0] THEN #3000=33 (P9814: I must be above 0)
G1 Y[#25+#13*#4] F1000
G65 P9811 X#24 Q#17 J#5 K#6
#14=#130
G1 Y#11 F1000
X[#24+#12*#4]
G65 P9811 Y#25 Q#17 J#5 K#6
G1 X#10 F1000
ENDIF
G#30
#130=#14
#15=#131
#132=#0
#134=#0
IF [#19 EQ #0] THEN M99
G65 P9817 A1 B#14 C#24 S#19
G65 P9817 A2 B#15 C#25 S#19
M99
