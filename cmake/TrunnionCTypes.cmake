# SPDX-License-Identifier: Apache-2.0
# For programs in C with plain Cyclone DDS, here and with the installed package: trunnion_IDL_DIRECTORY has the
# contracts, trunnion_SDK_DIRECTORY contract.h.
find_program(trunnion_idlc idlc REQUIRED)
find_library(trunnion_ddsc ddsc REQUIRED)

# Adds to `target` the types that idlc makes of the named files of the contract (stream, service, ...) and contract.h.
function(trunnion_c_types target)
  set(out ${CMAKE_CURRENT_BINARY_DIR}/generated)
  file(MAKE_DIRECTORY ${out})
  foreach(name IN LISTS ARGN)
    # Without type information, which mixed clusters do not match by.
    add_custom_command(OUTPUT ${out}/${name}.c ${out}/${name}.h
      COMMAND ${trunnion_idlc} -t -o ${out} ${trunnion_IDL_DIRECTORY}/${name}.idl
      DEPENDS ${trunnion_IDL_DIRECTORY}/${name}.idl VERBATIM)
    target_sources(${target} PRIVATE ${out}/${name}.c ${out}/${name}.h)
  endforeach()
  target_include_directories(${target} PRIVATE ${out} ${trunnion_SDK_DIRECTORY})
  target_link_libraries(${target} PRIVATE ${trunnion_ddsc})
  if(TARGET sdk_generated)
    add_dependencies(${target} sdk_generated)
  endif()
endfunction()
