// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/page/landmark_cloud.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "slam/map/point_cloud.h"
#include "tests/support/test_folder.h"

namespace vinebench::harness {
namespace {

/// As point_cloud.cpp writes it.
std::string cloud(const std::vector<std::array<float, 6>>& points, std::uint8_t grey) {
  std::string text =
      "ply\nformat binary_little_endian 1.0\ncomment landmarks of a Vinebench map, metres\n"
      "element vertex " +
      std::to_string(points.size()) +
      "\nproperty float x\nproperty float y\nproperty float z\nproperty float nx\n"
      "property float ny\nproperty float nz\nproperty uchar red\nproperty uchar green\n"
      "property uchar blue\nend_header\n";
  for (const auto& point : points) {
    text.append(reinterpret_cast<const char*>(point.data()), sizeof(point));
    text.append(3, static_cast<char>(grey));
  }
  return text;
}

TEST(LandmarkCloudTest, PointsAreInTheWorldInCentimetres) {
  const test::TestFolder folder;
  const auto file = folder.write("landmarks.ply", cloud({{1, 2, 3, 0, 0, 1}}, 200));
  const Pose T_world_map{Eigen::Quaterniond::Identity(), {10, 0, -1}};
  EXPECT_EQ(landmarks_json(file, T_world_map), (nlohmann::ordered_json{1100, 200, 200, 200}));
}

TEST(LandmarkCloudTest, ManyPointsAreThinnedOut) {
  const test::TestFolder folder;
  const auto file =
      folder.write("landmarks.ply", cloud(std::vector(40'001, std::array<float, 6>{}), 0));
  // More than twice 20,000: every third.
  EXPECT_EQ(landmarks_json(file, Pose()).size() / 4, 13'334u);
}

TEST(LandmarkCloudTest, ReadsWhatTheSlamCoreWrites) {
  const test::TestFolder folder;
  slam::save_point_cloud(slam::Map(1.2), 2, folder / "landmarks.ply");
  EXPECT_TRUE(landmarks_json(folder / "landmarks.ply", Pose()).empty());
}

TEST(LandmarkCloudTest, DamagedFilesAreErrors) {
  const test::TestFolder folder;
  const std::string whole = cloud({{1, 2, 3, 0, 0, 1}}, 200);
  for (const std::string& text :
       {std::string(), std::string("ply\n"), whole.substr(0, whole.size() - 1), whole + "x"}) {
    const auto file = folder.write("landmarks.ply", text);
    EXPECT_THAT(test::error_of([&] { landmarks_json(file, Pose()); }),
                testing::HasSubstr("landmarks.ply"))
        << text.size();
  }
}

}  // namespace
}  // namespace vinebench::harness
