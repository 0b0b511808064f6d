// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/datasets/ros2/cdr/ros2_schemas.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <string_view>
#include <vector>

#include "core/util/error.h"
#include "harness/datasets/ros2/cdr/ros2_messages.h"

namespace vinebench::harness {
namespace {

/// Fields of the types, by names without "msg/", as ROS 2 has them since its first release.
const std::map<std::string_view, std::string_view>& definitions() {
  static const std::map<std::string_view, std::string_view> all{
      {"builtin_interfaces/Time", "int32 sec\nuint32 nanosec\n"},
      {"std_msgs/Header", "builtin_interfaces/Time stamp\nstring frame_id\n"},
      {"geometry_msgs/Vector3", "float64 x\nfloat64 y\nfloat64 z\n"},
      {"geometry_msgs/Point", "float64 x\nfloat64 y\nfloat64 z\n"},
      {"geometry_msgs/Quaternion", "float64 x 0\nfloat64 y 0\nfloat64 z 0\nfloat64 w 1\n"},
      {"geometry_msgs/Pose", "Point position\nQuaternion orientation\n"},
      {"geometry_msgs/PoseWithCovariance", "Pose pose\nfloat64[36] covariance\n"},
      {"geometry_msgs/Twist", "Vector3 linear\nVector3 angular\n"},
      {"geometry_msgs/TwistWithCovariance", "Twist twist\nfloat64[36] covariance\n"},
      {"geometry_msgs/Transform", "Vector3 translation\nQuaternion rotation\n"},
      {"geometry_msgs/TransformStamped",
       "std_msgs/Header header\nstring child_frame_id\nTransform transform\n"},
      {"sensor_msgs/RegionOfInterest",
       "uint32 x_offset\nuint32 y_offset\nuint32 height\nuint32 width\nbool do_rectify\n"},
      {"sensor_msgs/Image",
       "std_msgs/Header header\nuint32 height\nuint32 width\nstring encoding\nuint8 is_bigendian\n"
       "uint32 step\nuint8[] data\n"},
      {"sensor_msgs/CompressedImage", "std_msgs/Header header\nstring format\nuint8[] data\n"},
      {"sensor_msgs/CameraInfo",
       "std_msgs/Header header\nuint32 height\nuint32 width\nstring distortion_model\n"
       "float64[] d\nfloat64[9] k\nfloat64[9] r\nfloat64[12] p\nuint32 binning_x\n"
       "uint32 binning_y\nRegionOfInterest roi\n"},
      {"sensor_msgs/Imu",
       "std_msgs/Header header\ngeometry_msgs/Quaternion orientation\n"
       "float64[9] orientation_covariance\ngeometry_msgs/Vector3 angular_velocity\n"
       "float64[9] angular_velocity_covariance\ngeometry_msgs/Vector3 linear_acceleration\n"
       "float64[9] linear_acceleration_covariance\n"},
      {"sensor_msgs/JointState",
       "std_msgs/Header header\nstring[] name\nfloat64[] position\nfloat64[] velocity\n"
       "float64[] effort\n"},
      {"nav_msgs/Odometry",
       "std_msgs/Header header\nstring child_frame_id\ngeometry_msgs/PoseWithCovariance pose\n"
       "geometry_msgs/TwistWithCovariance twist\n"},
      {"tf2_msgs/TFMessage", "geometry_msgs/TransformStamped[] transforms\n"},
      {"rosgraph_msgs/Clock", "builtin_interfaces/Time clock\n"}};
  return all;
}

/// "sensor_msgs/Image" of "sensor_msgs/msg/Image".
std::string short_name(const std::string& type) {
  const std::size_t middle = type.find("/msg/");
  return middle == std::string::npos ? type : type.substr(0, middle) + type.substr(middle + 4);
}

/// Types of a definition's fields that have definitions of their own, in order.
std::vector<std::string> parts_of(const std::string& name, std::string_view definition) {
  std::vector<std::string> parts;
  for (std::size_t at = 0; at < definition.size(); at = definition.find('\n', at) + 1) {
    const std::string field(definition.substr(at, definition.find_first_of(" [", at) - at));
    const std::string here = name.substr(0, name.find('/') + 1) + field;
    if (definitions().contains(field)) parts.push_back(field);
    if (definitions().contains(here)) parts.push_back(here);
  }
  return parts;
}

}  // namespace

std::string ros2_schema(const std::string& type) {
  std::vector<std::string> types{short_name(type)};
  if (!definitions().contains(types[0])) fail("no definition of the ROS 2 type '{}'", type);
  std::string schema;
  for (std::size_t i = 0; i < types.size(); ++i) {
    const std::string name = types[i];
    const std::string_view definition = definitions().at(name);
    if (i > 0) schema += fmt::format("{:=<80}\nMSG: {}\n", "", name);
    schema += definition;
    for (const std::string& part : parts_of(name, definition)) {
      if (std::ranges::find(types, part) == types.end()) types.push_back(part);
    }
  }
  return schema;
}

}  // namespace vinebench::harness
