// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <yaml-cpp/yaml.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/geometry/camera.h"
#include "core/geometry/pose.h"
#include "core/geometry/rig.h"

namespace vinebench::harness {

/// Lines of a lens: EuRoC's own names, and Kalibr's for fisheyes ("equidistant"; the camera model
/// "ds", with xi and alpha before its other intrinsics).
std::string sensor_lens(const PinholeCamera& camera);

/// A sensor.yaml of an EuRoC/ASL folder, or a camera's part of a file of Kalibr, which has the same
/// words. Unknown keys are ignored, because files of others have additional ones; the keys that are
/// read are validated. Throws Error with file and line.
class SensorFile {
 public:
  explicit SensorFile(std::filesystem::path file);

  /// The map of that key; none if it is absent.
  std::optional<SensorFile> part(const std::string& key) const;
  Pose T_BS() const;  ///< sensor to body
  /// Four rows of four numbers; none if it is absent.
  std::optional<Pose> transform(const std::string& key) const;
  PinholeCamera camera() const;  ///< with any lens of LensModel, by the names of sensor_lens()
  std::optional<double> rate_hz() const;
  /// A time of less than ten seconds; none if it is absent.
  std::optional<double> seconds(const std::string& key) const;
  /// Noise of an inertial unit; none unless all four numbers are there and above 0.
  std::optional<ImuNoise> imu_noise() const;

  /// Throws Error with the place of this part.
  [[noreturn]] void fault(const std::string& message) const { fault(root_, message); }

 private:
  SensorFile(std::filesystem::path file, YAML::Node root)
      : file_(std::move(file)), root_(std::move(root)) {}
  /// `place` is for errors.
  Pose pose_of(const YAML::Node& data, const YAML::Node& place, const std::string& key) const;
  LensModel lens_model() const;
  std::optional<double> positive(const std::string& key) const;
  [[noreturn]] void fault(const YAML::Node& node, const std::string& message) const;
  std::vector<double> numbers(const YAML::Node& node, const std::string& key,
                              std::size_t count) const;
  void expect_word(const std::string& key, const std::vector<std::string>& words) const;

  std::filesystem::path file_;
  YAML::Node root_;
};

}  // namespace vinebench::harness
