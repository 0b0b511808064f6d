// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/datasets/ros2/bag/bag_reader.h"

#include <algorithm>
#include <system_error>

#include "core/files/input_file.h"
#include "core/util/error.h"
#include "harness/datasets/euroc/our_files.h"
#include "harness/datasets/reading/kalibr_chain.h"
#include "harness/datasets/reading/reading_order.h"
#include "harness/datasets/ros2/bag/bag_image_store.h"
#include "harness/datasets/ros2/bag/bag_metadata.h"
#include "harness/datasets/ros2/bag/bag_rig.h"

namespace vinebench::harness {
namespace {

namespace fs = std::filesystem;

constexpr double kRateOfOneFrame = 20;  // Hz, of a bag of one frame

/// Our own topic if it is there, otherwise the first.
const std::pair<const std::string, BagInertial>* inertial_topic(const BagContents& contents) {
  const auto ours = contents.inertial.find("/imu");
  if (ours != contents.inertial.end()) return &*ours;
  return contents.inertial.empty() ? nullptr : &*contents.inertial.begin();
}

/// `body_is_unit`: where the transforms do not place the unit, its axes are the body's.
void set_readings(BagContents& contents, const BagRig& place, bool body_is_unit,
                  Recording& recording) {
  if (const auto* topic = inertial_topic(contents)) {
    auto T_body_imu = place.body_from(topic->second.frame);
    if (!T_body_imu && body_is_unit) T_body_imu = Pose{};
    if (T_body_imu) {
      recording.imu = topic->second.readings;
      for (ImuSample& reading : recording.imu) {
        if (T_body_imu->rotation.w() == 1) break;
        reading.angular_velocity = T_body_imu->rotation * reading.angular_velocity;
        reading.specific_force = T_body_imu->rotation * reading.specific_force;
      }
      put_in_order(recording.imu, topic->first, recording);
    } else {
      recording.frames.front().events.push_back(
          {"sensor_unplaced", topic->first,
           fmt::format("frame '{}' is not in /tf_static: left out", topic->second.frame)});
    }
  }
  recording.wheels = std::move(contents.wheels);
  put_in_order(recording.wheels, "/joint_states", recording);
}

void set_truth(const BagContents& contents, const BagRig& place, Recording& recording) {
  for (const RosTransform& pose : contents.truth) {
    Pose T_world_body = pose_of(pose.pose);
    const auto T_body_child = place.body_from(pose.child);
    if (!pose.child.empty() && T_body_child) T_world_body = T_world_body * T_body_child->inverse();
    recording.truth.push_back({pose.header.time, T_world_body});
  }
  put_in_order(recording.truth, "/ground_truth", recording);
}

/// Frames are at our list's stamps, else at those of the first camera.
void set_frames(const BagContents& contents, const std::vector<BagCamera>& cameras,
                const fs::path& frame_list, Recording& recording) {
  const auto store = std::make_shared<BagImageStore>(contents);
  std::vector<ImageList> lists;
  for (std::size_t i = 0; i < recording.rig.cameras.size(); ++i) {
    lists.push_back(store->add(contents, cameras[i]));
    lists.back().camera = recording.rig.cameras[i].name;
  }
  std::vector<Stamp> instants = instants_of(lists.front());
  if (!frame_list.empty() && is_present(frame_list)) instants = read_frame_list(frame_list);
  recording.frames = associate_images(lists, instants);
  recording.store = store;
  if (recording.frames.empty()) {
    fail("{}: expected images on {}, found none", contents.names.front().string(),
         cameras.front().topic);
  }
  if (recording.rig.rate_hz <= 0) {
    const Stamp period = median_period(instants);
    recording.rig.rate_hz = period > 0 ? 1 / to_seconds(period) : kRateOfOneFrame;
  }
}

}  // namespace

Recording read_bag(const fs::path& bag, const RecordingOptions& options) {
  std::error_code ignored;
  const bool folder = fs::is_directory(bag, ignored);
  BagContents contents = scan_bag(folder ? bag_files(bag) : std::vector<fs::path>{bag});
  // Beside a lone file there may be anyone's files.
  const fs::path place = folder ? bag : bag.parent_path();
  const bool has_ours = folder || contents.ours;
  BagCameras chosen = choose_bag_cameras(contents, options.topics);
  Recording recording;
  recording.format =
      contents.files.front()->coding() == MessageCoding::kRos1 ? "ROS 1 bag" : "ROS 2 bag";
  fs::path rig = options.rig;
  if (rig.empty() && has_ours && is_present(place / "rig.yaml")) rig = place / "rig.yaml";
  BagRig mounted;
  if (rig.empty()) {
    mounted = read_bag_rig(contents, chosen);
    mounted.rig.rate_hz = 0;  // set by the frames
  } else {
    set_rig(rig, chosen.cameras.size(), recording);
    order_by_rig(recording.rig, chosen.cameras);
    mounted = place_frames(contents, chosen);
    mounted.rig = recording.rig;
    mounted.T_body_reference = mounted.rig.cameras.front().T_body_cam;
  }
  recording.rig = mounted.rig;
  recording.T_body_left = recording.rig.cameras.front().T_body_cam;
  set_frames(contents, chosen.cameras, has_ours ? place / kFrameList : fs::path(), recording);
  const bool kalibrated = !rig.empty() && is_kalibr_chain(rig);
  set_readings(contents, mounted, kalibrated, recording);
  if (options.groundtruth.empty()) set_truth(contents, mounted, recording);
  if (has_ours) read_tags_and_settings(place, recording);
  if (!contents.cut_off.empty()) {
    recording.frames.back().events.push_back({"bag_cut_off", bag.string(), contents.cut_off});
  }
  return recording;
}

}  // namespace vinebench::harness
