// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/datasets/ros2/bag/bag_rig.h"

#include <algorithm>
#include <cmath>

#include "core/util/error.h"

namespace vinebench::harness {
namespace {

constexpr double kRectificationTolerance = 1e-3;  // of an entry of R R^T
constexpr double kSmallestBaseline = 1e-4;        // m

using RowMajor3 = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;

/// The calibration of one topic, with its name for errors.
struct Told {
  const std::string& topic;
  const RosCameraInfo& info;

  template <class... Args>
  [[noreturn]] void fault(fmt::format_string<Args...> format, Args&&... args) const {
    fail("topic {}: {}", topic, fmt::format(format, std::forward<Args>(args)...));
  }
};

Told told_of(const BagContents& contents, const BagCamera& camera) {
  const auto found = contents.cameras.find(camera.info);
  if (found == contents.cameras.end()) {
    fail("{}: expected the calibration of {} on {}, found none; --rig replaces it",
         contents.names.front().string(), camera.topic, camera.info);
  }
  return {found->first, found->second};
}

void expect_size_and_lens(const Told& told, const PinholeCamera& lens) {
  for (const int side : {lens.width, lens.height}) {
    if (side < kSmallestImageSide || side > kLargestImageSide) {
      told.fault("expected {} to {} pixels a side, found {}", kSmallestImageSide, kLargestImageSide,
                 side);
    }
  }
  const bool finite = std::isfinite(lens.fx) && std::isfinite(lens.fy) && std::isfinite(lens.cx) &&
                      std::isfinite(lens.cy);
  if (!finite || lens.fx <= 0 || lens.fy <= 0) {
    told.fault("expected a calibrated camera: focal lengths above 0, found {} and {}", lens.fx,
               lens.fy);
  }
}

/// By ROS's names, and image_pipeline's for fisheyes.
LensModel lens_model_of(const Told& told) {
  const std::string& name = told.info.model;
  if (name == "equidistant" || name == "fisheye") return LensModel::kEquidistant;
  const bool none = std::ranges::all_of(told.info.D, [](double d) { return d == 0; });
  if (!none && !name.empty() && name != "plumb_bob" && name != "radtan" &&
      name != "rational_polynomial") {
    told.fault("expected the lens plumb_bob or equidistant, found {}: rectify the images, or --rig",
               name);
  }
  return LensModel::kRadialTangential;
}

/// A rectified image has the lens of P; a raw one that of K and D.
PinholeCamera lens_of(const Told& told, bool rectified) {
  const RosCameraInfo& info = told.info;
  PinholeCamera lens{info.width, info.height, info.K[0], info.K[4], info.K[2], info.K[5]};
  if (rectified) {
    lens.fx = info.P[0];
    lens.fy = info.P[5];
    lens.cx = info.P[2];
    lens.cy = info.P[6];
  }
  expect_size_and_lens(told, lens);
  if (rectified) return lens;
  const LensModel model = lens_model_of(told);
  for (const double d : info.D) {
    if (!std::isfinite(d)) told.fault("expected finite coefficients of the lens");
  }
  std::vector<double> d(info.D.begin(), info.D.end());
  while (!d.empty() && d.back() == 0) d.pop_back();  // of a rational_polynomial that is none
  const std::size_t most = model == LensModel::kEquidistant ? 4 : 5;
  if (d.size() > most) {
    told.fault("{}, found more: rectify the images", expected_coefficients(model));
  }
  lens.set_lens(model, d);
  return lens;
}

/// R_rect_cam, from the camera's axes to those of the pair's rectified view.
Eigen::Quaterniond rectifying(const Told& told) {
  const RowMajor3 R = Eigen::Map<const RowMajor3>(told.info.R.data());
  if (R.isIdentity(0) || R.isZero(0)) return Eigen::Quaterniond::Identity();
  if (!is_rotation(R, kRectificationTolerance)) told.fault("R: expected a rotation");
  return Eigen::Quaterniond(Eigen::Matrix3d(R)).normalized();
}

/// m; 0 where P has none.
double baseline_of(const Told& told) {
  const double baseline = -told.info.P[3] / told.info.P[0];
  return std::isfinite(baseline) ? baseline : 0;
}

/// Rotations of no angle stay the bits they are.
Pose turned(const Pose& T, const Eigen::Quaterniond& rotation) {
  if (rotation.w() == 1) return T;
  return T * Pose{rotation, Eigen::Vector3d::Zero()};
}

class RigMaker {
 public:
  RigMaker(const BagContents& contents, const BagCameras& cameras)
      : contents_(contents), cameras_(cameras), result_(place_frames(contents, cameras)) {}

  BagRig make() {
    Rig& rig = result_.rig;
    rig.name = "ROS 2";
    rig.stereo_pairs = cameras_.pairs;
    for (const BagCamera& camera : cameras_.cameras) {
      const Told told = told_of(contents_, camera);
      rig.cameras.push_back({camera.name, lens_of(told, camera.rectified), {}});
    }
    std::vector<bool> placed(rig.cameras.size(), false);
    for (const StereoPair& pair : rig.stereo_pairs) {
      place_pair(pair);
      placed[static_cast<std::size_t>(pair.left)] = true;
      placed[static_cast<std::size_t>(pair.right)] = true;
    }
    for (std::size_t i = 0; i < placed.size(); ++i) {
      if (!placed[i]) place_tag_camera(i);
    }
    drop_unplaced();
    return std::move(result_);
  }

 private:
  const std::string& frame_of(std::size_t camera) const {
    return contents_.images.at(cameras_.cameras[camera].topic).frame;
  }

  /// Of the camera's own axes, or those of its rectified image.
  std::optional<Pose> mount_of(std::size_t camera) const {
    const std::optional<Pose> T_body_cam = result_.body_from(frame_of(camera));
    if (!T_body_cam || !cameras_.cameras[camera].rectified) return T_body_cam;
    const Told told = told_of(contents_, cameras_.cameras[camera]);
    return turned(*T_body_cam, rectifying(told).conjugate());
  }

  void place_pair(const StereoPair& pair) {
    const auto left = static_cast<std::size_t>(pair.left);
    const auto right = static_cast<std::size_t>(pair.right);
    const std::optional<Pose> T_body_left = mount_of(left);
    if (!T_body_left) {
      fail("{}: expected the frame '{}' of {} in /tf_static, connected with '{}'",
           contents_.names.front().string(), frame_of(left), cameras_.cameras[left].topic,
           result_.reference);
    }
    RigCamera& camera = result_.rig.cameras[right];
    result_.rig.cameras[left].T_body_cam = *T_body_left;
    camera.T_body_cam = right_of(left, right, *T_body_left);
    if (!(result_.rig.baseline(pair) >= kSmallestBaseline)) {
      told_of(contents_, cameras_.cameras[right])
          .fault(
              "expected a pair's right camera: its place in /tf_static, or P[3] = -fx times the "
              "baseline");
    }
  }

  /// Rectified images agree with P by their making; the places of raw ones are in /tf_static, and
  /// where they are not, in R and P.
  Pose right_of(std::size_t left, std::size_t right, const Pose& T_body_left) const {
    const Told told = told_of(contents_, cameras_.cameras[right]);
    const Eigen::Vector3d along(baseline_of(told), 0, 0);
    const bool rectified = cameras_.cameras[left].rectified && cameras_.cameras[right].rectified;
    if (rectified && along.x() >= kSmallestBaseline) {
      return {T_body_left.rotation, T_body_left * along};
    }
    const bool same_frame = frame_of(left) == frame_of(right);
    if (const auto mount = mount_of(right); mount && !same_frame) return *mount;
    const Told left_told = told_of(contents_, cameras_.cameras[left]);
    const Pose T_body_view = turned(T_body_left, rectifying(left_told).conjugate());
    return turned({T_body_view.rotation, T_body_view * along}, rectifying(told));
  }

  void place_tag_camera(std::size_t camera) {
    const std::optional<Pose> mount = mount_of(camera);
    if (!mount) return;
    result_.rig.cameras[camera].T_body_cam = *mount;
    result_.rig.tag_cameras.push_back(static_cast<int>(camera));
  }

  /// A camera outside of the pairs whose place is not known is of no use: those are the last ones.
  void drop_unplaced() {
    Rig& rig = result_.rig;
    std::size_t used = 2 * rig.stereo_pairs.size();
    if (!rig.tag_cameras.empty()) {
      used = std::max(used, static_cast<std::size_t>(rig.tag_cameras.back()) + 1);
    }
    rig.cameras.resize(std::min(used, rig.cameras.size()));
  }

  const BagContents& contents_;
  const BagCameras& cameras_;
  BagRig result_;
};

}  // namespace

std::optional<Pose> BagRig::body_from(const std::string& frame) const {
  const std::optional<Pose> T_reference_frame = mounts.between(reference, frame);
  if (!T_reference_frame || reference == kRosBody) return T_reference_frame;
  return T_body_reference * *T_reference_frame;
}

BagRig place_frames(const BagContents& contents, const BagCameras& cameras) {
  const std::string& left = contents.images.at(cameras.cameras.front().topic).frame;
  BagRig place{.rig = {},
               .mounts = TransformTree(contents.mounts),
               .reference = kRosBody,
               .T_body_reference = {}};
  if (place.mounts.between(kRosBody, left)) return place;
  place.reference = left;
  place.T_body_reference = Rig::mount(Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero());
  return place;
}

BagRig read_bag_rig(const BagContents& contents, const BagCameras& cameras) {
  if (cameras.pairs.empty()) fault_without_pair(contents);
  return RigMaker(contents, cameras).make();
}

}  // namespace vinebench::harness
