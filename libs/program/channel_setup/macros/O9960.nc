O9960 (CYCLE9960: measure the kinematics with a probe and a sphere)
(Arguments as in docs/calibration.md: #1 .. #21. The parts are written by the service `measurement`.)
IF [#4006 NE 21] THEN #3000=1 (CYCLE9960: G21 is needed)
IF [#4007 NE 40] THEN #3000=2 (CYCLE9960: G40 is needed)
IF [#4009 NE 80] THEN #3000=3 (CYCLE9960: G80 is needed)
IF [[#4011 NE 50] || [#4022 NE 50.1]] THEN #3000=4 (CYCLE9960: G50 G50.1 are needed)
IF [[#4016 NE 69] || [#4018 NE 15]] THEN #3000=4 (CYCLE9960: G69 G15 are needed)
IF [#4008 EQ 43.5] THEN #3000=5 (CYCLE9960: G43.4 or G49 is needed, not G43.5)
(What the parts change is as before behind the cycle.)
#34=#4002
#35=#4003
#36=#4005
#37=#4008
#38=#4111
#39=#4014
#40=#4015
#41=#4109
#42=#4001
#43=#4130
#52999=0
#3100=9960
WHILE [#3100 EQ 1]
M98 P99601
#3100=0
ENDW
G#34 G#35 G94
IF [#39 EQ 54.1]
G54.1 P#43
ELSE
G#39
ENDIF
IF [#37 EQ 43] THEN G43 H#38
IF [#37 EQ 43.4] THEN G43.4 H#38
G#40
G#36
IF [#41 GT 0] THEN F#41
IF [#42 LE 1] THEN G#42
M99
