O90120 (G12 and G13: circular pocket)
(G12 | G13 I_ [K_ Q_ D_ Z_ L_ X_ Y_ F_]: the centre is where the tool is, or X Y. I: radius of the pocket, or with K that of)
(the first circle, K: radius of the pocket, Q: step from circle to circle; D: number of the cutter radius, D0: I and K are)
(those of the tool's centre; Z: depth, in G91 that of each of L passes; F: feed, into the depth, too. #10: 12 or 13)
(The tool ends at the centre in the depth.)
IF [#4 EQ #0] THEN #3000=65 (G12 and G13 need the radius I)
IF [[#7 EQ #0] && [#4107 EQ 0]] THEN #3000=66 (G12 and G13 need the cutter radius D)
IF [#4002 NE 17] THEN #3000=67 (G12 and G13 need G17)
IF [[#4007 NE 40] || [#4009 NE 80]] THEN #3000=68 (G12 and G13 need G40 and G80)
IF [[#4011 NE 50] || [#4018 NE 15]] THEN #3000=69 (G12 and G13 need G50 and G15)
IF [#4005 EQ 93] THEN #3000=70 (G12 and G13 need G94 or G95)
IF [#12 EQ #0] THEN #12=1
IF [[#12 LT 1] || [#12 NE FIX[#12]]] THEN #3000=71 (G12 and G13: L must be a whole number from 1)
IF [#7 NE #0] THEN D#7
#27=#4199
IF [#27 EQ #0] THEN #3000=72 (G12 and G13: the tool D has no radius)
IF [#4 LE #27] THEN #3000=73 (G12 and G13: the radius I must be above that of the cutter)
IF [#6 EQ #0]
IF [#17 NE #0] THEN #3000=74 (G12 and G13: Q needs K)
ELSE
IF [#6 LE #4] THEN #3000=75 (G12 and G13: K must be above I)
IF [#17 LE 0] THEN #3000=76 (G12 and G13: K needs a step Q above 0)
IF [[#27 GT 0] && [[#4 GE 2*#27] || [#17 GE 2*#27]]] THEN #3000=77 (G12 and G13: with K, I and Q must be below the cutter diameter)
ENDIF
#30=#4030
#33=#4003
#34=#4001
#13=0
IF [[#12 GT 1] && [[#26 EQ #0] || [#33 NE 91]]] THEN #3000=78 (G12 and G13: L passes need Z in G91)
IF [[#24 NE #0] || [#25 NE #0]] THEN G0 X#24 Y#25
IF [#9 NE #0] THEN F#9
IF [[#26 NE #0] && [#33 EQ 91]]
#13=#26
#26=#5003+#26
ENDIF
#31=#5001
#32=#5002
#2=#10-10
#20=#4-#27
#21=#20
IF [#6 NE #0] THEN #21=#6-#27
G90 G91.1
#14=1
WHILE [#14 LE #12]
IF [#26 NE #0] THEN G1 Z#26
(Half a circle leads onto the first circle.)
#22=#20
#23=1
G#2 X[#31+#22] Y#32 I[#22/2] J0
G#2 X[#31+#22] Y#32 I[0-#22] J0
WHILE [#22 LT #21]
#16=#22+#17
IF [#16 GT [#21-0.0001]] THEN #16=#21
(Half a circle that touches both leads from circle to circle, and the last one back to the centre.)
G#2 X[#31-#23*#16] Y#32 I[0-#23*[#22+#16]/2] J0
#22=#16
#23=0-#23
G#2 X[#31+#23*#22] Y#32 I[0-#23*#22] J0
ENDW
G#2 X#31 Y#32 I[0-#23*#22/2] J0
IF [#13 NE 0] THEN #26=#26+#13
#14=#14+1
ENDW
G#33 G#30
IF [#34 LE 3] THEN G#34
M99
