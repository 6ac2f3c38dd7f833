O9801 (touch along a direction, twice)
(G65 P9801 X_ Y_ Z_ D_ J_ K_ R_)
(X Y Z: unit vector; D: search distance, mm; J K: feeds of the first and of the second touch, mm/min; R: retract, mm)
(#141 #142 #143: the second touch, workpiece coordinates. The axes return to where they began.)
IF [[#7 EQ #0] || [#5 EQ #0] || [#6 EQ #0] || [#18 EQ #0]] THEN #3000=1 (P9801 needs X Y Z D J K R)
IF [ABS[#24*#24+#25*#25+#26*#26-1] GT 0.001] THEN #3000=2 (P9801: X Y Z must be a unit vector)
IF [[#5 LE #6] || [#6 LE 0]] THEN #3000=3 (P9801: J must be above K and K above 0)
#30=#4003
G90 G94
#10=#5041
#11=#5042
#12=#5043
G31 L1 X[#10+#24*#7] Y[#11+#25*#7] Z[#12+#26*#7] F#5
#13=SQRT[[#5061-#10]*[#5061-#10]+[#5062-#11]*[#5062-#11]+[#5063-#12]*[#5063-#12]]
IF [ABS[#13-#7] LT 0.0005] THEN #3000=4 (no contact of the probe within the search distance)
#14=#5061-#24*#18
#15=#5062-#25*#18
#16=#5063-#26*#18
G1 X#14 Y#15 Z#16 F#5
G31 L1 X[#14+2*#24*#18] Y[#15+2*#25*#18] Z[#16+2*#26*#18] F#6
#13=SQRT[[#5061-#14]*[#5061-#14]+[#5062-#15]*[#5062-#15]+[#5063-#16]*[#5063-#16]]
IF [ABS[#13-2*#18] LT 0.0005] THEN #3000=5 (no contact of the probe in the second touch)
#141=#5061
#142=#5062
#143=#5063
G1 X#10 Y#11 Z#12 F#5
G#30
M99
