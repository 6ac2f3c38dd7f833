O9818 (centre by touches across X, Y and X again; called by the measuring cycles)
(G65 P9818 D_ [Z_ Q_ R_ J_ K_] as P9812; #130 #131: centre; #135 #136: distances of the touches in X and in Y)
G65 P9816 A1 D#7 Z#26 Q#17 R#18 J#5 K#6
G65 P9816 A2 D#7 Z#26 Q#17 R#18 J#5 K#6
#10=#137
#11=#138
G65 P9816 A1 D#7 Z#26 Q#17 R#18 J#5 K#6
#130=#137
#131=#10
#135=#138
#136=#11
M99
