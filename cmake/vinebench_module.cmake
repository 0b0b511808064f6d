# SPDX-FileCopyrightText: Vinebench authors
# SPDX-License-Identifier: Apache-2.0

# Options of all our code. Results must not depend on the optimiser: no contraction of
# floating-point expressions, no fast-math. x86-64-v2 has popcnt and SSE4 and keeps the alignment of
# Eigen types in Debian's libraries.
function(vinebench_options target)
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wshadow -Wno-psabi)
  target_compile_options(${target} PRIVATE -ffp-contract=off)
  # Collecting garbage below 1 GB takes up to a tenth of the compiler's time, and saves little.
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    target_compile_options(${target} PRIVATE $<$<COMPILE_LANGUAGE:CXX>:--param=ggc-min-heapsize=1000000>)
  endif()
  if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
    target_compile_options(${target} PRIVATE -march=x86-64-v2)
  endif()
  if(VINEBENCH_WERROR)
    target_compile_options(${target} PRIVATE -Werror)
  endif()
  if(VINEBENCH_SANITIZE)
    target_compile_options(${target} PRIVATE -fsanitize=${VINEBENCH_SANITIZE} -fno-omit-frame-pointer)
    target_link_options(${target} PRIVATE -fsanitize=${VINEBENCH_SANITIZE})
    if(VINEBENCH_SANITIZE MATCHES address)
      # With this sanitizer Eigen allocates in a way of its own, and Debian's Ceres as without.
      target_compile_definitions(${target} PRIVATE EIGEN_MALLOC_ALREADY_ALIGNED=1)
    endif()
    if(VINEBENCH_SANITIZE_NOT)
      target_compile_options(${target} PRIVATE -fno-sanitize=${VINEBENCH_SANITIZE_NOT})
    endif()
  endif()
endfunction()

# Options of every target.
function(vinebench_flags target)
  target_include_directories(${target} PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>)
  target_compile_features(${target} PUBLIC cxx_std_20)
  vinebench_options(${target})
endfunction()

# Of targets in which no time is spent but in libraries, where they compute no picture and no
# estimate: less optimisation takes a third off the time to compile them.
function(vinebench_compile_quickly target)
  target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O1>)
endfunction()

# Libraries' headers that most files include.
set(VINEBENCH_COMMON_HEADERS <algorithm> <filesystem> <functional> <map> <memory> <optional> <string> <vector>
    <fmt/format.h> <Eigen/Core> <Eigen/Geometry> <opencv2/core.hpp>)

# vinebench_precompile(TARGET headers...): precompiles them for a target of many files; REUSE_FROM TARGET uses
# those of another one, which is compiled with the same options.
function(vinebench_precompile target)
  if(NOT VINEBENCH_PRECOMPILE)
    return()
  endif()
  if("${ARGV1}" STREQUAL REUSE_FROM)
    target_precompile_headers(${target} ${ARGN})
  else()
    target_precompile_headers(${target} PRIVATE ${ARGN})
  endif()
endfunction()

# How many folders deep vinebench_unity() tells folders apart, such as sim/render. Fourteen small folders of tests
# took half the time at once: headers, and what templates become, are common to them.
set(vinebench_unity_depth 2)
# Folders that are compiled together, in lists of names with spaces between.
set(vinebench_unity_together "")

# vinebench_unity(TARGET sources...): compiles each folder's sources at once, with those of folders deeper than
# ${vinebench_unity_depth}, and of folders named in the same entry of ${vinebench_unity_together}. Names that are
# local to a file are unique there therefore.
function(vinebench_unity target)
  if(NOT VINEBENCH_UNITY)
    return()
  endif()
  foreach(source IN LISTS ARGN)
    if(source MATCHES "\\.cpp$")
      get_filename_component(folder ${source} DIRECTORY)
      file(RELATIVE_PATH folder ${PROJECT_SOURCE_DIR} ${folder})
      string(REPLACE "/" ";" folder "${folder}")
      list(SUBLIST folder 0 ${vinebench_unity_depth} folder)
      list(POP_BACK folder name)
      foreach(together IN LISTS vinebench_unity_together)
        separate_arguments(together)
        if(name IN_LIST together)
          list(GET together 0 name)
        endif()
      endforeach()
      list(APPEND folder ${name})
      list(JOIN folder "_" folder)
      set_property(SOURCE ${source} PROPERTY UNITY_GROUP ${folder})
    endif()
  endforeach()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
endfunction()

# vinebench_module(NAME PUBLIC dependencies... PRIVATE dependencies...): one static library of every source in this folder and those
# below it, but for folders that are libraries of their own, for programs (*_main.cpp), and for files that match
# vinebench_without_NAME, a regular expression.
function(vinebench_module name)
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*.cpp ${CMAKE_CURRENT_SOURCE_DIR}/*.h)
  list(FILTER sources EXCLUDE REGEX "/rosbag/|_main\\.cpp$")
  if(vinebench_without_${name})
    list(FILTER sources EXCLUDE REGEX "${vinebench_without_${name}}")
  endif()
  add_library(vinebench_${name} STATIC ${sources})
  target_link_libraries(vinebench_${name} ${ARGN})
  vinebench_flags(vinebench_${name})
  vinebench_unity(vinebench_${name} ${sources})
  # Highway compiles a file that includes foreach_target.h again for each kind of vectors.
  foreach(source IN LISTS sources)
    file(STRINGS ${source} vectors REGEX "hwy/foreach_target.h")
    if(vectors)
      set_source_files_properties(${source} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON SKIP_PRECOMPILE_HEADERS ON)
    endif()
  endforeach()
endfunction()

# vinebench_shards(PROGRAM): its tests in several processes, because a process with sanitizers
# starts slowly, and too few would leave a core idle at the end. VINEBENCH_TEST_FILTER (as for
# --gtest_filter) selects tests.
function(vinebench_shards program)
  set(shards 8)
  foreach(shard RANGE 1 ${shards})
    math(EXPR index "${shard} - 1")
    add_test(NAME ${program}_${shard} COMMAND ${program} --gtest_brief=1
             --gtest_filter=${VINEBENCH_TEST_FILTER})
    set_tests_properties(${program}_${shard} PROPERTIES LABELS unit TIMEOUT 900
      ENVIRONMENT "GTEST_TOTAL_SHARDS=${shards};GTEST_SHARD_INDEX=${index}")
  endforeach()
endfunction()

# vinebench_suites(PROGRAM): each of its suites as a test, because a process for each single test takes longer to
# start than most of them to run.
function(vinebench_suites program)
  set(list ${CMAKE_CURRENT_BINARY_DIR}/${program}_suites.cmake)
  add_custom_command(TARGET ${program} POST_BUILD BYPRODUCTS ${list} VERBATIM
    COMMAND ${CMAKE_COMMAND} -D PROGRAM=$<TARGET_FILE:${program}> -D LIST=${list}
            -P ${PROJECT_SOURCE_DIR}/cmake/list_suites.cmake)
  file(WRITE ${CMAKE_CURRENT_BINARY_DIR}/${program}_tests.cmake
       "if(EXISTS ${list})\n  include(${list})\nelse()\n  add_test(${program}_not_built ${program})\nendif()\n")
  set_property(DIRECTORY APPEND PROPERTY TEST_INCLUDE_FILES ${CMAKE_CURRENT_BINARY_DIR}/${program}_tests.cmake)
endfunction()

# vinebench_library(NAME): a module that is linked into shared objects too.
function(vinebench_library name)
  set_target_properties(vinebench_${name} PROPERTIES POSITION_INDEPENDENT_CODE ON)
  # No interposition of our functions.
  target_compile_options(vinebench_${name} PRIVATE -fno-semantic-interposition)
endfunction()

# vinebench_tests(FOLDER dependencies...): one GoogleTest program of every *_test.cpp in and below tests/FOLDER
# but for those that match vinebench_without_FOLDER_test, a regular expression.
function(vinebench_tests folder)
  string(REPLACE "/" "_" name ${folder})
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/tests/${folder}/*_test.cpp)
  if(vinebench_without_${name}_test)
    list(FILTER sources EXCLUDE REGEX "${vinebench_without_${name}_test}")
  endif()
  if(VINEBENCH_TEST_FILES)
    list(FILTER sources INCLUDE REGEX "/(${VINEBENCH_TEST_FILES})_test\\.cpp$")
  endif()
  if(NOT sources)
    return()
  endif()
  add_executable(${name}_test ${sources})
  target_link_libraries(${name}_test PRIVATE ${ARGN} GTest::gmock GTest::gtest_main)
  target_compile_definitions(${name}_test PRIVATE VINEBENCH_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
  vinebench_flags(${name}_test)
  vinebench_compile_quickly(${name}_test)
  # GCC 12 warns of std::string's own functions, depending on the length of a path (GCC bug 105651).
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
    target_compile_options(${name}_test PRIVATE -Wno-restrict -Wno-array-bounds -Wno-stringop-overflow)
  endif()
  # All programs of tests are compiled alike: the first one's headers serve the others.
  get_property(precompiled GLOBAL PROPERTY VINEBENCH_PRECOMPILED_TESTS)
  if(precompiled)
    vinebench_precompile(${name}_test REUSE_FROM ${precompiled})
  else()
    vinebench_precompile(${name}_test ${VINEBENCH_COMMON_HEADERS} <gmock/gmock.h> <gtest/gtest.h>)
    set_property(GLOBAL PROPERTY VINEBENCH_PRECOMPILED_TESTS ${name}_test)
  endif()
  vinebench_unity(${name}_test ${sources})
  if(VINEBENCH_SANITIZE AND (VINEBENCH_SLAM_ONLY OR VINEBENCH_FUZZ))
    vinebench_shards(${name}_test)
  else()
    vinebench_suites(${name}_test)
  endif()
endfunction()
