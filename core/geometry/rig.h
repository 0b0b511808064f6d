// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/format.h>

#include <Eigen/Core>
#include <array>
#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "core/config/config_field.h"
#include "core/geometry/camera.h"
#include "core/geometry/pose.h"

namespace vinebench {

/// One camera of a rig: its model and its pose on the body.
struct RigCamera {
  std::string name;
  PinholeCamera model;
  Pose T_body_cam;  ///< optical camera frame (x right, y down, z ahead) to body
};

/// Two cameras of a rig that see the same scene along a common baseline.
struct StereoPair {
  std::string name;
  int left = 0;  ///< index into Rig::cameras
  int right = 0;
};

/// Noise of an inertial unit as its data sheet or a calibration has it (unit u = rad/s or m/s^2).
struct ImuNoise {
  struct Axes {
    double noise_density = 0;     ///< u/sqrt(Hz), white noise
    double bias_random_walk = 0;  ///< u/s/sqrt(Hz), white noise of the bias's rate

    template <class Archive>
    void serialize(Archive& archive) {
      archive("noise_density", noise_density, Range::positive());
      archive("bias_random_walk", bias_random_walk, Range::positive());
    }

    /// A filter that takes a reading to be exact is none.
    bool is_complete() const { return noise_density > 0 && bias_random_walk > 0; }
  };
  Axes gyroscope;
  Axes accelerometer;

  template <class Archive>
  void serialize(Archive& archive) {
    archive("gyroscope", gyroscope);
    archive("accelerometer", accelerometer);
  }
};

/// N rigidly mounted cameras exposed at the same instant. A camera is data: its index.
struct Rig {
  std::string name;
  double rate_hz = 15;  ///< frames a second
  std::vector<RigCamera> cameras;
  std::vector<StereoPair> stereo_pairs;  ///< used for tracking
  std::vector<int> tag_cameras;          ///< in which AprilTags are detected
  std::optional<ImuNoise> imu;           ///< of its inertial unit, where it is known

  /// Index of the camera with that name, or -1.
  int find_camera(const std::string& name) const;

  /// Distance between the two cameras of a pair, m.
  double baseline(const StereoPair& pair) const;

  /// One rectified pair whose left camera is the body's origin and looks along its x axis; the
  /// right camera is `baseline` (m) to the right of it. Its cameras are "left" and "right".
  static Rig stereo(const PinholeCamera& lens, double baseline);

  /// Pose of a camera at `position` (m) that looks along the x axis of a body-like frame (x
  /// forward, y left, z up) rotated by roll, pitch, yaw (rad) against the body.
  static Pose mount(const Eigen::Vector3d& position, const Eigen::Vector3d& rpy);
};

inline constexpr int kSmallestImageSide = 16,
                     kLargestImageSide = 16384;  ///< px, of a rig's cameras

/// The YAML form of a rig, with angles in degrees.
struct RigConfig {
  struct Camera {
    std::string name;                               ///< of its topics and files
    int width = 752;                                ///< px
    int height = 480;                               ///< px
    double fx = 263.2786;                           ///< px
    double fy = 263.2786;                           ///< px
    std::optional<double> cx;                       ///< px; default: the centre, (width - 1) / 2
    std::optional<double> cy;                       ///< px; default: the centre, (height - 1) / 2
    LensModel lens = LensModel::kRadialTangential;  ///< how it bends what a pinhole would see
    std::vector<double> distortion = {0, 0, 0, 0};  ///< the lens model's coefficients
    Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< m, in the body frame
    Eigen::Vector3d rpy_deg = Eigen::Vector3d::Zero();   ///< view direction against the body

    template <class Archive>
    void serialize(Archive& archive) {
      archive("name", name);
      archive("width", width, Range::between(kSmallestImageSide, kLargestImageSide));
      archive("height", height, Range::between(kSmallestImageSide, kLargestImageSide));
      archive("fx", fx, Range::positive());
      archive("fy", fy, Range::positive());
      archive("cx", cx);
      archive("cy", cy);
      archive("lens", lens);
      archive("distortion", distortion);
      archive.require(has_coefficients(lens, distortion.size()), "distortion",
                      expected_coefficients(lens));
      archive("position", position);
      archive("rpy_deg", rpy_deg, Range::between(-360, 360));
    }
  };
  struct Pair {
    std::string name;   ///< of the pair
    std::string left;   ///< name of its left camera
    std::string right;  ///< name of its right camera

    template <class Archive>
    void serialize(Archive& archive) {
      archive("name", name);
      archive("left", left);
      archive("right", right);
    }
  };

  std::string name = "rig";  ///< of the rig
  double rate_hz = 15;       ///< frames a second
  std::vector<Camera> cameras;
  std::vector<Pair> stereo_pairs;
  std::vector<std::string> tag_cameras;  ///< names of those that search for tags
  std::optional<ImuNoise> imu;           ///< what is known of its inertial unit

  template <class Archive>
  void serialize(Archive& archive) {
    archive("name", name);
    archive("rate_hz", rate_hz, Range::positive());
    archive("cameras", cameras);
    archive("stereo_pairs", stereo_pairs);
    archive("tag_cameras", tag_cameras);
    archive("imu", imu);
    check(archive);
  }

  /// Throws Error if a name is unknown (not possible with a validated config).
  Rig make() const;

 private:
  static constexpr std::size_t kMostCameras = 64;

  template <class Archive>
  void check(Archive& archive) const {
    archive.require(!cameras.empty(), "cameras", "expected at least one camera");
    archive.require(
        cameras.size() <= kMostCameras, "cameras",
        fmt::format("expected at most {} cameras, found {}", kMostCameras, cameras.size()));
    archive.require(!imu || (imu->gyroscope.is_complete() && imu->accelerometer.is_complete()),
                    "imu",
                    "expected noise_density and bias_random_walk of gyroscope and accelerometer");
    std::set<std::string> names;
    for (std::size_t i = 0; i < cameras.size(); ++i) {
      archive.require(names.insert(cameras[i].name).second, fmt::format("cameras.{}", i),
                      fmt::format("expected a name of its own, '{}' is taken", cameras[i].name));
    }
    const auto known = [this](const std::string& camera) {
      for (const Camera& c : cameras) {
        if (c.name == camera) return true;
      }
      return false;
    };
    for (std::size_t i = 0; i < stereo_pairs.size(); ++i) {
      for (const std::string& camera : {stereo_pairs[i].left, stereo_pairs[i].right}) {
        archive.require(
            known(camera), fmt::format("stereo_pairs.{}", i),
            fmt::format("expected the name of a camera of this rig, found '{}'", camera));
      }
    }
    for (std::size_t i = 0; i < tag_cameras.size(); ++i) {
      archive.require(
          known(tag_cameras[i]), fmt::format("tag_cameras.{}", i),
          fmt::format("expected the name of a camera of this rig, found '{}'", tag_cameras[i]));
    }
  }
};

/// Reads a rig from its YAML file. Throws Error that names file, line and key.
Rig load_rig(const std::filesystem::path& file);

}  // namespace vinebench
