(=== two leads are one thread, and F is no feed)
G94 F200 S500 M3
G0 X10 Z2
G33 Z-20 F1.5 Q90
X12 Z-40 F2
G1 Z-50
(=== inch, counter-clockwise)
G20 S500 M4
G32 Z-1 F0.1
(=== lead that grows in each revolution)
S500 M3
G34 Z-10 F1 K0.1
Z-20 K0.2
(=== F of a skip move is a feed)
S500 M3 G33 F2
G31 Z-1 F100
G33 Z-5
