// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
//
// Vinebench's own SLAM core as a plug-in, an example for other systems.
#include <core/slam_plugin.h>
#include <slam/slam.h>

#include <algorithm>
#include <cstdio>

#include "core/config/yaml.h"

namespace {

using namespace vinebench;

Pose to_pose(const vinebench_pose& pose) {
  const double* q = pose.quaternion;
  return {Eigen::Quaterniond(q[3], q[0], q[1], q[2]), Eigen::Vector3d(pose.position)};
}

vinebench_pose from_pose(const Pose& pose) {
  const Eigen::Vector3d& p = pose.translation;
  const Eigen::Quaterniond& q = pose.rotation;
  return {{p.x(), p.y(), p.z()}, {q.x(), q.y(), q.z(), q.w()}};
}

Rig rig_of(const vinebench_setup& setup) {
  Rig rig;
  rig.name = setup.rig;
  rig.rate_hz = setup.rate_hz;
  for (std::size_t i = 0; i < setup.camera_count; ++i) {
    const vinebench_camera& c = setup.cameras[i];
    PinholeCamera lens{c.width, c.height, c.fx, c.fy, c.cx, c.cy, {}};
    std::copy_n(c.distortion, 4, lens.distortion.begin());
    rig.cameras.push_back({c.name, lens, to_pose(c.T_body_cam)});
  }
  for (std::size_t i = 0; i < setup.stereo_pair_count; ++i) {
    const vinebench_stereo_pair& pair = setup.stereo_pairs[i];
    rig.stereo_pairs.push_back({pair.name, pair.left, pair.right});
  }
  rig.tag_cameras.assign(setup.tag_cameras, setup.tag_cameras + setup.tag_camera_count);
  return rig;
}

std::vector<RegisteredTag> tags_of(const vinebench_setup& setup) {
  std::vector<RegisteredTag> tags;
  for (std::size_t i = 0; i < setup.tag_count; ++i) {
    const vinebench_tag& tag = setup.tags[i];
    tags.push_back({tag.family, tag.id, tag.size, to_pose(tag.T_world_tag)});
  }
  return tags;
}

/// The settings' file has the keys of a scenario's `slam`.
slam::SlamConfig config_of(const vinebench_setup& setup) {
  slam::SlamConfig config;
  if (*setup.settings != '\0') config = YamlDocument::load(setup.settings).read<slam::SlamConfig>();
  if (!config.dead_reckoning.wheels && setup.wheel_radius > 0) {
    config.dead_reckoning.wheels = {setup.wheel_radius, setup.half_track, setup.half_wheelbase};
  }
  return config;
}

/// The images are not copied.
Frame frame_of(const vinebench_frame& given, std::size_t cameras) {
  Frame frame;
  frame.index = given.index;
  frame.stamp = given.stamp;
  for (std::size_t i = 0; i < cameras; ++i) {
    const vinebench_image& view = given.images[i];
    cv::Mat& image = frame.images.emplace_back();
    if (view.data == nullptr) continue;
    image = cv::Mat(view.height, view.width, CV_8UC(view.channels),
                    const_cast<std::uint8_t*>(view.data), view.stride);
  }
  frame.image_stamps.assign(given.image_stamps, given.image_stamps + cameras);
  for (std::size_t i = 0; i < given.imu_count; ++i) {
    const vinebench_imu_sample& s = given.imu[i];
    frame.imu.push_back(
        {s.stamp, Eigen::Vector3d(s.angular_velocity), Eigen::Vector3d(s.specific_force)});
  }
  for (std::size_t i = 0; i < given.wheel_count; ++i) {
    const vinebench_wheel_sample& s = given.wheels[i];
    WheelSample& sample = frame.wheels.emplace_back();
    sample.stamp = s.stamp;
    std::copy_n(s.angle, 4, sample.angle.begin());
    std::copy_n(s.velocity, 4, sample.velocity.begin());
  }
  return frame;
}

void tell(const Estimate& estimate, vinebench_estimate& answer) {
  answer.status = static_cast<std::int32_t>(estimate.status);
  answer.has_pose = estimate.T_map_body.has_value();
  if (estimate.T_map_body) answer.T_map_body = from_pose(*estimate.T_map_body);
  Eigen::Map<Matrix6d>(answer.covariance) = estimate.covariance;
  answer.keyframe = estimate.keyframe;
  for (std::size_t i = 0; i < estimate.cameras.size(); ++i) {
    const CameraCounts& c = estimate.cameras[i];
    answer.counts[i] = {c.features, c.stereo, c.matches, c.inliers};
  }
  if (!estimate.loop_closure) return;
  const LoopClosure& loop = *estimate.loop_closure;
  answer.has_loop_closure = 1;
  answer.loop_closure = {loop.tag_id, loop.earlier, loop.later, from_pose(loop.T_earlier_later),
                         loop.correction};
}

/// The object behind the bench's void pointer.
struct System {
  explicit System(const vinebench_setup& setup)
      : threads(setup.threads),
        cameras(setup.camera_count),
        slam(slam::make_slam(config_of(setup), rig_of(setup), tags_of(setup), threads)) {}

  static std::vector<vinebench_stamped_pose> poses_of(const Trajectory& trajectory) {
    std::vector<vinebench_stamped_pose> poses;
    for (const auto& [stamp, pose] : trajectory) poses.push_back({stamp, from_pose(pose)});
    return poses;
  }

  WorkerPool threads;
  std::size_t cameras;
  std::unique_ptr<slam::MappingSystem> slam;
  std::vector<vinebench_stamped_pose> trajectory;
  std::vector<vinebench_stamped_pose> keyframes;
};

/// No exception may cross the C interface.
template <class Work>
int guarded(vinebench_message message, const Work& work) {
  try {
    work();
    return 0;
  } catch (const std::exception& error) {
    std::snprintf(message.text, message.size, "%s", error.what());
    return 1;
  }
}

void* create(const vinebench_setup* setup, vinebench_message message) {
  System* system = nullptr;
  guarded(message, [&] { system = new System(*setup); });
  return system;
}

int process(void* place, const vinebench_frame* frame, vinebench_estimate* answer,
            vinebench_message message) {
  System& system = *static_cast<System*>(place);
  return guarded(message,
                 [&] { tell(system.slam->process(frame_of(*frame, system.cameras)), *answer); });
}

int finish(void* place, vinebench_summary* answer, vinebench_message message) {
  System& system = *static_cast<System*>(place);
  return guarded(message, [&] {
    const SlamSummary summary = system.slam->finish();
    system.trajectory = System::poses_of(summary.trajectory);
    system.keyframes = System::poses_of(summary.keyframes);
    *answer = {system.trajectory.data(), system.trajectory.size(), system.keyframes.data(),
               system.keyframes.size(), static_cast<std::int64_t>(summary.landmarks)};
  });
}

void destroy(void* place) {
  delete static_cast<System*>(place);
}

}  // namespace

extern "C" __attribute__((visibility("default"))) const vinebench_slam_functions* vinebench_slam() {
  static const vinebench_slam_functions functions{
      VINEBENCH_SLAM_PLUGIN_VERSION, "vinebench", create, process, finish, destroy};
  return &functions;
}
