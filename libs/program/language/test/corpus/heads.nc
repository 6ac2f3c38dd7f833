 %O1000(PLATE)
/1/3 N5 G0 X1 /2 Y1
(c) :1000
<NAME-1>
O<NAME.2> (c)
N1 :20
% TITLE 12
% X5
% (c) #1=2
: 30
G0 X#1/2 Y1
//3 X1
