%
(homes every axis in the order of O9990)
M98 P9990
M30
%
