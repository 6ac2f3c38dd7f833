(Measures the rotary axes of the machine of calibrate.sh from a program: above the sphere, then CYCLE9960; its arguments are in docs/calibration.md)
G21 G90 G94 G49 G54
G53 G0 Z0
G53 G0 X60 Y40 A0 C0
G53 G1 Z-282.5 F3000
CYCLE9960(11400,"TOOL_CARR_KIN",1,25,0,-60,60,3,0,0,0,240,3,0,0.001,2,2,1,1,0,1)
G53 G1 Z0 F3000
M30
