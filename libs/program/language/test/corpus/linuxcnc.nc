 %
(MSG, a program of LinuxCNC)
o<Sub One> sub
  #<a>=[#1+2*SIN[30]**2] #<_b>=#2 (DEBUG,%.3f#<a> #31)
  o101 if [#<a> GT 3 AND EXISTS[#<_b>]]
    o<subone> return [#<a>]
  o101 elseif [#1 EQ 0]
    o102 repeat [2]
      G91 G1 X1 F1 00
    o102 endrepeat
  o101 else
    G90
  o101 endif
o<subone> endsub [7]
N10.5 o<sub one> call [1] [ATAN[1]/[2]] (note)
#1=0
o103 do
  #1=[#1+1]
  o104 while [1]
    o103 continue
  o104 endwhile
o103 while [#1 LT 3]
o105 while [#<_value> LT 9]
  o105 break
o105 endwhile
o10 call [5]
o<sub> call
M98 P100 L2
G0 X##1 Y-#5420 M19 R45 Q2 M50 P1 S-0 $0
G90.1 G2 X2 I1 J0 P2 G4 P0.1
G80
M2
O100
G3 I1
M99
%
