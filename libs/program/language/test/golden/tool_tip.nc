(=== G43.4 names the same place by the tip, the machine stands, G49 takes it back)
(Tool 1 is 50 long: machine Z 100 is the tip at Z 50 while the rotary axes are at zero.)
G0 Z100
G43.4 H1
G1 X1 F100
G49
(=== rotary words turn the axes about a tip that stays)
G43.4 H1
G0 A30 C-20
(=== G43 and G44 put the length along Z)
(Z0 of the tool is 80.5 with its length added, and -50 with the length of the other one subtracted.)
G43 H2 G0 Z0
G44 H1 Z0
