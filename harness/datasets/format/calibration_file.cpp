// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/datasets/format/calibration_file.h"

#include <cmath>

#include "core/config/yaml.h"
#include "core/config/yaml_writer.h"
#include "core/util/error.h"

namespace vinebench::harness {
namespace {

struct CalibrationConfig {
  struct Camera {
    std::string name;
    int width = 0;   ///< px
    int height = 0;  ///< px
    double fx = 1;   ///< px
    double fy = 1;   ///< px
    double cx = 0;   ///< px
    double cy = 0;   ///< px
    LensModel lens = LensModel::kRadialTangential;
    std::vector<double> distortion;                      ///< the lens model's coefficients
    Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< m
    Eigen::Vector4d rotation{0, 0, 0, 1};                ///< x, y, z, w
    template <class Archive>
    void serialize(Archive& archive) {
      archive("name", name);
      archive("width", width, Range::between(1, kLargestImageSide));
      archive("height", height, Range::between(1, kLargestImageSide));
      archive("fx", fx, Range::positive());
      archive("fy", fy, Range::positive());
      archive("cx", cx);
      archive("cy", cy);
      archive("lens", lens);
      archive("distortion", distortion);
      archive.require(has_coefficients(lens, distortion.size()), "distortion",
                      expected_coefficients(lens));
      archive("position", position);
      archive("rotation", rotation);
      archive.require(std::abs(rotation.norm() - 1) < 1e-6, "rotation",
                      "expected a unit quaternion (x, y, z, w)");
    }
  };
  std::vector<Camera> cameras;
  std::vector<RigConfig::Pair> stereo_pairs;
  template <class Archive>
  void serialize(Archive& archive) {
    archive("cameras", cameras);
    archive("stereo_pairs", stereo_pairs);
  }
};

}  // namespace

std::string format_calibration(const Rig& rig) {
  CalibrationConfig config;
  for (const RigCamera& camera : rig.cameras) {
    const PinholeCamera& c = camera.model;
    config.cameras.push_back({camera.name, c.width, c.height, c.fx, c.fy, c.cx, c.cy, c.lens,
                              c.coefficients(), camera.T_body_cam.translation,
                              camera.T_body_cam.rotation.coeffs()});
  }
  for (const StereoPair& pair : rig.stereo_pairs) {
    config.stereo_pairs.push_back({pair.name, rig.cameras[static_cast<std::size_t>(pair.left)].name,
                                   rig.cameras[static_cast<std::size_t>(pair.right)].name});
  }
  return format_yaml(config);
}

Rig read_calibration(const std::filesystem::path& file) {
  const auto config = YamlDocument::load(file).read<CalibrationConfig>();
  Rig rig;
  for (const CalibrationConfig::Camera& c : config.cameras) {
    PinholeCamera model{c.width, c.height, c.fx, c.fy, c.cx, c.cy};
    model.set_lens(c.lens, c.distortion);
    rig.cameras.push_back({c.name, model, Pose{Eigen::Quaterniond(c.rotation), c.position}});
  }
  for (const RigConfig::Pair& pair : config.stereo_pairs) {
    rig.stereo_pairs.push_back(
        {pair.name, rig.find_camera(pair.left), rig.find_camera(pair.right)});
    if (rig.stereo_pairs.back().left >= 0 && rig.stereo_pairs.back().right >= 0) continue;
    fail("{}: stereo pair '{}' names a camera that is not in the file", file.string(), pair.name);
  }
  return rig;
}

}  // namespace vinebench::harness
