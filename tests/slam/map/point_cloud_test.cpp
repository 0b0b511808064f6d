// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/map/point_cloud.h"

#include <gtest/gtest.h>

#include <cstring>

#include "tests/support/aisle_map.h"

namespace vinebench::slam {
namespace {

using test::AisleMap;
using test::SyntheticAisle;

constexpr std::size_t kVertex = 6 * 4 + 3;  // six floats, three colours

TEST(PointCloudTest, AnEmptyMapIsAHeader) {
  EXPECT_EQ(format_ply(Map(1.2), 1),
            "ply\n"
            "format binary_little_endian 1.0\n"
            "comment landmarks of a Vinebench map, metres\n"
            "element vertex 0\n"
            "property float x\nproperty float y\nproperty float z\n"
            "property float nx\nproperty float ny\nproperty float nz\n"
            "property uchar red\nproperty uchar green\nproperty uchar blue\n"
            "end_header\n");
}

TEST(PointCloudTest, EachLandmarkIsAVertex) {
  const SyntheticAisle aisle(0, 1, 150);
  AisleMap made(aisle, {Pose{}, Pose{{1, 0, 0, 0}, {0.05, 0, 0}}});
  const Landmark first = made.map.landmark(0);
  const Observation seen = first.observations.front();
  auto& patches = made.map.keyframe(seen.keyframe).patches;
  for (const auto& view : made.map.keyframe(seen.keyframe).landmarks) {
    patches.emplace_back(view.size());
  }
  Patch light;
  light.grey.fill(200);
  patches[static_cast<std::size_t>(seen.view)].add(static_cast<std::size_t>(seen.feature), light);

  const std::string ply = format_ply(made.map, 1);
  const std::size_t begin = ply.find("end_header\n") + 11;
  ASSERT_EQ(ply.size() - begin, made.map.landmarks().size() * kVertex);
  float numbers[6];  // the machines of the tests are little endian
  std::memcpy(numbers, ply.data() + begin, sizeof numbers);
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(numbers[i], static_cast<float>(first.position[i]));
    EXPECT_EQ(numbers[3 + i], static_cast<float>(-first.normal[i]));
  }
  EXPECT_EQ(static_cast<unsigned char>(ply[begin + 24]), 200);
  EXPECT_EQ(static_cast<unsigned char>(ply[begin + kVertex + 26]), 128);  // without a patch
}

TEST(PointCloudTest, LandmarksThatFewSawStayOut) {
  const SyntheticAisle aisle(0, 1, 150);
  AisleMap made(aisle, {Pose{}, Pose{{1, 0, 0, 0}, {0.05, 0, 0}}});
  const std::size_t twice = made.map.count_landmarks(2);
  ASSERT_LT(twice, made.map.landmarks().size());
  const std::string ply = format_ply(made.map, 2);
  EXPECT_NE(ply.find("element vertex " + std::to_string(twice) + "\n"), std::string::npos);
}

}  // namespace
}  // namespace vinebench::slam
