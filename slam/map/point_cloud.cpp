// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/map/point_cloud.h"

#include "core/files/files.h"
#include "slam/map/binary_archive.h"

namespace vinebench::slam {
namespace {

constexpr std::uint8_t kUnknownGrey = 128;

/// Mean of the middle of a patch: a single pixel is mostly noise.
std::uint8_t grey_of(const Patch& patch) {
  int sum = 0;
  for (int y = -1; y <= 1; ++y) {
    for (int x = -1; x <= 1; ++x) {
      sum += patch.grey[static_cast<std::size_t>((Patch::kRadius + y) * Patch::kSide +
                                                 Patch::kRadius + x)];
    }
  }
  return static_cast<std::uint8_t>((sum + 4) / 9);
}

std::uint8_t grey_of(const Landmark& landmark, const Map& map) {
  for (const Observation& o : landmark.observations) {
    const auto& patches = map.keyframe(o.keyframe).patches;
    if (patches.empty()) continue;
    const PatchList& of_view = patches[static_cast<std::size_t>(o.view)];
    const auto f = static_cast<std::size_t>(o.feature);
    if (f >= of_view.size()) continue;
    if (const Patch* patch = of_view.find(f)) return grey_of(*patch);
  }
  return kUnknownGrey;
}

std::string header(std::size_t points) {
  return fmt::format(
      "ply\n"
      "format binary_little_endian 1.0\n"
      "comment landmarks of a Vinebench map, metres\n"
      "element vertex {}\n"
      "property float x\n"
      "property float y\n"
      "property float z\n"
      "property float nx\n"
      "property float ny\n"
      "property float nz\n"
      "property uchar red\n"
      "property uchar green\n"
      "property uchar blue\n"
      "end_header\n",
      points);
}

}  // namespace

std::string format_ply(const Map& map, int min_observations) {
  BinaryWriter points;
  std::size_t count = 0;
  for (const Landmark& landmark : map.landmarks()) {
    if (landmark.removed || count_keyframes(landmark) < min_observations) continue;
    const std::uint8_t grey = grey_of(landmark, map);
    points(Eigen::Vector3f(landmark.position.cast<float>()),
           Eigen::Vector3f(-landmark.normal.cast<float>()), grey, grey, grey);
    ++count;
  }
  return header(count) + points.take();
}

void save_point_cloud(const Map& map, int min_observations, const std::filesystem::path& file) {
  write_file_atomically(file, format_ply(map, min_observations));
}

}  // namespace vinebench::slam
