 G 0 X 1 . 5 Y - .5 Z1. 25
G 43 . 1 X1 .5
X5 5
N + 5 X1
,R1 .5 X1 .5
G65 P1 I1 . 5 I2 .5
 N5  ELSE 
G28.2 X . 5
