O90370 (G37: measure the length of the tool in the spindle)
(G37 Z_ [H_ R_ D_ F_]: G43 with its length is active, the tool over the sensor and the sensor on. Z: where the tip touches it)
(H: the number of the length, which is the active one; R: distance from Z to which the tool goes in rapid; D: range before and)
(behind Z in which contact is good; F: feed; #27 #28 #29: R D F of 04c767 .. 04c769, #30: the skip input, 04c770)
(What the contact differs from Z by is added to the wear of the length, and the new length is active behind the cycle.)
IF [#26 EQ #0] THEN #3000=50 (G37 needs Z)
IF [[#24 NE #0] || [#25 NE #0]] THEN #3000=51 (G37 measures along Z alone)
IF [AR[#26] NE 90] THEN #3000=52 (G37 needs G90)
IF [#4008 NE 43] THEN #3000=53 (G37 needs G43 with the length of the tool)
IF [#11 EQ #0] THEN #11=#4111
IF [#11 NE #4111] THEN #3000=54 (G37: H must be the active length)
IF [#11 GT 200] THEN #3000=55 (G37: H must be 1 .. 200)
IF [[#4007 NE 40] || [#4009 NE 80]] THEN #3000=56 (G37 needs G40 and G80)
IF [[#4011 NE 50] || [#4022 NE 50.1]] THEN #3000=57 (G37 needs G50 and G50.1)
IF [[#4016 NE 69] || [#4018 NE 15]] THEN #3000=58 (G37 needs G69 and G15)
IF [#4033 NE 0] THEN #3000=64 (G37 needs G54.4 P0)
#31=0.0005
IF [#4006 EQ 20] THEN #31=0.00002
IF [ABS[#5083-#[2200+#11]-#[2000+#11]] GT #31] THEN #3000=59 (G37: the active length is not that of the table: G43 H again)
IF [#18 NE #0] THEN #27=#18
IF [#7 NE #0] THEN #28=#7
IF [#9 NE #0] THEN #29=#9
IF [[#28 LE 0] || [#28 GT #27]] THEN #3000=60 (G37: the range D must be above 0 and at most the distance R)
#32=SIGN[#26-#5003]
IF [#32 EQ 0] THEN #3000=61 (G37: the tool is where the contact is expected)
#33=#4005
#34=#4109
#35=#4001
G0 Z[#26-#32*#27]
G94
G31 P#30 Z[#26+#32*#28] F#29
#36=#5063-#26
G#33
IF [#34 GT 0] THEN F#34
IF [#35 LE 3] THEN G#35
IF [#32*#36 GT [#28-#31]] THEN #3000=62 (G37: no contact of the tool up to the range D behind the expected place)
IF [[0-#32*#36] GT #28] THEN #3000=63 (G37: contact before the range D)
#[2000+#11]=#[2000+#11]+#36
G43 H#11
M99
