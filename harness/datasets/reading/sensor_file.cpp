// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/datasets/reading/sensor_file.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "core/files/files.h"
#include "core/util/error.h"

namespace vinebench::harness {
namespace {

/// Some writers begin with OpenCV's "%YAML:1.0", which is not valid YAML.
std::string without_directive(std::string text) {
  if (text.starts_with("%YAML")) text[0] = '#';
  return text;
}

constexpr double kHighestRate = 1e6;      // Hz
constexpr double kLongestTime = 10;       // s
constexpr double kMountTolerance = 1e-3;  // of an entry of R R^T

}  // namespace

std::string sensor_lens(const PinholeCamera& c) {
  const std::string coefficients = fmt::format("{}", fmt::join(c.coefficients(), ", "));
  const std::string pinhole = fmt::format("{}, {}, {}, {}", c.fx, c.fy, c.cx, c.cy);
  if (c.lens == LensModel::kDoubleSphere) {
    return fmt::format("camera_model: ds\nintrinsics: [{}, {}]\ndistortion_model: none\n",
                       coefficients, pinhole);
  }
  return fmt::format(
      "camera_model: pinhole\nintrinsics: [{}]\ndistortion_model: {}\n"
      "distortion_coefficients: [{}]\n",
      pinhole, c.lens == LensModel::kEquidistant ? "equidistant" : "radial-tangential",
      coefficients);
}

SensorFile::SensorFile(std::filesystem::path file) : file_(std::move(file)) {
  const std::string text = without_directive(read_file(file_, FileKind::kYaml));
  try {
    root_ = YAML::Load(text);
  } catch (const YAML::Exception& error) {
    fail("{}:{}: is not valid YAML: {}", file_.string(), error.mark.line + 1, error.msg);
  }
  if (!root_.IsMap()) fail("{}:1: expected a map of keys", file_.string());
}

void SensorFile::fault(const YAML::Node& node, const std::string& message) const {
  const int line = node.IsDefined() && !node.Mark().is_null() ? node.Mark().line + 1 : 1;
  fail("{}:{}: {}", file_.string(), line, message);
}

std::vector<double> SensorFile::numbers(const YAML::Node& node, const std::string& key,
                                        std::size_t count) const {
  if (!node.IsDefined())
    fault(root_, fmt::format("{}: expected {} numbers, is absent", key, count));
  if (!node.IsSequence() || node.size() != count) {
    fault(node, fmt::format("{}: expected {} numbers, found {}", key, count,
                            node.IsSequence() ? fmt::format("{}", node.size()) : "no list"));
  }
  std::vector<double> values;
  for (const YAML::Node& item : node) {
    double value = 0;
    if (!YAML::convert<double>::decode(item, value) || !std::isfinite(value)) {
      fault(item, fmt::format("{}: expected a number, found '{}'", key,
                              item.IsScalar() ? item.Scalar() : ""));
    }
    values.push_back(value);
  }
  return values;
}

void SensorFile::expect_word(const std::string& key, const std::vector<std::string>& words) const {
  const YAML::Node node = root_[key];
  if (!node.IsDefined()) return;
  const std::string found = node.IsScalar() ? node.Scalar() : "";
  if (std::ranges::count(words, found) == 0) {
    fault(node, fmt::format("{}: expected {}, found '{}'", key, fmt::join(words, " or "), found));
  }
}

std::optional<SensorFile> SensorFile::part(const std::string& key) const {
  const YAML::Node node = root_[key];
  if (!node.IsDefined()) return std::nullopt;
  if (!node.IsMap()) fault(node, fmt::format("{}: expected a map of keys", key));
  return SensorFile(file_, node);
}

Pose SensorFile::T_BS() const {
  const YAML::Node node = root_["T_BS"];
  const YAML::Node data = node.IsDefined() && node.IsMap() ? node["data"] : node;
  return pose_of(data, data, "T_BS");
}

std::optional<Pose> SensorFile::transform(const std::string& key) const {
  const YAML::Node node = root_[key];
  if (!node.IsDefined()) return std::nullopt;
  const std::string rows = key + ": expected four rows of numbers";
  if (!node.IsSequence()) fault(node, rows);
  YAML::Node data(YAML::NodeType::Sequence);
  for (const YAML::Node& row : node) {
    if (!row.IsSequence()) fault(node, rows);
    for (const YAML::Node& number : row) data.push_back(number);
  }
  if (data.size() != 16) fault(node, fmt::format("{}: expected four rows of four numbers", key));
  return pose_of(data, node, key);
}

Pose SensorFile::pose_of(const YAML::Node& data, const YAML::Node& place,
                         const std::string& key) const {
  const std::vector<double> v = numbers(data, key, 16);
  Eigen::Matrix4d T;
  for (Eigen::Index i = 0; i < 16; ++i) T(i / 4, i % 4) = v[static_cast<std::size_t>(i)];
  const Eigen::Matrix3d R = T.topLeftCorner<3, 3>();
  if (!is_rotation(R, kMountTolerance) || !T.row(3).isApprox(Eigen::RowVector4d(0, 0, 0, 1))) {
    fault(place, key + ": expected a rotation and a translation, row by row, with 0 0 0 1 last");
  }
  if (R.isIdentity(0)) return {Eigen::Quaterniond::Identity(), T.topRightCorner<3, 1>()};
  return {Eigen::Quaterniond(R).normalized(), T.topRightCorner<3, 1>()};
}

LensModel SensorFile::lens_model() const {
  const YAML::Node camera = root_["camera_model"], distortion = root_["distortion_model"];
  expect_word("camera_model", {"pinhole", "ds"});
  expect_word("distortion_model",
              {"radial-tangential", "radtan", "plumb_bob", "equidistant", "equi", "none"});
  const auto is = [](const YAML::Node& node, const char* word) {
    return node.IsDefined() && node.Scalar() == word;
  };
  if (is(camera, "ds")) return LensModel::kDoubleSphere;
  return is(distortion, "equidistant") || is(distortion, "equi") ? LensModel::kEquidistant
                                                                 : LensModel::kRadialTangential;
}

PinholeCamera SensorFile::camera() const {
  const LensModel lens = lens_model();
  const bool double_sphere = lens == LensModel::kDoubleSphere;
  const std::vector<double> size = numbers(root_["resolution"], "resolution", 2);
  std::vector<double> k = numbers(root_["intrinsics"], "intrinsics", double_sphere ? 6 : 4);
  for (const double side : size) {
    if (side < kSmallestImageSide || side > kLargestImageSide || side != std::floor(side)) {
      fault(root_["resolution"],
            fmt::format("resolution: expected {} to {} pixels a side, found {}", kSmallestImageSide,
                        kLargestImageSide, side));
    }
  }
  std::vector<double> coefficients;
  if (double_sphere) {
    coefficients = {k[0], k[1]};
    k.erase(k.begin(), k.begin() + 2);
  }
  PinholeCamera camera{
      static_cast<int>(size[0]), static_cast<int>(size[1]), k[0], k[1], k[2], k[3]};
  if (camera.fx <= 0 || camera.fy <= 0) {
    fault(root_["intrinsics"], "intrinsics: expected focal lengths above 0");
  }
  const std::string key =
      root_["distortion_coeffs"].IsDefined() ? "distortion_coeffs" : "distortion_coefficients";
  const YAML::Node node = root_[key];
  const bool some = node.IsDefined() && !(node.IsSequence() && node.size() == 0);
  if (!double_sphere && some) {
    const std::size_t count = node.IsSequence() ? node.size() : 0;
    if (!has_coefficients(lens, count)) {
      fault(node, fmt::format("{}: {}", key, expected_coefficients(lens)));
    }
    coefficients = numbers(node, key, count);
  }
  camera.set_lens(lens, coefficients);
  return camera;
}

std::optional<double> SensorFile::positive(const std::string& key) const {
  double value = 0;
  const YAML::Node node = root_[key];
  if (!node.IsDefined() || !YAML::convert<double>::decode(node, value)) return {};
  if (!(value > 0 && std::isfinite(value))) return {};
  return value;
}

std::optional<double> SensorFile::seconds(const std::string& key) const {
  const YAML::Node node = root_[key];
  if (!node.IsDefined()) return std::nullopt;
  double value = 0;
  if (!YAML::convert<double>::decode(node, value) || !(std::abs(value) < kLongestTime)) {
    fault(node, fmt::format("{}: expected seconds, less than {}, found '{}'", key, kLongestTime,
                            node.IsScalar() ? node.Scalar() : ""));
  }
  return value;
}

std::optional<double> SensorFile::rate_hz() const {
  const std::optional<double> rate = positive("rate_hz");
  return rate && *rate <= kHighestRate ? rate : std::nullopt;
}

std::optional<ImuNoise> SensorFile::imu_noise() const {
  const auto of = [this](const std::string& axes) -> std::optional<ImuNoise::Axes> {
    const auto density = positive(axes + "_noise_density");
    const auto walk = positive(axes + "_random_walk");
    if (!density || !walk) return std::nullopt;
    return ImuNoise::Axes{*density, *walk};
  };
  const auto gyroscope = of("gyroscope");
  const auto accelerometer = of("accelerometer");
  if (!gyroscope || !accelerometer) return std::nullopt;
  return ImuNoise{*gyroscope, *accelerometer};
}

}  // namespace vinebench::harness
