# SPDX-FileCopyrightText: Vinebench authors
# SPDX-License-Identifier: Apache-2.0

# Debian packages, by `cmake --workflow --preset deb`: vinebench (the program), libvinebench-dev (both
# libraries) and python3-vinebench. packaging/debian/ has what they hold beside the components.
set(VINEBENCH_MAINTAINER "Vinebench authors <maintainers@vinebench.invalid>" CACHE STRING
    "Maintainer of the Debian packages: name and address")
find_program(GZIP_PROGRAM gzip REQUIRED)
set(debian ${PROJECT_SOURCE_DIR}/packaging/debian)
set(debian_generated ${CMAKE_BINARY_DIR}/debian)

# vinebench_git(RESULT arguments...): what git prints, empty outside of a repository.
function(vinebench_git result)
  execute_process(COMMAND git -C ${PROJECT_SOURCE_DIR} ${ARGN} OUTPUT_VARIABLE output ERROR_QUIET
                  OUTPUT_STRIP_TRAILING_WHITESPACE)
  set(${result} "${output}" PARENT_SCOPE)
endfunction()

# vinebench_gzip(INPUT OUTPUT): the same bytes for the same input.
function(vinebench_gzip input output)
  execute_process(COMMAND ${GZIP_PROGRAM} -9nc ${input} OUTPUT_FILE ${output} COMMAND_ERROR_IS_FATAL ANY)
endfunction()

# The project's version at its tag; between tags with the commit and its day.
set(VINEBENCH_DEB_VERSION ${PROJECT_VERSION})
vinebench_git(tags tag --points-at HEAD)
vinebench_git(commit log -1 --format=%cd.%h --date=format:%Y%m%d)
if(commit AND NOT "v${PROJECT_VERSION}" IN_LIST tags)
  string(APPEND VINEBENCH_DEB_VERSION "+git${commit}")
endif()
vinebench_git(VINEBENCH_DEB_DATE log -1 --format=%cD)
if(NOT VINEBENCH_DEB_DATE)
  string(TIMESTAMP VINEBENCH_DEB_DATE "%a, %d %b %Y %H:%M:%S +0000" UTC)
endif()

# vinebench_package(GROUP COMPONENT NAME): what every Debian package holds, installed with a component. The
# group is the component itself or, of several, their group.
function(vinebench_package group component package)
  set(folder ${debian_generated}/${package})
  configure_file(${debian}/changelog.in ${folder}/changelog @ONLY)
  vinebench_gzip(${folder}/changelog ${folder}/changelog.gz)
  install(FILES ${folder}/changelog.gz ${debian}/copyright COMPONENT ${component}
          DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${package})
  if(EXISTS ${debian}/${package}.lintian-overrides)
    install(FILES ${debian}/${package}.lintian-overrides COMPONENT ${component} RENAME ${package}
            DESTINATION ${CMAKE_INSTALL_DATADIR}/lintian/overrides)
  endif()
  string(TOUPPER ${group} upper)
  set(CPACK_DEBIAN_${upper}_PACKAGE_NAME ${package} PARENT_SCOPE)
  file(READ ${debian}/${package}.description description)
  set(CPACK_DEBIAN_${upper}_DESCRIPTION "${description}" PARENT_SCOPE)
endfunction()

set(components program slam)
vinebench_package(program program vinebench)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SHLIBDEPS ON)
vinebench_gzip(${PROJECT_SOURCE_DIR}/CHANGELOG.md ${debian_generated}/CHANGELOG.md.gz)
install(FILES ${debian_generated}/CHANGELOG.md.gz COMPONENT program
        DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/vinebench)
vinebench_gzip(${CMAKE_BINARY_DIR}/vinebench.1 ${debian_generated}/vinebench.1.gz)
install(FILES ${debian_generated}/vinebench.1.gz COMPONENT program DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
if(EGL_FOUND)  # the driver, which no library names
  set(strength RECOMMENDS)
  if(NOT OSMESA_FOUND)
    set(strength DEPENDS)
  endif()
  set(CPACK_DEBIAN_PROGRAM_PACKAGE_${strength} "libegl-mesa0, libgl1-mesa-dri")
endif()

list(APPEND components harness)
vinebench_package(dev slam libvinebench-dev)
set(CPACK_DEBIAN_DEV_PACKAGE_SECTION libdevel)
# As vinebenchConfig.cmake.in finds them.
set(CPACK_DEBIAN_DEV_PACKAGE_DEPENDS
    "libopencv-dev, libeigen3-dev, libceres-dev, libapriltag-dev, libhwy-dev, libyaml-cpp-dev, libfmt-dev, pkgconf, \
nlohmann-json3-dev, libxxhash-dev, libdeflate-dev, libzstd-dev, liblz4-dev, libbz2-dev, libsqlite3-dev, libcpp-httplib-dev, libssl-dev")
if(VINEBENCH_SIM)
  string(APPEND CPACK_DEBIAN_DEV_PACKAGE_DEPENDS ", libassimp-dev, libtinygltf-dev, libnlopt-dev, libmujoco-dev, libqhull-dev")
  if(OSMESA_FOUND)
    string(APPEND CPACK_DEBIAN_DEV_PACKAGE_DEPENDS ", libosmesa6-dev")
  endif()
  if(EGL_FOUND)
    string(APPEND CPACK_DEBIAN_DEV_PACKAGE_DEPENDS ", libegl-dev")
  endif()
endif()

if(TARGET vinebench_python)
  list(APPEND components python)
  vinebench_package(python python python3-vinebench)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SHLIBDEPS ON)
  math(EXPR next "${Python3_VERSION_MINOR} + 1")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "vinebench (= ${VINEBENCH_DEB_VERSION}), python3-numpy, \
python3 (>= 3.${Python3_VERSION_MINOR}~), python3 (<< 3.${next})")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA ${debian}/postinst ${debian}/prerm)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_STRICT_PERMISSION ON)
endif()

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "")  # each package has its own
set(CPACK_PACKAGE_VERSION ${VINEBENCH_DEB_VERSION})
set(CPACK_PACKAGE_CONTACT ${VINEBENCH_MAINTAINER})
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_COMPONENTS_ALL ${components})
set(CPACK_COMPONENT_SLAM_GROUP dev)
set(CPACK_COMPONENT_HARNESS_GROUP dev)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)
set(CPACK_STRIP_FILES ON)
set(CPACK_VERBATIM_VARIABLES ON)
include(CPack)
