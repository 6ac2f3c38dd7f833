O9817 (a work offset from a measured coordinate; called by the measuring cycles)
(G65 P9817 A_ B_ C_ S_: A1 = X, A2 = Y, A3 = Z; B: measured, workpiece coordinates; C: the coordinate it gets; S: 1 .. 6)
#10=#[5020+#1]-#[5040+#1]-#[5080+#1]
#[5220+20*[#19-1]+#1]=#2-#3+#10-#[5200+#1]
M99
