O9813 (measure the width and the middle of a pocket or a web)
(G65 P9813 X_ | Y_ [Z_ S_ Q_ R_ J_ K_]: the probe on, near the middle; pocket: at the height to measure; web: above it)
(X or Y: width across that axis, mm; Z: it is a web, and Z the height to measure; S: 1 .. 6, work offset G54 .. G59 in)
(which the middle gets 0; Q: search distance beyond, 10 mm without it; R: clearance, 5 mm without it)
(#130 or #131: middle, workpiece coordinates; #133: width; #134: it less the expected one)
#130=#0 #131=#0 #132=#0 #133=#0 #134=#0 #135=#0 #136=#0
IF [[#24 NE #0]+[#25 NE #0] NE 1] THEN #3000=29 (P9813 needs one of X Y)
G65 P9819 S#19
IF [#24 NE #0]
#1=#24
#2=1
ELSE
#1=#25
#2=2
ENDIF
IF [#1 LE 0] THEN #3000=30 (P9813: the width must be above 0)
G65 P9816 A#2 D#1 Z#26 Q#17 R#18 J#5 K#6
#132=#0
IF [#26 EQ #0]
#133=#138+2*#560
ELSE
#133=#138-2*#560
ENDIF
#134=#133-#1
IF [#2 EQ 1]
#130=#137
#131=#0
ELSE
#130=#0
#131=#137
ENDIF
IF [#19 NE #0] THEN G65 P9817 A#2 B#137 C0 S#19
M99
