O9811 (measure a surface across X, Y or Z)
(G65 P9811 X_ | Y_ | Z_ [S_ Q_ J_ K_]: the probe on, beside the surface, at rest)
(X, Y or Z: where the surface is expected, workpiece coordinates; S: 1 .. 6, work offset G54 .. G59 in which it gets that)
(coordinate; Q: search distance beyond, 10 mm without it; J K: feeds of both touches, mm/min)
(#130, #131 or #132: the surface, workpiece coordinates; #134: it less the expected coordinate)
#130=#0 #131=#0 #132=#0 #133=#0 #134=#0 #135=#0 #136=#0
IF [[#24 NE #0]+[#25 NE #0]+[#26 NE #0] NE 1] THEN #3000=24 (P9811 needs one of X Y Z)
G65 P9819 S#19
IF [#17 EQ #0] THEN #17=10
IF [#5 EQ #0] THEN #5=300
IF [#6 EQ #0] THEN #6=50
IF [#24 NE #0]
#10=#24-#5041
ELSEIF [#25 NE #0]
#10=#25-#5042
ELSE
#10=#26-#5043
ENDIF
#11=SIGN[#10]
IF [#11 EQ 0] THEN #3000=25 (P9811: the probe is where the surface is expected)
IF [[#26 NE #0] && [#11 GT 0]] THEN #3000=26 (P9811: a surface across Z is measured from above)
#12=ABS[#10]+#17
IF [#24 NE #0]
G65 P9801 X#11 Y0 Z0 D#12 J#5 K#6 R1
#130=#141+#11*#560
#134=#130-#24
IF [#19 NE #0] THEN G65 P9817 A1 B#130 C#24 S#19
ELSEIF [#25 NE #0]
G65 P9801 X0 Y#11 Z0 D#12 J#5 K#6 R1
#131=#142+#11*#560
#134=#131-#25
IF [#19 NE #0] THEN G65 P9817 A2 B#131 C#25 S#19
ELSE
G65 P9801 X0 Y0 Z#11 D#12 J#5 K#6 R1
#132=#143+#561
#134=#132-#26
IF [#19 NE #0] THEN G65 P9817 A3 B#132 C#26 S#19
ENDIF
M99
