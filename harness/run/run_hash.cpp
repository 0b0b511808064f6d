// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/run/run_hash.h"

#include <fmt/format.h>
#include <xxhash.h>

#include <type_traits>

namespace vinebench::harness {

struct RunHash::State {
  State() : xxh(XXH3_createState()) { XXH3_128bits_reset(xxh); }
  State(const State&) = delete;
  State& operator=(const State&) = delete;
  ~State() { XXH3_freeState(xxh); }

  void bytes(const void* data, std::size_t size) { XXH3_128bits_update(xxh, data, size); }

  template <class T>
  requires(std::is_arithmetic_v<T> || std::is_enum_v<T>) void add(T value) {
    bytes(&value, sizeof(value));
  }
  void add(const Eigen::Vector3d& v) { bytes(v.data(), 3 * sizeof(double)); }
  void add(const Pose& pose) {
    bytes(pose.rotation.coeffs().data(), 4 * sizeof(double));
    add(pose.translation);
  }
  void add(const cv::Mat& image) {
    add(image.rows);
    add(image.cols);
    add(image.type());
    for (int row = 0; row < image.rows; ++row) {
      bytes(image.ptr(row), static_cast<std::size_t>(image.cols) * image.elemSize());
    }
  }
  void add(const Trajectory& trajectory) {
    add(trajectory.size());
    for (const auto& [stamp, pose] : trajectory) {
      add(stamp);
      add(pose);
    }
  }
  void add(const TagSighting& tag) {
    add(tag.camera);
    add(tag.id);
    for (const Eigen::Vector2d& corner : tag.corners) bytes(corner.data(), 2 * sizeof(double));
    add(tag.T_cam_tag);
  }
  void add(const LoopClosure& closure) {
    add(closure.tag_id);
    add(closure.earlier);
    add(closure.later);
    add(closure.T_earlier_later);
    add(closure.correction);
  }
  void add(const Frame& frame) {
    add(frame.index);
    add(frame.stamp);
    for (const cv::Mat& image : frame.images) add(image);
    for (const Stamp stamp : frame.image_stamps) add(stamp);
    for (const ImuSample& sample : frame.imu) {
      add(sample.stamp);
      add(sample.angular_velocity);
      add(sample.specific_force);
    }
    for (const WheelSample& sample : frame.wheels) {
      add(sample.stamp);
      for (std::size_t i = 0; i < sample.angle.size(); ++i) {
        add(sample.angle[i]);
        add(sample.velocity[i]);
      }
    }
  }
  /// Cartons always; the other classes only where they are seen.
  void add(const Occlusion& occlusion) {
    add(occlusion.share(OccluderClass::kCarton));
    for (std::size_t i = 0; i < kOccluderClasses; ++i) {
      const auto one = static_cast<OccluderClass>(i);
      if (one == OccluderClass::kCarton || occlusion.share(one) == 0) continue;
      add(one);
      add(occlusion.share(one));
    }
  }
  void add(const Truth& truth) {
    if (truth.known) add(truth.T_world_body);
    for (const Occlusion& occlusion : truth.occlusion) add(occlusion);
    for (const int tag : truth.visible_tags) add(tag);
  }
  void add(const Estimate& estimate) {
    add(estimate.stamp);
    add(estimate.status);
    add(estimate.keyframe);
    if (estimate.T_map_body) add(*estimate.T_map_body);
    for (const CameraCounts& counts : estimate.cameras) {
      for (const int n : {counts.features, counts.stereo, counts.matches, counts.inliers}) add(n);
    }
    for (const TagSighting& tag : estimate.tags) add(tag);
    if (estimate.loop_closure) add(*estimate.loop_closure);
  }

  XXH3_state_t* xxh;
};

RunHash::RunHash() : state_(std::make_unique<State>()) {}
RunHash::~RunHash() = default;

void RunHash::on_tick(const Sample& sample, const Estimate& estimate) {
  state_->add(sample.frame);
  state_->add(sample.truth);
  state_->add(estimate);
}

void RunHash::on_finish(const SlamSummary& summary) {
  state_->add(summary.trajectory);
  state_->add(summary.keyframes);
  state_->add(summary.landmarks);
}

void RunHash::add(std::string_view text) {
  state_->bytes(text.data(), text.size());
}

std::string RunHash::digits() const {
  const XXH128_hash_t hash = XXH3_128bits_digest(state_->xxh);
  return fmt::format("{:016x}{:016x}", hash.high64, hash.low64);
}

}  // namespace vinebench::harness
