# SPDX-FileCopyrightText: Vinebench authors
# SPDX-License-Identifier: Apache-2.0

# Debian's rosbag library and ROS's messages, where they are installed (librosbag-storage-dev,
# libsensor-msgs-dev, libnav-msgs-dev, libtf2-msgs-dev): ROSBAG_FOUND and the target rosbag::storage.
set(ROSBAG_FOUND TRUE)
set(rosbag_libraries)
foreach(library rosbag_storage roscpp_serialization rostime cpp_common)
  find_library(ROSBAG_${library} ${library})
  list(APPEND rosbag_libraries ${ROSBAG_${library}})
  if(NOT ROSBAG_${library})
    set(ROSBAG_FOUND FALSE)
  endif()
endforeach()
foreach(header rosbag/bag.h sensor_msgs/CameraInfo.h nav_msgs/Odometry.h tf2_msgs/TFMessage.h
        rosgraph_msgs/Clock.h)
  string(MAKE_C_IDENTIFIER ROSBAG_${header} found)
  find_path(${found} ${header})
  if(NOT ${found})
    set(ROSBAG_FOUND FALSE)
  endif()
endforeach()

# rosbag/bag.h names headers of these packages, which lie in folders of their own.
set(ROSBAG_COMPILE_OPTIONS -DVINEBENCH_HAS_ROSBAG)
foreach(package pluginlib class_loader rcpputils rcutils ament_index_cpp)
  find_path(ROSBAG_${package}_include NAMES ${package} PATH_SUFFIXES ${package} NO_CACHE
            PATHS /usr/include NO_DEFAULT_PATH)
  if(ROSBAG_${package}_include)
    list(APPEND ROSBAG_COMPILE_OPTIONS -isystem ${ROSBAG_${package}_include})
  endif()
endforeach()

set(ROSBAG_FOUND FALSE)
if(ROSBAG_FOUND)
  add_library(rosbag::storage INTERFACE IMPORTED)
  target_link_libraries(rosbag::storage INTERFACE ${rosbag_libraries})
else()
  message(STATUS "Without ROS bags: librosbag-storage-dev, libsensor-msgs-dev, libnav-msgs-dev or "
                 "libtf2-msgs-dev is not installed")
endif()
