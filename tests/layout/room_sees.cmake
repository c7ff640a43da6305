string(REPLACE "|" ";" folders "${FOLDERS}")
list(TRANSFORM folders PREPEND -I)
execute_process(COMMAND ${COMPILER} -E -P -x c++ ${folders} ${PROBE} RESULT_VARIABLE code OUTPUT_VARIABLE seen
                ERROR_VARIABLE error)
string(REGEX REPLACE "[ \n]+" ";" seen "${seen}")
string(REGEX REPLACE "^;|;$" "" seen "${seen}")
if(NOT code EQUAL 0 OR NOT seen STREQUAL "${EXPECTED}")
  message(FATAL_ERROR "sees ${seen}, expected ${EXPECTED}\n${error}")
endif()
