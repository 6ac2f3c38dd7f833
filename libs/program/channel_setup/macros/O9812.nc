O9812 (measure a bore or a boss)
(G65 P9812 D_ [Z_ X_ Y_ S_ Q_ R_ J_ K_]: the probe on, near the axis; bore: at the height to measure; boss: above it)
(D: diameter, mm; Z: it is a boss, and Z the height to measure, workpiece coordinates; X Y: coordinates that its centre gets)
(in S, 0 without them; S: 1 .. 6, G54 .. G59; Q: search distance beyond, 10 mm without it; R: clearance, 5 mm without it)
(#130 #131: centre, workpiece coordinates; #133: diameter; #134: it less D; #135 #136: diameters in X and in Y)
#130=#0 #131=#0 #132=#0 #133=#0 #134=#0 #135=#0 #136=#0
IF [#7 EQ #0] THEN #3000=27 (P9812 needs the diameter D)
IF [#7 LE 0] THEN #3000=28 (P9812: D must be above 0)
G65 P9819 S#19
G65 P9818 D#7 Z#26 Q#17 R#18 J#5 K#6
#132=#0
IF [#26 EQ #0]
#135=#135+2*#560
#136=#136+2*#560
ELSE
#135=#135-2*#560
#136=#136-2*#560
ENDIF
#133=[#135+#136]/2
#134=#133-#7
IF [#19 EQ #0] THEN M99
IF [#24 EQ #0] THEN #24=0
IF [#25 EQ #0] THEN #25=0
#10=#131
G65 P9817 A1 B#130 C#24 S#19
G65 P9817 A2 B#10 C#25 S#19
M99
