(=== G68.2 moves nothing; its words are the plane's, turned about Z by I and from its origin)
(X5 of the plane is Y5 beside its origin 10 0. The plane's Z is the workpiece's, so there is no swing.)
G43.4 H1
G68.2 X10 Y0 Z0 I90 J0 K0
G53.2
G0 X5 Y0
G69
G0 X1
(=== behind G68.2 the swing must come, alone)
G43.4 H1
G68.2 X0 Y0 Z0 I0 J0 K0
G0 X1
(=== without tool tip control G43 behind the swing acts along the tool)
G68.2 X10 Y0 Z0 I90 J0 K0
G53.1
G43 H1
G0 X5 Y0 Z20
G69
G0 X1
