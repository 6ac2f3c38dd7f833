(=== what binds first, and brackets)
(1 + 6, 9, 7 - 4 = 3 and 3 * 2.)
G0 X[1+2*3] Y[[1+2]*3] Z[7-[8/2]] A[3*2]
(=== functions take degrees)
G0 X[100*SIN[30]] Y[100*COS[60]] Z[ATAN[1]/[1]] A[ATAN[1,-1]]
(=== rounding: to the nearest, down to zero, up from zero)
G0 X[ROUND[2.5]] Y[FIX[-2.7]] Z[FUP[2.1]] A[ABS[-3]] B[SQRT[16]]
(=== logarithm, power and the remainder)
G0 X[LN[EXP[2]]] Y[POW[2,10]] Z[17 MOD 5]
(=== comparisons in words and signs, and bits)
(6 AND 3 is 2; 6 OR 3 is 7; 6 XOR 3 is 5.)
G0 X[6 AND 3] Y[6 OR 3] Z[6 XOR 3] A[2 GT 1] B[2 <= 1] C[1 EQ 1 && NOT[0]]
(=== a variable may name a variable, and a vacant word is left out)
#1=2 #2=5
G0 X#[#1] Y#3 Z-#2
