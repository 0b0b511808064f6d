# SPDX-FileCopyrightText: Vinebench authors
# SPDX-License-Identifier: Apache-2.0

# `cmake --install`, in components:
#   slam     the SLAM core as a library, vinebench::slam; headers are included as <slam/slam.h>
#   harness  what runs, judges and reads recordings, vinebench::harness; <harness/harness.h>
#   program  vinebench with its scenarios, worlds and models, its manual page, completion for shells
#   python   the Python module (python/CMakeLists.txt)
# Packages of them: packages.cmake (Debian), pyproject.toml (a wheel).
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)
include(${CMAKE_CURRENT_LIST_DIR}/public_headers.cmake)

set(VINEBENCH_ZSH_FOLDER site-functions CACHE STRING "Folder of zsh's completion below share/zsh")
set(headers ${CMAKE_INSTALL_INCLUDEDIR}/vinebench)
set(package ${CMAKE_INSTALL_LIBDIR}/cmake/vinebench)

# vinebench_install_library(COMPONENT NAMES...): the libraries vinebench_NAME as vinebench::NAME.
function(vinebench_install_library component)
  foreach(name IN LISTS ARGN)
    set_target_properties(vinebench_${name} PROPERTIES EXPORT_NAME ${name})
    install(TARGETS vinebench_${name} EXPORT vinebench_${component}
            ARCHIVE COMPONENT ${component} INCLUDES DESTINATION ${headers})
  endforeach()
  install(EXPORT vinebench_${component} NAMESPACE vinebench:: DESTINATION ${package} COMPONENT ${component}
          FILE vinebench_${component}.cmake)
endfunction()

vinebench_install_library(slam core slam)
vinebench_public_headers(slam_headers slam/slam.h core/slam_plugin.h core/config/yaml.h)
vinebench_install_headers(slam ${slam_headers})
install(FILES ${CMAKE_BINARY_DIR}/generated/vinebench/version.h COMPONENT slam DESTINATION ${headers}/vinebench)

configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/vinebenchConfig.cmake.in
                              ${CMAKE_BINARY_DIR}/vinebenchConfig.cmake INSTALL_DESTINATION ${package})
write_basic_package_version_file(${CMAKE_BINARY_DIR}/vinebenchConfigVersion.cmake
                                 COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_BINARY_DIR}/vinebenchConfig.cmake ${CMAKE_BINARY_DIR}/vinebenchConfigVersion.cmake
        COMPONENT slam DESTINATION ${package})
if(VINEBENCH_SLAM_ONLY)
  return()
endif()

set(simulation "")
if(VINEBENCH_SIM)
  set(simulation sim)
  install(FILES ${CMAKE_CURRENT_LIST_DIR}/mujoco.cmake COMPONENT harness DESTINATION ${package})
endif()
vinebench_install_library(harness rosbag ${simulation} harness)
vinebench_public_headers(harness_headers harness/harness.h)
list(REMOVE_ITEM harness_headers ${slam_headers})
vinebench_install_headers(harness ${harness_headers})

install(TARGETS vinebench RUNTIME COMPONENT program)
install(TARGETS vinebench_plugin_host RUNTIME DESTINATION ${CMAKE_INSTALL_LIBEXECDIR}/vinebench
        COMPONENT program)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/scenarios ${PROJECT_SOURCE_DIR}/worlds ${PROJECT_SOURCE_DIR}/models
        ${PROJECT_SOURCE_DIR}/cultivars ${PROJECT_SOURCE_DIR}/collections COMPONENT program DESTINATION ${CMAKE_INSTALL_DATADIR}/vinebench)
install(FILES ${PROJECT_SOURCE_DIR}/tools/completion/vinebench.bash COMPONENT program RENAME vinebench
        DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions)
install(FILES ${PROJECT_SOURCE_DIR}/tools/completion/_vinebench COMPONENT program
        DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/${VINEBENCH_ZSH_FOLDER})
configure_file(${PROJECT_SOURCE_DIR}/packaging/vinebench.1.in ${CMAKE_BINARY_DIR}/vinebench.1 @ONLY)
if(SKBUILD)
  install(PROGRAMS ${PROJECT_SOURCE_DIR}/packaging/wheel/vinebench COMPONENT program DESTINATION ${SKBUILD_SCRIPTS_DIR})
endif()
if(VINEBENCH_DEB)
  include(${CMAKE_CURRENT_LIST_DIR}/packages.cmake)
else()
  install(FILES ${CMAKE_BINARY_DIR}/vinebench.1 COMPONENT program DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
endif()
