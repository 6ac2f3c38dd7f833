 $NAME.MIN%
O1(A)
G0 X1
M2
%
