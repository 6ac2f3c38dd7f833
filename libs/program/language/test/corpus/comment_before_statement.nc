(ó)IF 61
(a)N10(b)/2 IF 1 THEN
