%
O9990 (homes every axis: first Z, which takes the tool out of the way)
G28.2 Z0
G28.2 X0 Y0
M99
%
