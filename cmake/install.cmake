# SPDX-FileCopyrightText: Vinebench authors
# SPDX-License-Identifier: Apache-2.0

# `cmake --install`: the SLAM core as a library, which find_package(vinebench) finds as
# vinebench::slam. Its headers are included as <slam/slam.h>.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(headers ${CMAKE_INSTALL_INCLUDEDIR}/vinebench)
set(package ${CMAKE_INSTALL_LIBDIR}/cmake/vinebench)

set_target_properties(vinebench_core PROPERTIES EXPORT_NAME core)
set_target_properties(vinebench_slam PROPERTIES EXPORT_NAME slam)
install(TARGETS vinebench_core vinebench_slam EXPORT vinebench INCLUDES DESTINATION ${headers})
install(EXPORT vinebench NAMESPACE vinebench:: DESTINATION ${package} FILE vinebenchTargets.cmake)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/core ${PROJECT_SOURCE_DIR}/slam DESTINATION ${headers}
        FILES_MATCHING PATTERN "*.h" PATTERN "truth" EXCLUDE)
install(FILES ${CMAKE_BINARY_DIR}/generated/vinebench/version.h DESTINATION ${headers}/vinebench)

configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/vinebenchConfig.cmake.in
                              ${CMAKE_BINARY_DIR}/vinebenchConfig.cmake INSTALL_DESTINATION ${package})
write_basic_package_version_file(${CMAKE_BINARY_DIR}/vinebenchConfigVersion.cmake
                                 COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_BINARY_DIR}/vinebenchConfig.cmake
              ${CMAKE_BINARY_DIR}/vinebenchConfigVersion.cmake DESTINATION ${package})
