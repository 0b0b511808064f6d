# SPDX-FileCopyrightText: Vinebench authors
# SPDX-License-Identifier: Apache-2.0

# Defines mujoco::mujoco, by default from the package that find_package finds (2.2.2 or newer).
# VINEBENCH_MUJOCO_ROOT selects another one: a folder with include/mujoco/mujoco.h and, in itself or
# in lib/, libmujoco.so*. That is a release archive, or the folder `mujoco` of an unpacked Python
# wheel.
set(VINEBENCH_MUJOCO_ROOT "" CACHE PATH "Folder of a MuJoCo to use in place of the installed one")

if(NOT VINEBENCH_MUJOCO_ROOT)
  find_package(mujoco REQUIRED)
  # Debian's names a folder that its header does not include from; without it, what does not use MuJoCo is compiled
  # by the same command with and without the simulation.
  get_target_property(mujoco_folders mujoco::mujoco INTERFACE_INCLUDE_DIRECTORIES)
  list(FILTER mujoco_folders EXCLUDE REGEX qhull)
  set_property(TARGET mujoco::mujoco PROPERTY INTERFACE_INCLUDE_DIRECTORIES ${mujoco_folders})
  return()
endif()

set(mujoco_header ${VINEBENCH_MUJOCO_ROOT}/include/mujoco/mujoco.h)
file(GLOB mujoco_libraries ${VINEBENCH_MUJOCO_ROOT}/libmujoco.so* ${VINEBENCH_MUJOCO_ROOT}/lib/libmujoco.so*)
if(NOT EXISTS ${mujoco_header} OR NOT mujoco_libraries)
  message(FATAL_ERROR "VINEBENCH_MUJOCO_ROOT=${VINEBENCH_MUJOCO_ROOT}: expected "
                      "include/mujoco/mujoco.h and libmujoco.so* (here or in lib/)")
endif()
list(GET mujoco_libraries 0 mujoco_library)
add_library(mujoco::mujoco SHARED IMPORTED GLOBAL)
set_target_properties(mujoco::mujoco PROPERTIES
  IMPORTED_LOCATION ${mujoco_library}
  INTERFACE_INCLUDE_DIRECTORIES ${VINEBENCH_MUJOCO_ROOT}/include)
message(STATUS "MuJoCo: ${mujoco_library}")
