O9816 (two touches across an axis, from a middle or towards it; called by the measuring cycles)
(G65 P9816 A_ D_ [Z_ Q_ R_ J_ K_]: A1 = X, A2 = Y; D: distance of the surfaces, mm; Z: from outside, at this height)
(#137: middle of both touches, workpiece coordinates; #138: their distance. The axes end on the middle, at their height.)
IF [#17 EQ #0] THEN #17=10
IF [#18 EQ #0] THEN #18=5
IF [#5 EQ #0] THEN #5=300
IF [#6 EQ #0] THEN #6=50
#30=#4003
G90 G94
#10=#5041
#11=#5042
#12=#5043
#20=2-#1
#21=#1-1
(From the middle: how far a touch is approached in positioning feed. From outside: how far outside it begins.)
IF [#26 EQ #0]
#13=#7/2-#560-#18
IF [#13 LT 0] THEN #13=0
#14=#7/2-#13+#17
#15=1
ELSE
#13=#7/2+#560+#18
#14=#18+#17
#15=-1
ENDIF
#22=1
WHILE [#22 GE -1]
G1 X[#10+#22*#20*#13] Y[#11+#22*#21*#13] F1000
IF [#26 NE #0] THEN Z#26
G65 P9801 X[#15*#22*#20] Y[#15*#22*#21] Z0 D#14 J#5 K#6 R1
IF [#26 NE #0] THEN Z#12
IF [#22 EQ 1] THEN #23=#20*#141+#21*#142
#22=#22-2
ENDW
#24=#20*#141+#21*#142
#137=[#23+#24]/2
#138=#23-#24
IF [#1 EQ 1]
G1 X#137 Y#11 F1000
ELSE
G1 X#10 Y#137 F1000
ENDIF
G#30
M99
