// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "core/geometry/rig.h"
#include "core/util/random.h"
#include "slam/camera/estimator_rig.h"
#include "slam/camera/stereo_rig.h"
#include "slam/map/map.h"

namespace vinebench::test {

/// An aisle of random landmarks on two walls, and the features that a rig would extract there: the
/// back end is tested on these, without images. World frame: the aisle runs along x at y = 0.
class SyntheticAisle {
 public:
  SyntheticAisle(double noise_px, std::uint64_t seed, int landmarks = 6000)
      : noise_(noise_px), seed_(seed) {
    rig = slam::make_stereo_rig(load_rig(VINEBENCH_SOURCE_DIR "/models/csl-rover/rig.yaml"), {});
    calibration.resize(2);
    RandomSequence random(RandomStream(seed, "aisle"));
    for (int i = 0; i < landmarks; ++i) {
      const double side = i % 2 == 0 ? 0.5 : -0.5;
      // One after the other: compilers differ in the order of arguments.
      const double z = random.uniform(0.0, 1.4);
      const double y = side + random.uniform(-0.1, 0.1);
      const double x = random.uniform(-4, 8);
      points_.emplace_back(x, y, z);
      slam::Descriptor descriptor;
      const RandomStream bits(seed, "descriptor", static_cast<std::uint64_t>(i));
      for (std::size_t w = 0; w < 4; ++w) descriptor[w] = bits.bits(w);
      descriptors_.push_back(descriptor);
      index_[descriptor] = i;
    }
  }

  /// The point of a feature, and its position in the world.
  int point_of(const slam::Descriptor& descriptor) const { return index_.at(descriptor); }
  const Eigen::Vector3d& point(int index) const { return points_[static_cast<std::size_t>(index)]; }

  /// Pairs listed in `blind` have no features.
  std::shared_ptr<slam::FrameFeatures> frame(std::int64_t index, const Pose& T_world_body,
                                             const std::vector<std::size_t>& blind = {}) const {
    auto features = std::make_shared<slam::FrameFeatures>();
    features->index = index;
    features->stamp = stamp_of_frame(index, 15);
    features->velocity = velocity;
    features->views.resize(rig.pairs.size());
    for (std::size_t v = 0; v < rig.pairs.size(); ++v) {
      const bool sees = std::find(blind.begin(), blind.end(), v) == blind.end();
      if (sees) fill(*features, v, T_world_body);
      slam::StereoView& view = features->views[v];
      view.grid = slam::FeatureGrid(view.features.keypoints, rig.pairs[v].lens.width,
                                    rig.pairs[v].lens.height);
    }
    return features;
  }

  /// The same with a tag in the side camera's view.
  std::shared_ptr<slam::FrameFeatures> frame_with_tag(std::int64_t index, const Pose& T_world_body,
                                                      const Pose& T_world_tag) const {
    auto features = std::make_shared<slam::FrameFeatures>(*frame(index, T_world_body));
    const int camera = rig.tag_cameras.front();
    const RigCamera& side = rig.cameras[static_cast<std::size_t>(camera)];
    TagSighting sighting;
    sighting.camera = camera;
    sighting.family = "tag36h11";
    sighting.id = 0;
    sighting.T_cam_tag = (T_world_body * side.T_body_cam).inverse() * T_world_tag;
    const double h = 0.161 / 2;
    const Eigen::Vector3d corners[] = {{-h, h, 0}, {h, h, 0}, {h, -h, 0}, {-h, -h, 0}};
    for (std::size_t c = 0; c < 4; ++c) {
      sighting.corners[c] = side.model.project(sighting.T_cam_tag * corners[c]);
    }
    features->tags.push_back(sighting);
    return features;
  }

  slam::StereoRig rig;
  std::vector<PairCalibration> calibration;  ///< by what the first pairs differ from the rig
  Vector6d velocity = Vector6d::Zero();      ///< of the body, m/s and rad/s

 private:
  /// A point from the camera, when its row is exposed.
  Eigen::Vector3d seen(const Eigen::Vector3d& p_world, const slam::StereoCameraModel& camera,
                       const Pose& T_world_body) const {
    Eigen::Vector3d p = camera.T_cam_body * (T_world_body.inverse() * p_world);
    // A row's time depends on the row: each round brings it nearer by the velocity's share of 1e-2.
    for (int round = 0; camera.has_times() && round < 5 && p.z() > 0.1; ++round) {
      const Pose way = step_of(velocity * camera.time_of(camera.lens.project(p).y()));
      p = camera.T_cam_body * ((T_world_body * way).inverse() * p_world);
    }
    return p;
  }

  void fill(slam::FrameFeatures& features, std::size_t v, const Pose& T_world_body) const {
    const slam::RectifiedPair& pair = rig.pairs[v];
    const slam::StereoCameraModel camera =
        slam::calibrated({pair.lens, pair.T_cam_body, pair.baseline},
                         v < calibration.size() ? calibration[v] : PairCalibration{});
    const RandomStream draw(seed_, "noise" + std::to_string(v),
                            static_cast<std::uint64_t>(features.index));
    slam::StereoView& view = features.views[v];
    for (std::size_t i = 0; i < points_.size() && view.features.size() < 1000; ++i) {
      const Eigen::Vector3d p = seen(points_[i], camera, T_world_body);
      if (p.z() < 0.15 || p.z() > 4.8) continue;
      const Eigen::Vector2d pixel = camera.lens.project(p);
      if (!camera.lens.contains(pixel, 19)) continue;
      const int level =
          std::clamp(static_cast<int>(std::lround(std::log(2.0 / p.norm()) / std::log(1.2))), 0, 7);
      const double sigma = noise_ * std::pow(1.2, level);
      slam::Keypoint keypoint;
      keypoint.x = static_cast<float>(pixel.x() + sigma * draw.normal(3 * i));
      keypoint.y = static_cast<float>(pixel.y() + sigma * draw.normal(3 * i + 1));
      keypoint.level = level;
      const double disparity =
          camera.disparity_of(pixel, p.z()) + 0.5 * sigma * draw.normal(3 * i + 2);
      slam::StereoMatch match;
      match.x_right = static_cast<float>(keypoint.x - disparity);
      match.depth = static_cast<float>(pair.lens.fx * pair.baseline / disparity);
      view.features.keypoints.push_back(keypoint);
      view.features.descriptors.push_back(descriptors_[i]);
      view.stereo.push_back(match);
    }
  }

  double noise_;
  std::uint64_t seed_;
  std::vector<Eigen::Vector3d> points_;
  std::vector<slam::Descriptor> descriptors_;
  std::map<slam::Descriptor, int> index_;
};

}  // namespace vinebench::test
