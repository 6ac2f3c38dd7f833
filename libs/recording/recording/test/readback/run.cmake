# SPDX-License-Identifier: Apache-2.0
# Installs the readers into the build directory when the lock has changed, writes a recording and reads it back.
file(MAKE_DIRECTORY ${WORK}/node)
foreach(name IN ITEMS package.json package-lock.json .npmrc readback.mjs)
  configure_file(${SOURCE}/${name} ${WORK}/node/${name} COPYONLY)
endforeach()
file(SHA256 ${SOURCE}/package-lock.json lock)
set(installed "")
if(EXISTS ${WORK}/installed)
  file(READ ${WORK}/installed installed)
endif()
if(NOT installed STREQUAL lock)
  file(REMOVE ${WORK}/installed)
  execute_process(COMMAND ${NPM} ci --no-audit --no-fund WORKING_DIRECTORY ${WORK}/node COMMAND_ERROR_IS_FATAL ANY)
  file(WRITE ${WORK}/installed ${lock})
endif()
execute_process(COMMAND ${WRITER} ${WORK}/every_topic.mcap ${WORK}/every_topic.json COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${NODE} readback.mjs ${WORK}/every_topic.mcap ${WORK}/every_topic.json
  WORKING_DIRECTORY ${WORK}/node COMMAND_ERROR_IS_FATAL ANY)
