(=== IF runs its blocks when the condition holds)
#1=2
IF [#1 EQ 2]
G0 X1
ENDIF
X2
M30
(=== IF without brackets, as HNC writes it, with a comment)
G0
IF #1 LT 0 ; vacant counts as 0
X1
ENDIF
X2
M30
(=== the first condition that holds wins)
G0
#1=2
IF #1 EQ 1
X1
ELSEIF #1 EQ 2
X2
ELSEIF #1 EQ 2
X3
ELSE
X4
ENDIF
X9
M30
(=== ELSE runs when none holds)
G0
IF 0
X1
ELSEIF 0 THEN
X2
ELSE
X3
ENDIF
M30
(=== a condition behind the branch taken is not evaluated)
G0
IF 1
X1
ELSEIF 1/0
X2
ENDIF
M30
(=== inner branches are passed whole when the outer is not taken)
G0
IF 0
IF 1
X1
ELSE
X2
ENDIF
WHILE 1
X3
ENDW
ELSE
IF 1 THEN
X4
ENDIF
ENDIF
M30
(=== ENDIF of an inner IF does not make the outer ELSEIF count)
G0
IF 1
IF 0
X1
ENDIF
ELSEIF 1
X2
ENDIF
X3
M30
(=== WHILE turns while its condition holds)
G0
#1=0
WHILE #1 LT 3
#1=#1+1
X#1
ENDW
X9
M30
(=== WHILE DO with numbers nests)
G0
#1=1
WHILE[#1LE2]DO1
#2=1
WHILE[#2LE2]DO2
X[10*#1+#2]
#2=#2+1
END2
#1=#1+1
END1
M30
(=== the same number may be used again)
G0
WHILE[0]DO1
X1
END1
WHILE[0]DO1
X2
END1
X3
M30
(=== DO without WHILE turns until a jump leaves it)
G0
DO1
#1=#1+1
X#1
IF[#1EQ2]GOTO 9
END1
N9 X9
M30
(=== IF GOTO forward)
G0
IF[1EQ1]GOTO 20
X1
N20 X2
M30
(=== IF GOTO whose condition does not hold goes on)
G0
IF[1EQ2]GOTO 20
X1
N20 X2
M30
(=== GOTO backwards from the top)
G0
N5 #1=#1+1
X#1
IF[#1LT3]GOTO 5
M30
(=== GOTO looks forward first)
G0
GOTO 20
N10 X1
N20 X2
IF[#1EQ1]GOTO 99
#1=1
GOTO 10
N10 X3
N99 M30
(=== GOTO a computed number)
G0
#1=3
GOTO #1
N1 X1
N2 X2
N3 X3
GOTO[#1+1]
X4
N4 M30
(=== N 10 and N0010 are the same)
G0
GOTO 10
X1
n 0010 X2
M30
(=== IF THEN with an assignment)
G0
IF[1EQ1]THEN#1=5
IF[1EQ2]THEN #1=6
X#1
M30
(=== IF THEN with words)
G0
IF [1 EQ 1] THEN X1
IF [1 EQ 2] THEN X2
X3
M30
(=== IF THEN GOTO)
G0
IF [1 EQ 1] THEN GOTO 3
X1
N3 X3
M30
(=== a jump out of two loops leaves both, and the loop around turns on)
G0
#1=0
WHILE #1 LT 2
#1=#1+1
WHILE 1
IF 1
X#1
GOTO 7
ENDIF
ENDW
N7
ENDW
X9
M30
(=== a jump within a loop stays in it)
G0
WHILE #1 LT 2
#1=#1+1
GOTO 5
X8
N5 X#1
ENDW
M30
(=== a jump back out of a loop, into which the program then comes again)
G0
N1 #2=#2+1
#1=0
WHILE #1 LT 2
#1=#1+1
X[10*#2+#1]
IF[[#1EQ1]AND[#2EQ1]]GOTO 1
ENDW
M30
(=== M99 P in the main program jumps)
G0
X1
#1=#1+1
IF[#1EQ2]GOTO 9
M99 P5
N5 X5
M99
N9 M30
(=== what is in comments counts for nothing)
G0
IF 0 (THEN X1)
X1 ;ENDIF
(ENDIF)
ENDIF
X2
M30
