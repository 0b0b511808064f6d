# SPDX-FileCopyrightText: Vinebench authors
# SPDX-License-Identifier: Apache-2.0

# The front end of reports: TypeScript from harness/page/web and three.js become one script
# (esbuild), which is compiled into the program, so that its users need neither.
find_program(ESBUILD_PROGRAM esbuild)
find_path(THREE_JS_DIR three.module.js PATHS /usr/share/javascript/three PATH_SUFFIXES build)
if(NOT ESBUILD_PROGRAM OR NOT THREE_JS_DIR)
  message(FATAL_ERROR "esbuild or three.js (three.module.js) not found: install esbuild and libjs-three, "
                      "or set ESBUILD_PROGRAM and THREE_JS_DIR")
endif()
file(REAL_PATH ${THREE_JS_DIR}/three.module.js three_module)
get_filename_component(three_folder ${three_module} DIRECTORY)
find_file(THREE_ORBIT_CONTROLS examples/jsm/controls/OrbitControls.js
          PATHS ${three_folder} ${three_folder}/.. NO_DEFAULT_PATH)
if(NOT THREE_ORBIT_CONTROLS)
  message(FATAL_ERROR "${three_folder}: expected three.js with examples/jsm/controls/OrbitControls.js")
endif()

set(page_web ${PROJECT_SOURCE_DIR}/harness/page/web)
set(page_generated ${CMAKE_BINARY_DIR}/generated/vinebench)
file(GLOB page_sources CONFIGURE_DEPENDS ${page_web}/*.ts)
add_custom_command(
  OUTPUT ${page_generated}/page_script.inc ${page_generated}/page_style.inc
  COMMAND ${ESBUILD_PROGRAM} ${page_web}/main.ts --bundle --minify --target=es2020 --format=iife --charset=utf8
          --log-level=warning --alias:three=${three_module} --alias:three-orbit-controls=${THREE_ORBIT_CONTROLS}
          --outfile=${page_generated}/page.js
  COMMAND ${CMAKE_COMMAND} -DINPUT=${page_generated}/page.js -DOUTPUT=${page_generated}/page_script.inc
          -P ${CMAKE_CURRENT_LIST_DIR}/text_literal.cmake
  COMMAND ${CMAKE_COMMAND} -DINPUT=${page_web}/style.css -DOUTPUT=${page_generated}/page_style.inc
          -P ${CMAKE_CURRENT_LIST_DIR}/text_literal.cmake
  DEPENDS ${page_sources} ${page_web}/style.css ${CMAKE_CURRENT_LIST_DIR}/text_literal.cmake
  VERBATIM)
