// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/systems/plugin_slam.h"

#include <algorithm>
#include <cmath>

#include "harness/run/system_failure.h"
#include "harness/systems/failed_system.h"
#include "harness/systems/host/loaded_plugin.h"
#include "harness/systems/plugin_process.h"

namespace vinebench::harness {
namespace {

constexpr double kNormTolerance = 1e-3;  // of a quaternion

vinebench_pose to_plugin(const Pose& pose) {
  const Eigen::Vector3d& p = pose.translation;
  const Eigen::Quaterniond& q = pose.rotation;
  return {{p.x(), p.y(), p.z()}, {q.x(), q.y(), q.z(), q.w()}};
}

template <std::size_t N, class Values>
void copy_into(double (&target)[N], const Values& values) {
  std::copy_n(values.data(), N, target);
}

/// The setup of a plug-in, and the data that its pointers refer to.
class Setup {
 public:
  Setup(const PluginSlamConfig& config, const Rig& rig, const std::vector<RegisteredTag>& tags,
        const std::optional<slam::MecanumWheels>& wheels, int threads)
      : rig_(rig), tags_(tags), settings_(config.settings ? config.settings->string() : "") {
    for (const RigCamera& camera : rig_.cameras) {
      const PinholeCamera& lens = camera.model;
      vinebench_camera c{camera.name.c_str(),
                         lens.width,
                         lens.height,
                         lens.fx,
                         lens.fy,
                         lens.cx,
                         lens.cy,
                         {},
                         to_plugin(camera.T_body_cam)};
      if (lens.lens != LensModel::kRadialTangential || lens.distortion[4] != 0) {
        fail(
            "plug-in: camera '{}': its interface has radial-tangential lenses of k1, k2, p1, p2 "
            "alone",
            camera.name);
      }
      copy_into(c.distortion, lens.distortion);
      cameras_.push_back(c);
    }
    for (const StereoPair& pair : rig_.stereo_pairs) {
      pairs_.push_back({pair.name.c_str(), pair.left, pair.right});
    }
    for (const RegisteredTag& tag : tags_) {
      known_tags_.push_back({tag.family.c_str(), tag.id, tag.size, to_plugin(tag.T_world_tag)});
    }
    tag_cameras_.assign(rig_.tag_cameras.begin(), rig_.tag_cameras.end());
    const slam::MecanumWheels w = wheels.value_or(slam::MecanumWheels{0, 0, 0});
    setup_ = {rig_.name.c_str(),
              rig_.rate_hz,
              cameras_.data(),
              cameras_.size(),
              pairs_.data(),
              pairs_.size(),
              tag_cameras_.data(),
              tag_cameras_.size(),
              known_tags_.data(),
              known_tags_.size(),
              w.radius,
              w.half_track,
              w.half_wheelbase,
              settings_.c_str(),
              threads};
  }
  Setup(const Setup&) = delete;
  Setup& operator=(const Setup&) = delete;
  const vinebench_setup& get() const { return setup_; }

 private:
  Rig rig_;
  std::vector<RegisteredTag> tags_;
  std::string settings_;
  std::vector<vinebench_camera> cameras_;
  std::vector<vinebench_stereo_pair> pairs_;
  std::vector<vinebench_tag> known_tags_;
  std::vector<std::int32_t> tag_cameras_;
  vinebench_setup setup_{};
};

/// The images are not copied.
PluginFrame plugin_frame(const Frame& frame) {
  PluginFrame plugin{.index = frame.index, .stamp = frame.stamp};
  for (std::size_t i = 0; i < frame.images.size(); ++i) {
    const cv::Mat& image = frame.images[i];
    plugin.images.push_back(
        {image.data, image.cols, image.rows, image.channels(), image.empty() ? 0 : image.step[0]});
    plugin.image_stamps.push_back(frame.image_stamp(i));
  }
  for (const ImuSample& sample : frame.imu) {
    vinebench_imu_sample& s = plugin.imu.emplace_back();
    s.stamp = sample.stamp;
    copy_into(s.angular_velocity, sample.angular_velocity);
    copy_into(s.specific_force, sample.specific_force);
  }
  for (const WheelSample& sample : frame.wheels) {
    vinebench_wheel_sample& s = plugin.wheels.emplace_back();
    s.stamp = sample.stamp;
    copy_into(s.angle, sample.angle);
    copy_into(s.velocity, sample.velocity);
  }
  return plugin;
}

/// A plug-in that its own setup outlives.
struct StartedPlugin {
  std::unique_ptr<Setup> setup;
  std::unique_ptr<PluginLink> link;  // last member: it is destroyed first
};

class PluginSlam : public SlamSystem {
 public:
  PluginSlam(std::string file, StartedPlugin plugin)
      : file_(std::move(file)), plugin_(std::move(plugin)) {}

  Estimate process(const Frame& frame) override {
    const ScopedTimer timer(times_, plugin_.link->name());
    const PluginFrame plugin = plugin_frame(frame);
    return estimate_of(frame.stamp, plugin_.link->process(plugin.view()));
  }

  SlamSummary finish() override {
    const PluginSummary answer = plugin_.link->finish();
    SlamSummary summary;
    summary.trajectory = trajectory_of(answer.trajectory);
    summary.keyframes = trajectory_of(answer.keyframes);
    summary.landmarks = static_cast<std::size_t>(std::max<std::int64_t>(0, answer.landmarks));
    return summary;
  }

  const StageTimes& times() const override { return times_; }

 private:
  Pose pose_of(const vinebench_pose& pose) const {
    const double* q = pose.quaternion;
    const double* p = pose.position;
    const Pose result{Eigen::Quaterniond(q[3], q[0], q[1], q[2]), {p[0], p[1], p[2]}};
    if (!result.translation.allFinite() ||
        !(std::abs(result.rotation.norm() - 1) <= kNormTolerance)) {
      fail_system("{}: invalid pose: position {} {} {}, quaternion {} {} {} {}", file_, p[0], p[1],
                  p[2], q[0], q[1], q[2], q[3]);
    }
    return result;
  }

  void check_stamp(const char* function, Stamp stamp) const {
    if (is_in_range(stamp)) return;
    fail_system("{}: {}: expected a stamp within 146 years, found {}", file_, function, stamp);
  }

  Estimate estimate_of(Stamp stamp, const PluginEstimate& given) const {
    const vinebench_estimate& answer = given.estimate;
    if (answer.status < VINEBENCH_INITIALIZING || answer.status > VINEBENCH_LOST) {
      fail_system("{}: process: expected a status from 0 to 3, found {}", file_, answer.status);
    }
    Estimate estimate;
    estimate.stamp = stamp;
    estimate.status = static_cast<TrackingStatus>(answer.status);
    if (answer.has_pose != 0) estimate.T_map_body = pose_of(answer.T_map_body);
    estimate.covariance = Eigen::Map<const Matrix6d>(answer.covariance);
    if (!estimate.covariance.allFinite()) {
      fail_system("{}: process: expected a finite covariance", file_);
    }
    estimate.keyframe = answer.keyframe != 0;
    for (const vinebench_counts& c : given.counts) {
      estimate.cameras.push_back({c.features, c.stereo, c.matches, c.inliers});
    }
    if (answer.has_loop_closure != 0) {
      const vinebench_loop_closure& loop = answer.loop_closure;
      check_stamp("process", loop.earlier);
      check_stamp("process", loop.later);
      estimate.loop_closure = {loop.tag_id, loop.earlier, loop.later, pose_of(loop.T_earlier_later),
                               loop.correction};
    }
    return estimate;
  }

  Trajectory trajectory_of(const std::vector<vinebench_stamped_pose>& poses) const {
    Trajectory trajectory;
    for (std::size_t i = 0; i < poses.size(); ++i) {
      if (i > 0 && poses[i].stamp <= poses[i - 1].stamp) {
        fail_system("{}: finish: expected ascending stamps, found {} after {}", file_,
                    poses[i].stamp, poses[i - 1].stamp);
      }
      check_stamp("finish", poses[i].stamp);
      trajectory.push_back({poses[i].stamp, pose_of(poses[i].T_map_body)});
    }
    return trajectory;
  }

  std::string file_;
  StartedPlugin plugin_;
  StageTimes times_;
};

std::unique_ptr<PluginLink> start_plugin(const PluginSlamConfig& config, const Setup& setup,
                                         const std::string& file,
                                         const PluginSurroundings& around) {
  if (config.in_process) return std::make_unique<LoadedPlugin>(file, setup.get());
  if (around.host.empty()) {
    fail(
        "slam.plugin: vinebench_plugin_host is neither beside the program nor in "
        "../libexec/vinebench; with slam.plugin.in_process the plug-in runs without it");
  }
  return start_plugin_process(around.host, config, setup.get(), around.stopped);
}

}  // namespace

std::unique_ptr<SlamSystem> load_plugin_slam(const PluginSlamConfig& config, const Rig& rig,
                                             const std::vector<RegisteredTag>& tags,
                                             const std::optional<slam::MecanumWheels>& wheels,
                                             int threads, const PluginSurroundings& around) {
  const std::string file = std::filesystem::absolute(config.library).string();
  StartedPlugin plugin{std::make_unique<Setup>(config, rig, tags, wheels, threads), nullptr};
  try {
    plugin.link = start_plugin(config, *plugin.setup, file, around);
  } catch (const SystemFailure& failure) {
    return std::make_unique<FailedSystem>(failure);
  }
  return std::make_unique<PluginSlam>(file, std::move(plugin));
}

}  // namespace vinebench::harness
