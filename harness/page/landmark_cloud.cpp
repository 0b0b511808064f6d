// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/page/landmark_cloud.h"

#include <array>
#include <charconv>
#include <cmath>
#include <cstring>
#include <string_view>

#include "core/files/files.h"
#include "core/util/error.h"

namespace vinebench::harness {
namespace {

constexpr std::size_t kMostPoints = 20'000;
constexpr std::size_t kPoint = 27;  // bytes: six floats and three colours
constexpr double kCentimetres = 100;
constexpr std::string_view kCount = "element vertex ";
constexpr std::string_view kProperties =
    "property float x\nproperty float y\nproperty float z\n"
    "property float nx\nproperty float ny\nproperty float nz\n"
    "property uchar red\nproperty uchar green\nproperty uchar blue\nend_header\n";

/// The points' bytes.
std::string_view points_of(std::string_view ply, const std::string& file) {
  const auto wrong = [&] { fail("{}: expected a point cloud of the SLAM core (PLY)", file); };
  const std::size_t count_at = ply.find(kCount), properties = ply.find(kProperties);
  if (!ply.starts_with("ply\nformat binary_little_endian 1.0\n") ||
      count_at == std::string_view::npos || properties == std::string_view::npos) {
    wrong();
  }
  std::size_t count = 0;
  const char* begin = ply.data() + count_at + kCount.size();
  if (std::from_chars(begin, ply.data() + ply.size(), count).ec != std::errc()) wrong();
  const std::string_view points = ply.substr(properties + kProperties.size());
  if (points.size() % kPoint != 0 || points.size() / kPoint != count) {
    fail("{}: expected {} landmarks of {} bytes, found {} bytes", file, count, kPoint,
         points.size());
  }
  return points;
}

}  // namespace

nlohmann::ordered_json landmarks_json(const std::filesystem::path& file, const Pose& T_world_map) {
  const std::string ply = read_file(file, FileKind::kMap);
  const std::string_view points = points_of(ply, file.string());
  const std::size_t count = points.size() / kPoint;
  const std::size_t step = std::max<std::size_t>(1, (count + kMostPoints - 1) / kMostPoints);
  auto list = nlohmann::ordered_json::array();
  for (std::size_t i = 0; i < count; i += step) {
    std::array<float, 3> p{};
    std::memcpy(p.data(), points.data() + i * kPoint, sizeof(p));
    const Eigen::Vector3d in_world = T_world_map * Eigen::Vector3f(p.data()).cast<double>();
    if (!in_world.allFinite() || in_world.cwiseAbs().maxCoeff() > 1e6) continue;
    for (const double metres : in_world) list.push_back(std::lround(kCentimetres * metres));
    list.push_back(static_cast<std::uint8_t>(points[i * kPoint + kPoint - 1]));
  }
  return list;
}

}  // namespace vinebench::harness
