(=== P and Q of modal codes in a block that drills)
G99 G82 Z-1 R0 P100 L0 F100
G64 P0.5 X1
G5.1 Q1 X2
(=== P and L of a call while a cycle is on)
G99 G81 Z-1 R0 L0 F100
M98 P200 L2
