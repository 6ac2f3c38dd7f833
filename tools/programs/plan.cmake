# SPDX-License-Identifier: Apache-2.0
execute_process(COMMAND ${PYTHON} -B ${GENERATOR} ${OPTION} --length 50 --output ${OUTPUT} RESULT_VARIABLE status)
if(NOT status EQUAL 0)
  message(FATAL_ERROR "${GENERATOR} failed: ${status}")
endif()
# 50 mm of 0.1 mm blocks.
execute_process(COMMAND ${TRUNNION} plan ${OUTPUT} --machine ac-table OUTPUT_VARIABLE report RESULT_VARIABLE status)
if(NOT status EQUAL 0 OR NOT report MATCHES "\"blocks\": 500")
  message(FATAL_ERROR "${OUTPUT} is not planned: ${report}")
endif()
