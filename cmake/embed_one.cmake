# Script: writes OUTPUT, a C++ file that holds the bytes of INPUT as the string NAMESPACE::SYMBOL; NAME says in a
# comment what it is. Read and appended quoted, so that ; [ ] " \ @ ${} arrive unchanged; split because compilers
# limit one literal.
file(READ "${INPUT}" text)
set(body "")
string(LENGTH "${text}" length)
set(at 0)
while(at LESS length)
  string(SUBSTRING "${text}" ${at} 12000 piece)
  string(APPEND body "R\"__glsl(${piece})__glsl\"\n")
  math(EXPR at "${at} + 12000")
endwhile()
if(length EQUAL 0)
  set(body "\"\"")
endif()
file(WRITE "${OUTPUT}" "// Generated from ${NAME}.\nnamespace ${NAMESPACE} {\nextern const char* const ${SYMBOL};\nconst char* const ${SYMBOL} =\n${body};\n}\n")
