// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/datasets/ros2/cdr/ros2_schemas.h"

#include <gmock/gmock.h>

#include "harness/datasets/ros2/cdr/ros2_messages.h"
#include "tests/support/test_folder.h"

namespace vinebench::harness {
namespace {

using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

TEST(Ros2SchemasTest, ATypeWithoutPartsIsItsFields) {
  EXPECT_EQ(ros2_schema(ros2::kClock),
            "builtin_interfaces/Time clock\n" + std::string(80, '=') +
                "\nMSG: builtin_interfaces/Time\nint32 sec\nuint32 nanosec\n");
}

TEST(Ros2SchemasTest, PartsOfPartsFollowOnce) {
  const std::string schema = ros2_schema(ros2::kOdometry);
  EXPECT_THAT(schema, StartsWith("std_msgs/Header header\nstring child_frame_id\n"));
  for (const char* type :
       {"std_msgs/Header", "builtin_interfaces/Time", "geometry_msgs/PoseWithCovariance",
        "geometry_msgs/Pose", "geometry_msgs/Point", "geometry_msgs/Quaternion",
        "geometry_msgs/TwistWithCovariance", "geometry_msgs/Twist", "geometry_msgs/Vector3"}) {
    const std::string head = std::string("\nMSG: ") + type + "\n";
    const std::size_t at = schema.find(head);
    EXPECT_NE(at, std::string::npos) << type;
    EXPECT_EQ(schema.find(head, at + 1), std::string::npos) << type;
  }
  EXPECT_THAT(schema, Not(HasSubstr("sensor_msgs")));
}

TEST(Ros2SchemasTest, AnUnknownTypeIsAnError) {
  EXPECT_EQ(test::error_of([] { ros2_schema("std_msgs/msg/String"); }),
            "no definition of the ROS 2 type 'std_msgs/msg/String'");
}

}  // namespace
}  // namespace vinebench::harness
