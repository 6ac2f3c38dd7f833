# SPDX-License-Identifier: Apache-2.0
execute_process(COMMAND ${PYTHON} -B ${GENERATOR} --machine ${MACHINE} --output ${OUTPUT} RESULT_VARIABLE status)
if(NOT status EQUAL 0)
  message(FATAL_ERROR "${GENERATOR} failed: ${status}")
endif()
execute_process(COMMAND ${CMAKE_COMMAND} -E compare_files ${OUTPUT} ${COMMITTED} RESULT_VARIABLE status)
if(NOT status EQUAL 0)
  message(FATAL_ERROR "${COMMITTED} is not what ${GENERATOR} writes: run it again with --output")
endif()
