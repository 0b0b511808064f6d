# SPDX-FileCopyrightText: Vinebench authors
# SPDX-License-Identifier: Apache-2.0

# Every library the project uses, each from a Debian package that tools/setup.sh installs.
find_package(Threads REQUIRED)
find_package(Eigen3 3.4 REQUIRED NO_MODULE)
find_package(OpenCV 4 REQUIRED COMPONENTS core imgproc imgcodecs features2d calib3d)
find_package(yaml-cpp REQUIRED)
find_package(fmt REQUIRED)
find_package(Ceres 2 REQUIRED)
find_package(apriltag REQUIRED)
find_package(hwy REQUIRED)
if(VINEBENCH_SLAM_ONLY)
  return()
endif()

find_package(PkgConfig REQUIRED)
find_package(nlohmann_json 3 REQUIRED)
find_package(CLI11 REQUIRED)
find_package(Boost 1.74 REQUIRED)  # Boost.Math, headers alone
pkg_check_modules(XXHASH REQUIRED IMPORTED_TARGET libxxhash)
pkg_check_modules(LIBDEFLATE REQUIRED IMPORTED_TARGET libdeflate)
pkg_check_modules(ZSTD REQUIRED IMPORTED_TARGET libzstd)
pkg_check_modules(LZ4 REQUIRED IMPORTED_TARGET liblz4)
find_package(BZip2 REQUIRED)
pkg_check_modules(SQLITE REQUIRED IMPORTED_TARGET sqlite3)
pkg_check_modules(HTTPLIB REQUIRED IMPORTED_TARGET cpp-httplib libcrypto)  # the header of newer ones calls libcrypto
if(NOT VINEBENCH_SIM)
  return()
endif()

find_package(assimp 5 REQUIRED)
find_package(TinyGLTF REQUIRED)
pkg_check_modules(NLOPT REQUIRED IMPORTED_TARGET nlopt)
include(${CMAKE_CURRENT_LIST_DIR}/mujoco.cmake)
# At least one of the two platforms for OpenGL without a display is required.
foreach(platform OSMESA EGL)
  string(TOLOWER ${platform} name)
  if(VINEBENCH_${platform})
    pkg_check_modules(${platform} IMPORTED_TARGET ${name})
  else()
    set(${platform}_FOUND FALSE)
  endif()
endforeach()
if(NOT OSMESA_FOUND AND NOT EGL_FOUND)
  message(FATAL_ERROR "Neither OSMesa nor EGL: install libosmesa6-dev or libegl-dev")
endif()
