O9810 (calibrate the touch probe in a ring gauge)
(G65 P9810 D_ [R_ J_ K_]: the probe on, the ball in the bore near its centre, at the height to measure)
(D: diameter of the bore, mm; R: radius of the ball, mm: with it touches from above are corrected, too)
(J K: feeds of the first and of the second touch, 300 and 50 mm/min without them)
(#560: radius at which the ball touches, #561: how much later it touches than R says, mm; both are kept)
IF [#7 EQ #0] THEN #3000=20 (P9810 needs the diameter D of the ring gauge)
IF [#7 LE 0] THEN #3000=21 (P9810: D must be above 0)
#560=0
G65 P9818 D#7 J#5 K#6
#10=[#7-[#135+#136]/2]/2
#560=#0
IF [[#10 LE 0] || [2*#10 GE #7]] THEN #3000=22 (P9810: this is not the diameter of the bore: check D and the probe)
IF [ABS[#135-#136] GT 0.05] THEN #3000=23 (P9810: the diameters in X and Y differ by more than 0.05 mm: check the stylus)
#560=#10
#561=#0
IF [#18 EQ #0] THEN M99
IF [ABS[#18-#10] GT 0.5] THEN #3000=42 (P9810: the ball touches more than 0.5 mm from its radius R: check R and D)
#561=#18-#10
M99
