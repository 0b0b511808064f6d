// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "scenarios/ros_format.h"

#include "slam/base/error.h"

#ifndef VINEBENCH_HAS_ROSBAG

namespace vinebench {

bool can_write_ros() {
  return false;
}

std::unique_ptr<DatasetFormat> make_ros_format(const std::filesystem::path&,
                                               const RecordingNotes&) {
  fail(
      "ros: this program was built without ROS's libraries; install librosbag-storage-dev, "
      "libsensor-msgs-dev, libnav-msgs-dev and libtf2-msgs-dev, and build it again");
}

}  // namespace vinebench

#else

#include <geometry_msgs/PoseStamped.h>
#include <nav_msgs/Odometry.h>
#include <rosbag/bag.h>
#include <rosgraph_msgs/Clock.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/Imu.h>
#include <tf2_msgs/TFMessage.h>

#include <algorithm>
#include <memory>
#include <system_error>
#include <utility>

#include "scenarios/tags_in_view.h"

namespace vinebench {
namespace {

namespace fs = std::filesystem;

/// What ROS's messages ask of an allocator, which C++20's has no more.
struct RosMemory {
  template <class T>
  struct rebind {
    using other = std::allocator<T>;
  };
};
using Header = std_msgs::Header_<RosMemory>;
using Point = geometry_msgs::Point_<RosMemory>;
using Vector3 = geometry_msgs::Vector3_<RosMemory>;
using Quaternion = geometry_msgs::Quaternion_<RosMemory>;
using PoseMessage = geometry_msgs::Pose_<RosMemory>;
using PoseStamped = geometry_msgs::PoseStamped_<RosMemory>;
using TransformStamped = geometry_msgs::TransformStamped_<RosMemory>;
using Transforms = tf2_msgs::TFMessage_<RosMemory>;
using Odometry = nav_msgs::Odometry_<RosMemory>;
using Image = sensor_msgs::Image_<RosMemory>;
using CameraInfo = sensor_msgs::CameraInfo_<RosMemory>;
using Imu = sensor_msgs::Imu_<RosMemory>;
using Clock = rosgraph_msgs::Clock_<RosMemory>;

constexpr const char* kWorld = "world";
constexpr const char* kBody = "base_link";

/// A bag has no time 0: what happens there is written a nanosecond later.
ros::Time time_of(Stamp stamp) {
  ros::Time time;
  return time.fromNSec(static_cast<std::uint64_t>(std::max<Stamp>(1, stamp)));
}

Quaternion message(const Eigen::Quaterniond& q) {
  Quaternion m;
  m.x = q.x();
  m.y = q.y();
  m.z = q.z();
  m.w = q.w();
  return m;
}

template <class Message>
Message message(const Eigen::Vector3d& v) {
  Message m;
  m.x = v.x();
  m.y = v.y();
  m.z = v.z();
  return m;
}

PoseMessage message(const Pose& T) {
  PoseMessage m;
  m.position = message<Point>(T.translation);
  m.orientation = message(T.rotation);
  return m;
}

TransformStamped transform(const std::string& parent, const std::string& child,
                           const Pose& T_parent_child, const ros::Time& time) {
  TransformStamped m;
  m.header.stamp = time;
  m.header.frame_id = parent;
  m.child_frame_id = child;
  m.transform.translation = message<Vector3>(T_parent_child.translation);
  m.transform.rotation = message(T_parent_child.rotation);
  return m;
}

std::string optical_frame(const RigCamera& camera) {
  return camera.name + "_optical_frame";
}

class RosFormat : public DatasetFormat {
 public:
  RosFormat(const fs::path& folder, const RecordingNotes& notes)
      : notes_(notes),
        rig_(notes.rig.make()),
        file_(make_folder(folder) / "run.bag"),
        active_(file_.string() + ".active") {
    guarded([&] { bag_.open(active_.string(), rosbag::bagmode::Write); });
  }

  std::vector<FileTask> files(const std::shared_ptr<const DatasetFrame>&) override { return {}; }

  void commit(const DatasetFrame& frame) override {
    guarded([&] {
      const ros::Time now = time_of(frame.frame.stamp);
      write_readings(frame.frame);
      Clock clock;
      clock.clock = now;
      bag_.write("/clock", now, clock);
      write_poses(frame.truth.T_world_body, now);
      write_tags(frame, now);
      for (std::size_t i = 0; i < rig_.cameras.size(); ++i) {
        if (!frame.frame.images[i].empty()) write_camera(i, frame.frame.images[i], now);
      }
    });
  }

  void finish() override {
    guarded([&] { bag_.close(); });
    std::error_code error;
    fs::rename(active_, file_, error);
    if (error) fail("{}: cannot be written: {}", file_.string(), error.message());
  }

 private:
  /// What the library throws is told as ours.
  template <class Work>
  void guarded(const Work& work) const {
    try {
      work();
    } catch (const rosbag::BagException& error) {
      fail("{}: cannot be written: {}", active_.string(), error.what());
    }
  }

  void write_readings(const Frame& frame) {
    for (const ImuSample& reading : frame.imu) {
      Imu m;
      m.header.stamp = time_of(reading.stamp);
      m.header.frame_id = kBody;
      m.angular_velocity = message<Vector3>(reading.angular_velocity);
      m.linear_acceleration = message<Vector3>(reading.specific_force);
      m.orientation_covariance[0] = -1;  // there is no orientation
      bag_.write("/imu", m.header.stamp, m);
    }
  }

  void write_poses(const Pose& T_world_body, const ros::Time& now) {
    Odometry odometry;
    odometry.header.stamp = now;
    odometry.header.frame_id = kWorld;
    odometry.child_frame_id = kBody;
    odometry.pose.pose = message(T_world_body);
    bag_.write("/odom", now, odometry);
    Transforms moving;
    moving.transforms.push_back(transform(kWorld, kBody, T_world_body, now));
    bag_.write("/tf", now, moving);
    if (std::exchange(told_mounts_, true)) return;
    Transforms fixed;
    for (const RigCamera& camera : rig_.cameras) {
      fixed.transforms.push_back(transform(kBody, optical_frame(camera), camera.T_body_cam, now));
    }
    bag_.write("/tf_static", now, fixed);
  }

  void write_tags(const DatasetFrame& frame, const ros::Time& now) {
    for (const TagInView& tag : tags_in_view(frame, notes_)) {
      PoseStamped m;
      m.header.stamp = now;
      m.header.frame_id = optical_frame(rig_.cameras[tag.camera]);
      m.pose = message(tag.T_cam_tag);
      bag_.write("/tag_" + std::to_string(tag.tag.id) + "/pose", now, m);
    }
  }

  void write_camera(std::size_t index, const cv::Mat& picture, const ros::Time& now) {
    const RigCamera& camera = rig_.cameras[index];
    Image image;
    image.header.stamp = now;
    image.header.frame_id = optical_frame(camera);
    image.width = static_cast<std::uint32_t>(picture.cols);
    image.height = static_cast<std::uint32_t>(picture.rows);
    image.encoding = picture.channels() == 3 ? "rgb8" : "mono8";
    image.step = static_cast<std::uint32_t>(picture.cols * picture.channels());
    image.data.assign(picture.datastart, picture.dataend);
    const bool raw = camera.model.has_distortion();
    bag_.write("/" + camera.name + (raw ? "/image_raw" : "/image_rect"), now, image);
    bag_.write("/" + camera.name + "/camera_info", now, info_of(index, image.header));
  }

  CameraInfo info_of(std::size_t index, const Header& header) const {
    const PinholeCamera& c = rig_.cameras[index].model;
    CameraInfo info;
    info.header = header;
    info.width = static_cast<std::uint32_t>(c.width);
    info.height = static_cast<std::uint32_t>(c.height);
    info.distortion_model = "plumb_bob";
    info.D = {c.distortion[0], c.distortion[1], c.distortion[2], c.distortion[3], 0};
    info.K = {c.fx, 0, c.cx, 0, c.fy, c.cy, 0, 0, 1};
    info.R = {1, 0, 0, 0, 1, 0, 0, 0, 1};
    info.P = {c.fx, 0, c.cx, shift_of(index), 0, c.fy, c.cy, 0, 0, 0, 1, 0};
    return info;
  }

  /// P[3]: of a right eye the baseline in pixels, to the left; else 0.
  double shift_of(std::size_t index) const {
    for (const StereoPair& pair : rig_.stereo_pairs) {
      if (pair.right == static_cast<int>(index)) {
        return -rig_.cameras[index].model.fx * rig_.baseline(pair);
      }
    }
    return 0;
  }

  RecordingNotes notes_;
  Rig rig_;
  fs::path file_;
  fs::path active_;
  rosbag::Bag bag_;
  bool told_mounts_ = false;
};

}  // namespace

bool can_write_ros() {
  return true;
}

std::unique_ptr<DatasetFormat> make_ros_format(const fs::path& folder,
                                               const RecordingNotes& notes) {
  return std::make_unique<RosFormat>(folder, notes);
}

}  // namespace vinebench

#endif
