# SPDX-License-Identifier: Apache-2.0
# Turns a text file into a C++ string constant: cmake -DINPUT= -DOUTPUT= -DNAMESPACE= -DNAME= -P embed.cmake
file(READ ${INPUT} text)
string(LENGTH "${text}" length)
set(parts "")
set(at 0)
while(at LESS length)  # raw string literals have a portable limit, so the text is cut into pieces
  string(SUBSTRING "${text}" ${at} 8000 part)
  string(APPEND parts "R\"__text(${part})__text\"\n")
  math(EXPR at "${at} + 8000")
endwhile()
file(WRITE ${OUTPUT} "namespace ${NAMESPACE} {\nextern const char* const ${NAME};\nconst char* const ${NAME} =\n${parts};\n}\n")
