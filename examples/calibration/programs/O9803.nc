O9803 (teaching points of an AC table by the kinematic parameters, from one measured centre at A0 C0)
(G65 P9803 X_ Y_ Z_ U_ V_ W_ J_: centre in machine coordinates; offsets of C as 04c435 .. 437; Y offset of A as 04c433)
(#52008 #52009 #52010 must be set. Sets #52100 .. #52147: A -25 .. 80 by 15, C0; #52800 .. #52847: A0, C 0 .. 315 by 45)
IF [[#24 EQ #0] || [#25 EQ #0] || [#26 EQ #0] || [#52009 EQ #0]] THEN #3000=51 (P9803 needs X Y Z and #52008 #52009 #52010)
#1=#24-#21
#2=#25-#22
#3=#26-#52009-#23
#10=0
WHILE [#10 LT 16] DO 1
#11=52100+#10
#12=15*#10-25
#13=0
IF [#10 GE 8] THEN #11=52800+#10-8
IF [#10 GE 8] THEN #12=0
IF [#10 GE 8] THEN #13=45*#10-360
(C turns about -Z, A about -X)
#14=#1*COS[#13]+#2*SIN[#13]
#15=#2*COS[#13]-#1*SIN[#13]-#5
#[#11]=#14+#21
#[#11+10]=#15*COS[#12]+#3*SIN[#12]+#5+#22
#[#11+20]=#3*COS[#12]-#15*SIN[#12]+#23+#52009+#52008+#52010
#[#11+30]=#12
#[#11+40]=#13
#10=#10+1
END 1
M99
