(=== positions: end of the block, machine and workpiece)
(G55 is at 100 200 300: behind X1 Y2 the machine is at 101 202, and the workpiece at 1 2. Words are read)
(before the G54 of their block acts.)
G55 G0 X1 Y2
G54 X[#5001] Y[#5022] Z[#5041]
(=== modal codes of the blocks before)
G18 G91 G95 G0
G90 X#4002 Y#4003 Z#4005
(=== tool and offset tables are read and written)
(Tool 1: length 50, wear 0.5, radius 4, radius wear 0.1. Variable 5241 is X of G55:)
(1 in it is then 8, and the axes that are not named stay.)
G0 X#2201 Y#2001 Z#2601 A#2401
#5241=7
G55 X1
(=== an alarm of the program stops it with its comment)
#3000=5 (the stock is too long)
(=== a message stops until it is read)
#3006=12 (turn the part)
M30
