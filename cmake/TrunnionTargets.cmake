# SPDX-License-Identifier: Apache-2.0
# The functions of every directory's CMakeLists.txt, which then says only what is in it.

# What every target of ours is compiled with. Fused multiply-add would make the stream depend on the
# compiler's choice of instruction, so contraction is off everywhere.
add_library(trunnion_options INTERFACE)
# A name of another source that is compiled in the same unit (CMake's unity build) may be a local one here.
target_compile_options(trunnion_options INTERFACE -Wall -Wextra $<$<CXX_COMPILER_ID:GNU>:-Wshadow=local> -Wnon-virtual-dtor
  -ffp-contract=off)
option(TRUNNION_SANITIZE "Build with the address and undefined-behaviour sanitizers" OFF)
if(TRUNNION_SANITIZE)
  add_compile_options(-fsanitize=address,undefined -fno-sanitize-recover=all -fno-omit-frame-pointer)
  add_link_options(-fsanitize=address,undefined)
  # Eigen would allocate in another way under the sanitizer than in the library OMPL, which frees what we allocate.
  add_compile_definitions(EIGEN_MALLOC_ALREADY_ALIGNED=1)
  set(trunnion_test_timeout 1800)
else()
  set(trunnion_test_timeout 600)
endif()
option(TRUNNION_THREAD_SANITIZE "Build with the thread sanitizer" OFF)
if(TRUNNION_THREAD_SANITIZE)
  add_compile_options(-fsanitize=thread -fno-omit-frame-pointer)
  add_link_options(-fsanitize=thread)
  set(trunnion_test_timeout 1800)
endif()
option(TRUNNION_FUZZ "Build the libFuzzer targets (needs clang)" OFF)
set(TRUNNION_FUZZ_SECONDS 6 CACHE STRING "How long the test of a fuzzer searches")
if(TRUNNION_FUZZ)
  # Without coverage of the libraries themselves a fuzzer searches blindly.
  add_compile_options(-fsanitize=fuzzer-no-link)
endif()

# Headers that nearly every source reads are compiled once: those of the standard library and Eigen for the product, the
# test framework besides for tests. Only names in angle brackets, so that every checkout has the same bytes and the compiler
# cache serves them all. A header of ours must still include what it uses: `make lint` compiles without these.
set(common_headers <algorithm> <array> <atomic> <chrono> <cmath> <condition_variable> <cstdint> <cstring> <deque> <filesystem>
  <fstream> <functional> <iostream> <map> <memory> <mutex> <optional> <set> <span> <sstream> <stdexcept> <string> <string_view>
  <thread> <utility> <variant> <vector> <Eigen/Dense>)
file(GENERATE OUTPUT ${CMAKE_BINARY_DIR}/precompiled.cpp CONTENT "")
function(trunnion_precompiled name)
  add_library(${name} OBJECT ${CMAKE_BINARY_DIR}/precompiled.cpp)
  target_link_libraries(${name} PRIVATE trunnion_options Eigen3::Eigen)
  target_precompile_headers(${name} PRIVATE ${ARGN})
endfunction()

# Sources of tests are not optimised in the preset release: they compile in little more than half the time, and what they test
# is a library that is.
set(test_compile_options $<$<CONFIG:RelWithDebInfo>:-O0>)

# What the presets sanitize and fuzz build: neither needs the executables, the benchmarks or the page.
add_custom_target(unit_tests)
# What `make run` builds: the programs that are installed (deploy/packages) and the page, no test and no benchmark.
add_custom_target(product)
add_custom_target(fuzzers)
# What the preset threads builds: the tests of all that has more than one thread.
add_custom_target(thread_tests)

# trunnion_headers(target PUBLIC|INTERFACE): the target and what links it may include the headers of this folder as
# "<folder>/file.hpp". Every library has an include root of its own in the build directory, with a link to its folder in it,
# so an include of a library that is not linked does not compile.
# No two libraries have one name, in whatever module of libs/ they are.
function(trunnion_headers target scope)
  get_filename_component(folder ${CMAKE_CURRENT_SOURCE_DIR} NAME)
  set(root ${CMAKE_BINARY_DIR}/include/${folder})
  file(MAKE_DIRECTORY ${root})
  file(CREATE_LINK ${CMAKE_CURRENT_SOURCE_DIR} ${root}/${folder} SYMBOLIC)
  target_include_directories(${target} ${scope} $<BUILD_INTERFACE:${root}> $<INSTALL_INTERFACE:include/trunnion>)
endfunction()

# trunnion_layer(target): refuses what a directory may not link. libs/ links libs/ only; a service, the gateway, the command
# line and the launcher link libs/ and what is in their own directory; nothing links what is defined after it, so there are
# no circles. Tests, tools and examples are free.
function(trunnion_layer target)
  file(RELATIVE_PATH directory ${CMAKE_SOURCE_DIR} ${CMAKE_CURRENT_SOURCE_DIR})
  set_target_properties(${target} PROPERTIES TRUNNION_DIRECTORY ${directory})
  foreach(used IN LISTS ARGN)
    if(NOT used MATCHES "^trunnion_" OR used STREQUAL trunnion_options)
      continue()
    endif()
    if(NOT TARGET ${used})
      message(FATAL_ERROR "${directory}: ${target} links ${used}, which is not defined before it in the top CMakeLists.txt")
    endif()
    get_target_property(home ${used} TRUNNION_DIRECTORY)
    if(directory MATCHES "^(libs|services|gateway|deploy)" AND NOT home MATCHES "^libs/" AND NOT home STREQUAL directory)
      message(FATAL_ERROR "${directory}: ${target} must not link ${used} of ${home}")
    endif()
  endforeach()
endfunction()

# trunnion_use_precompiled(target header-set): header-set is precompiled_product or precompiled_tests.
function(trunnion_use_precompiled target headers)
  target_link_libraries(${target} PRIVATE Eigen3::Eigen)
  target_precompile_headers(${target} REUSE_FROM ${headers})
endfunction()

# trunnion_test_source(target): how the sources of a test program are compiled.
function(trunnion_test_source target)
  trunnion_use_precompiled(${target} precompiled_tests)
  target_compile_options(${target} PRIVATE ${test_compile_options})
endfunction()

# trunnion_library(name SOURCES a.cpp ... [LINK libs...])
function(trunnion_library name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LINK" ${ARGN})
  add_library(${name} STATIC ${ARG_SOURCES})
  target_link_libraries(${name} PUBLIC trunnion_options ${ARG_LINK})
  trunnion_use_precompiled(${name} precompiled_product)
  trunnion_layer(${name} ${ARG_LINK})
  if(CMAKE_CURRENT_SOURCE_DIR MATCHES "^${CMAKE_SOURCE_DIR}/libs/")
    trunnion_headers(${name} PUBLIC)
  endif()
endfunction()

# trunnion_embed(sources namespace name file): makes the C++ source of the text constant <namespace>::<name> from a file of
# this folder and adds it to the list `sources`.
function(trunnion_embed sources namespace name file)
  set(out ${CMAKE_CURRENT_BINARY_DIR}/${name}.cpp)
  set(script ${CMAKE_SOURCE_DIR}/cmake/embed.cmake)
  add_custom_command(OUTPUT ${out}
    COMMAND ${CMAKE_COMMAND} -DINPUT=${CMAKE_CURRENT_SOURCE_DIR}/${file} -DOUTPUT=${out} -DNAMESPACE=${namespace} -DNAME=${name}
            -P ${script}
    DEPENDS ${file} ${script} VERBATIM)
  set(${sources} ${${sources}} ${out} PARENT_SCOPE)
endfunction()

# trunnion_test(name SOURCES a_test.cpp ... [LINK libs...] [LABELS unit]): one GoogleTest program, one CTest entry.
function(trunnion_test name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LINK;LABELS" ${ARGN})
  if(NOT ARG_LABELS)
    set(ARG_LABELS unit)
  endif()
  add_executable(${name} ${ARG_SOURCES})
  target_link_libraries(${name} PRIVATE trunnion_options trunnion_testing_support ${ARG_LINK} GTest::gmock GTest::gtest_main)
  trunnion_test_source(${name})
  add_test(NAME ${name} COMMAND ${name})
  set_tests_properties(${name} PROPERTIES LABELS "${ARG_LABELS}" TIMEOUT ${trunnion_test_timeout})
  if("unit" IN_LIST ARG_LABELS)
    add_dependencies(unit_tests ${name})
  endif()
endfunction()

# trunnion_benchmark(name SOURCES a_bench.cpp ... [LINK libs...]): a Google Benchmark program beside the code.
function(trunnion_benchmark name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LINK" ${ARGN})
  add_executable(${name} ${ARG_SOURCES})
  target_link_libraries(${name} PRIVATE trunnion_options ${ARG_LINK} benchmark::benchmark_main)
  trunnion_use_precompiled(${name} precompiled_product)
endfunction()

# trunnion_fuzzer(name SOURCES a_fuzz.cpp CORPUS dir [LINK libs...]): a libFuzzer target; only with TRUNNION_FUZZ. The
# test runs for TRUNNION_FUZZ_SECONDS; a longer search is the program's own: fuzz/bin/<name> corpus-directory.
function(trunnion_fuzzer name)
  cmake_parse_arguments(ARG "" "CORPUS" "SOURCES;LINK" ${ARGN})
  if(TRUNNION_FUZZ)
    set(found ${CMAKE_BINARY_DIR}/corpus-${name})
    file(MAKE_DIRECTORY ${found})
    add_executable(${name} ${ARG_SOURCES})
    target_link_options(${name} PRIVATE -fsanitize=fuzzer)
    target_link_libraries(${name} PRIVATE trunnion_options trunnion_testing_support ${ARG_LINK})
    add_dependencies(fuzzers ${name})
    add_test(NAME ${name} WORKING_DIRECTORY ${CMAKE_BINARY_DIR}
      COMMAND ${name} -max_total_time=${TRUNNION_FUZZ_SECONDS} -seed=1 -len_control=0 -timeout=10 -verbosity=0 ${found} ${ARG_CORPUS})
    set_tests_properties(${name} PROPERTIES LABELS fuzz TIMEOUT 600)
  endif()
endfunction()

# trunnion_service(name [LINK libs...]): the executable trunnion-<name> from main.cpp and service.cpp of this folder.
function(trunnion_service name)
  cmake_parse_arguments(ARG "" "" "LINK" ${ARGN})
  add_executable(trunnion-${name} main.cpp service.cpp)
  target_link_libraries(trunnion-${name} PRIVATE trunnion_options trunnion_service ${ARG_LINK})
  trunnion_use_precompiled(trunnion-${name} precompiled_product)
  trunnion_layer(trunnion-${name} trunnion_service ${ARG_LINK})
endfunction()
