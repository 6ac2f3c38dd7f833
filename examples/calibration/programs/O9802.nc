O9802 (centre of a sphere by five touches: four at the equator, one from above)
(G65 P9802 D_ R_ S_ I_ J_ K_, the probe on and S above the highest point, found by eye)
(D: diameter of the sphere, mm; R: radius of the ball, mm; S: safe height, mm; I J K: feeds F1 F2 F3, mm/min)
(#110 #111 #112: centre, workpiece coordinates; #113: radius at which the ball touched; #115 #116 #117: centre, machine)
IF [[#7 EQ #0] || [#18 EQ #0] || [#19 EQ #0]] THEN #3000=11 (P9802 needs D R S I J K)
IF [[#7 LE 0] || [#18 LE 0]] THEN #3000=12 (P9802: D and R must be above 0)
IF [#19 LT 1] THEN #3000=13 (P9802: the safe height S must be 1 mm or more)
IF [[#4 LE #5] || [#5 LE #6] || [#6 LE 0]] THEN #3000=14 (P9802: the feeds must be I above J above K above 0)
#30=#4003
G90 G94
#1=#7/2+#18
#10=#5041
#11=#5042
#12=#5043
G65 P9801 X0 Y0 Z-1 D[2*#19] J#5 K#6 R1
#13=#143-#1
(X, from +X and -X)
G1 X[#10+#1+#19] F#4
Z#13
G65 P9801 X-1 Y0 Z0 D[2*#19] J#5 K#6 R1
#14=#141
G1 Z#12 F#4
X[#10-#1-#19]
Z#13
G65 P9801 X1 Y0 Z0 D[2*#19] J#5 K#6 R1
#10=[#14+#141]/2
G1 Z#12 F#4
X#10
(Y, from +Y and -Y)
Y[#11+#1+#19]
Z#13
G65 P9801 X0 Y-1 Z0 D[2*#19] J#5 K#6 R1
#15=#142
G1 Z#12 F#4
Y[#11-#1-#19]
Z#13
G65 P9801 X0 Y1 Z0 D[2*#19] J#5 K#6 R1
#11=[#15+#142]/2
#16=[#15-#142]/2
G1 Z#12 F#4
Y#11
(from above, over the centre)
G65 P9801 X0 Y0 Z-1 D[2*#19] J#5 K#6 R1
(The touches in Y are #16 from the centre line and #17 below the highest: #113 is the radius of the circle through them)
#17=#143-#13
#113=[#17*#17+#16*#16]/[2*#17]
#110=#10
#111=#11
#112=#143-#113
IF [ABS[#113-#1] GT 0.5] THEN #3000=15 (the measured sphere differs by more than 0.5 mm in radius: check probe and D)
#115=#110+#5021-#5041
#116=#111+#5022-#5042
#117=#112+#5023-#5043
G#30
M99
