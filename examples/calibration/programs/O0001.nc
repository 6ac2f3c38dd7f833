%001 (calibration of two rotary axes: measures a sphere at 8 teaching points of either axis, RTCP off)
(Inputs, docs/calibration-programs.md:)
(#52000 type 0 1 2; #52001 order of the axes in the report 0 1; #52002 #52003 first and second rotary axis: 4 A, 5 B, 6 C; #52004 safe height; #52005 #52006 #52007 F1 F2 F3;)
(#52008 radius of the sphere; #52009 tool length; #52010 tool radius; #52011 Z of the retract plane, machine coordinates;)
(#52012 side that is left out, as Q of P002; #52013 permitted range of the repeatability check, vacant 0.005 mm;)
(teaching points i = 0 .. 7 of the first axis: #[52100+i] X, #[52110+i] Y, #[52120+i] Z, #[52130+i] first, #[52140+i] second)
(rotary axis; of the second axis the same from #52800 on, with #52800 X .. #52840 second rotary axis.)
(Outputs of point n = 0 .. 15: touches #[52150+40*n] .., centre #[52900+3*n] .., radius #[52950+n]; #52999 points measured.)
G21 G17 G90 G94 G40 G80 G49 G54
#52999=0
IF [[#52000 NE 0] && [#52000 NE 1] && [#52000 NE 2]] THEN #3000=31 (#52000, the calibration type, must be 0, 1 or 2)
IF [[#52001 NE #0] && [#52001 NE 0] && [#52001 NE 1]] THEN #3000=43 (#52001, the order of the axes in the report, must be 0 or 1)
IF [[#52002 LT 4] || [#52002 GT 6] || [#52003 LT 4] || [#52003 GT 6]] THEN #3000=32 (#52002 #52003, the rotary axes, must be 4, 5 or 6)
IF [#52002 EQ #52003] THEN #3000=33 (#52002 and #52003 must be two axes)
IF [[#52004 LT 1] || [#52004 GT 100]] THEN #3000=34 (#52004, the safe height, must be 1 to 100 mm)
IF [[#52005 LE #52006] || [#52006 LE #52007] || [#52007 LE 0]] THEN #3000=35 (the feeds must be F1 above F2 above F3 above 0)
IF [[#52008 LE 0] || [#52008 GT 100]] THEN #3000=36 (#52008, the radius of the sphere, must be above 0 and at most 100 mm)
IF [[#52009 LT 0] || [#52009 GT 2000]] THEN #3000=37 (#52009, the tool length, must be 0 to 2000 mm)
IF [[#52010 LE 0] || [#52010 GT 100]] THEN #3000=38 (#52010, the tool radius, must be above 0 and at most 100 mm)
IF [#52011 EQ #0] THEN #3000=39 (#52011, the retract plane, is missing)
#1=0
WHILE [#1 LT 16] DO 1
#2=52100+#1
IF [#1 GE 8] THEN #2=52800+#1-8
#3=0
WHILE [#3 LT 5] DO 2
IF [#[#2+10*#3] EQ #0] THEN #3000=40 (a teaching point has a vacant coordinate)
#3=#3+1
END 2
IF [#[#2+20]+#52004 GT #52011] THEN #3000=41 (a teaching point and its safe height are above the retract plane)
#1=#1+1
END 1
M40
#1=0
WHILE [#1 LT 16] DO 1
#2=52100+#1
IF [#1 GE 8] THEN #2=52800+#1-8
G90 G53 G0 Z#52011
#4=#[#2+30]
#5=#[#2+40]
IF [#52002 EQ 4] THEN G0 A#4
IF [#52002 EQ 5] THEN G0 B#4
IF [#52002 EQ 6] THEN G0 C#4
IF [#52003 EQ 4] THEN G0 A#5
IF [#52003 EQ 5] THEN G0 B#5
IF [#52003 EQ 6] THEN G0 C#5
IF [#1 GT 0] GOTO 10
(repeatability of G31: five touches of the highest point)
G1 X[#[#2]-#5021+#5041] Y[#[#2+10]-#5022+#5042] F#52005
Z[#[#2+20]+#52004-#5023+#5043]
#6=1000000
#7=-1000000
#8=0
WHILE [#8 LT 5] DO 2
G65 P9801 X0 Y0 Z-1 D[2*#52004] J#52006 K#52007 R1
IF [#143 LT #6] THEN #6=#143
IF [#143 GT #7] THEN #7=#143
#8=#8+1
END 2
#52970=#7-#6
#9=0.005
IF [#52013 NE #0] THEN #9=#52013
IF [#52970 GT #9] THEN #3000=42 (five touches of one point differ by #52970, more than is permitted: check the probe)
N10 G65 P002 X#[#2] Y#[#2+10] Z#[#2+20] Q[#52012+0]
#3=52150+40*#1
#[#3]=#50
#[#3+1]=#51
#[#3+2]=#52
#[#3+10]=#53
#[#3+11]=#54
#[#3+12]=#55
#[#3+20]=#56
#[#3+21]=#57
#[#3+22]=#58
#[#3+30]=#59
#[#3+31]=#60
#[#3+32]=#61
#[52900+3*#1]=#62
#[52901+3*#1]=#63
#[52902+3*#1]=#64
#[52950+#1]=#65
#52999=#1+1
#1=#1+1
END 1
G90 G53 G0 Z#52011
M41
M30
%
