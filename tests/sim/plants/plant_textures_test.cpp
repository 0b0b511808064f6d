// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/plants/plant_textures.h"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "tests/support/test_plant.h"

namespace vinebench::sim {
namespace {

TEST(PlantTexturesTest, ASeedIsOneSetOfImages) {
  const std::vector<Texture> again = plant_textures({}, growth_stage(89), 1);
  const std::vector<Texture> other = plant_textures({}, growth_stage(89), 2);
  for (std::size_t i = 0; i < again.size(); ++i) {
    EXPECT_EQ(cv::norm(test::textures()[i].rgba, again[i].rgba, cv::NORM_INF), 0) << again[i].name;
    EXPECT_GT(cv::norm(test::textures()[i].rgba, other[i].rgba, cv::NORM_INF), 0) << again[i].name;
  }
}

TEST(PlantTexturesTest, LeavesAreGreenInsideTheirOutline) {
  const Texture& leaves = test::textures().at(2);
  ASSERT_EQ(leaves.name, "leaf");
  const TextureCell cell = leaf_cell(0, 0);
  const Eigen::Vector2f middle = cell.at(0.5f, 0.5f), corner = cell.at(0.02f, 0.02f);
  const auto texel = [&](const Eigen::Vector2f& uv) {
    return leaves.rgba.at<cv::Vec4b>(static_cast<int>(uv.y() * leaves.rgba.rows),
                                     static_cast<int>(uv.x() * leaves.rgba.cols));
  };
  EXPECT_EQ(texel(middle)[3], 255);
  EXPECT_GT(texel(middle)[1], texel(middle)[0]);
  EXPECT_GT(texel(middle)[1], texel(middle)[2]);
  EXPECT_EQ(texel(corner)[3], 0);
}

}  // namespace
}  // namespace vinebench::sim
