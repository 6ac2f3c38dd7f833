O90800 (CYCLE800: swivel to a plane)
(CYCLE800 alone, or with the name 0, takes the plane back and moves nothing. Arguments: #1 retract, #2 0 where the name is 0,)
(#3 status, #4 mode, #5 #6 #7 reference point, #8 #9 #10 angles, #11 #12 #13 zero behind the rotation, #14 direction,)
(#16 plane. #31 .. #39: the rotation, row by row)
IF [[#1 EQ #0] && [#4 EQ #0]] THEN #2=0
IF [#2 EQ 0] GOTO 90
IF [[#4002 NE 17] || [#4007 NE 40] || [#4009 NE 80]] THEN #3000=100 (CYCLE800 needs G17, G40 and G80)
IF [[#4011 NE 50] || [#4022 NE 50.1] || [#4018 NE 15]] THEN #3000=101 (CYCLE800 needs G50, G50.1 and G15)
IF [[#1 NE #0] && [#1 NE 0] && [#1 NE 1] && [#1 NE 2]] THEN #3000=102 (CYCLE800, argument 1: retract 0 none, 1 Z, 2 Z and then X Y)
IF [[#1 GT 0] && [[#4008 EQ 43.4] || [#4008 EQ 43.5]]] THEN #3000=103 (CYCLE800, argument 1: a retract needs G43 or G49)
#17=#3 MOD 10
#18=FIX[#3/10] MOD 10
IF [#17 NE 0] THEN #3000=104 (CYCLE800, argument 3: additive is not possible: give the whole rotation in one call)
IF [[FIX[#3/100] MOD 1000 NE 0] || [#18 GT 1] || [#3 LT 0] || [#3 GE 300000]] THEN #3000=105 (CYCLE800, argument 3: this status is not possible)
IF [[#14 NE 1] && [#14 NE -1]] THEN #3000=106 (CYCLE800, argument 14: the direction must be 1 or -1, the axes turn)
IF [#16 MOD 10 GT 1] THEN #3000=107 (CYCLE800, argument 16: only G17 is possible)
#21=FIX[#4/64]
#22=#4 MOD 64
IF [[#4 LT 0] || [#4 GE 256] || [#4 NE FIX[#4]]] THEN #3000=108 (CYCLE800, argument 4: this mode is not possible)
IF [#21 EQ 3] THEN #3000=109 (CYCLE800, argument 4: direct positions are not possible: G0 with the axes, then G68.2)
IF [#21 EQ 1]
(Solid angle: about Z, and then about Y.)
IF [ABS[#10] GT 0] THEN #3000=110 (CYCLE800, argument 10: a solid angle has no third one)
#22=11
ELSEIF [#21 EQ 2]
(Projection angles about X and Y: the new X axis is in the old ZX plane.)
IF [[#22 NE 57] && [#22 NE 54]] THEN #3000=111 (CYCLE800, argument 4: projection angles are possible as 185 and 182)
#23=#8 #24=#9
IF [#22 EQ 54] THEN #23=#9 #24=#8
IF [[ABS[#23] GE 90] || [ABS[#24] GE 90]] THEN #3000=112 (CYCLE800: projection angles must be below 90 degrees)
#8=#24
#9=ATAN[TAN[#23]*COS[#24]]
#22=54
ELSE
#23=[#22 EQ 27]+[#22 EQ 30]+[#22 EQ 39]+[#22 EQ 45]+[#22 EQ 54]+[#22 EQ 57]
IF [#23 EQ 0] THEN #3000=113 (CYCLE800, argument 4: axis by axis is possible as 27, 30, 39, 45, 54 and 57)
ENDIF
#31=1 #32=0 #33=0 #34=0 #35=1 #36=0 #37=0 #38=0 #39=1
(Two bits of the mode for each rotation: 1 X, 2 Y, 3 Z.)
#24=1
WHILE [#24 LE 3]
#25=#22 MOD 4
#22=FIX[#22/4]
IF [#25 GT 0]
#26=COS[#[7+#24]]
#27=SIN[#[7+#24]]
#28=#25 MOD 3
#29=[#25+1] MOD 3
#30=0
WHILE [#30 LT 3]
#40=#[31+3*#30+#28]
#41=#[31+3*#30+#29]
#[31+3*#30+#28]=#26*#40+#27*#41
#[31+3*#30+#29]=#26*#41-#27*#40
#30=#30+1
ENDW
ENDIF
#24=#24+1
ENDW
(The same as rotations about the fixed axes X, Y and Z, and where the zero of the plane is.)
#44=SQRT[#38*#38+#39*#39]
IF [#44 LT 0.000000001]
#45=ATAN[0-SIGN[#37]*#32,#35]
#46=0-90*SIGN[#37]
#47=0
ELSE
#45=ATAN[#38,#39]
#46=ATAN[0-#37,#44]
#47=ATAN[#34,#31]
ENDIF
#41=#5+#31*#11+#32*#12+#33*#13
#42=#6+#34*#11+#35*#12+#36*#13
#43=#7+#37*#11+#38*#12+#39*#13
#29=#4001
#30=#4003
IF [#4016 EQ 68.2] THEN G69
IF [#1 GT 0] THEN G91 G28 Z0
IF [#1 EQ 2] THEN G91 G28 X0 Y0
G#30
(Without any rotation and zero the axes go to 0, and no plane is active behind.)
#48=ABS[#31-1]+ABS[#35-1]+ABS[#39-1]+ABS[#41]+ABS[#42]+ABS[#43]
IF [[#48 GT 0.0000000001] || [#4008 EQ 43.4] || [#4008 EQ 43.5]] GOTO 30
#21=#5024 #22=#5025 #23=#5026
IF [#21 NE #0] THEN #21=0
IF [#22 NE #0] THEN #22=0
IF [#23 NE #0] THEN #23=0
IF [[#21 NE #0] || [#22 NE #0] || [#23 NE #0]] THEN G53 G0 A#21 B#22 C#23
IF [#29 LE 3] THEN G#29
M99
N30 #27=3
IF [#14 EQ -1] THEN #27=4
#26=53.1
IF [#18 EQ 1] THEN #26=53.2
G68.3 X#41 Y#42 Z#43 I#45 J#46 K#47 P#27
G#26
M99
N90 IF [#4016 EQ 68.2] THEN G69
M99
