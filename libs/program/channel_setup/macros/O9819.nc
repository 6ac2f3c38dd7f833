O9819 (what the measuring cycles need)
(G65 P9819 S_)
IF [#4006 NE 21] THEN #3000=34 (measuring cycle: G21 is needed)
IF [#4007 NE 40] THEN #3000=35 (measuring cycle: G40 is needed)
IF [#4009 NE 80] THEN #3000=36 (measuring cycle: G80 is needed)
IF [[#4011 NE 50] || [#4022 NE 50.1]] THEN #3000=37 (measuring cycle: G50 G50.1 are needed)
IF [[#4016 NE 69] || [#4018 NE 15]] THEN #3000=38 (measuring cycle: G69 G15 are needed)
IF [#4033 NE 0] THEN #3000=46 (measuring cycle: G54.4 P0 is needed)
IF [[#4008 EQ 43.4] || [#4008 EQ 43.5]] THEN #3000=39 (measuring cycle: G43 or G49 is needed, not RTCP)
IF [#560 LE 0] THEN #3000=40 (measuring cycle: the probe is not calibrated: G65 P9810 in a ring gauge)
IF [#19 EQ #0] THEN M99
IF [[#19 LT 1] || [#19 GT 6] || [#19 NE FIX[#19]]] THEN #3000=41 (measuring cycle: S must be 1 .. 6 for G54 .. G59)
M99
