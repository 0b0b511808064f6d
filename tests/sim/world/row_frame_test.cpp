// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/world/row_frame.h"

#include <gtest/gtest.h>

namespace vinebench::sim {
namespace {

/// Three rows 2 m apart, northward.
std::vector<RowConfig> three_rows() {
  return {{{0, 0}, {0, 5}}, {{-2, 0}, {-2, 5}}, {{-4, 1}, {-4, 4}}};
}

TEST(RowFrameTest, RunsAlongEvenRowsFromTheFirstOnesStart) {
  const RowFrame frame = row_frame(three_rows());
  EXPECT_TRUE(frame.regular);
  EXPECT_NEAR(frame.spacing, 2, 1e-12);
  EXPECT_NEAR(frame.heading(), std::atan2(1, 0), 1e-12);
  // North is ahead and west to the left.
  EXPECT_LT((frame.from_world({-2, 3}) - Eigen::Vector2d(3, 2)).norm(), 1e-12);
  EXPECT_LT((frame.to_world({3, 2}) - Eigen::Vector2d(-2, 3)).norm(), 1e-12);
  EXPECT_LT((frame.rows.min() - Eigen::Vector2d(0, 0)).norm(), 1e-12);
  EXPECT_LT((frame.rows.max() - Eigen::Vector2d(5, 4)).norm(), 1e-12);
  EXPECT_LT((frame.middle() - Eigen::Vector2d(-2, 2.5)).norm(), 1e-12);
}

TEST(RowFrameTest, RowsMayBeListedInAnyOrderAndDirection) {
  std::vector<RowConfig> rows = three_rows();
  std::swap(rows[0], rows[1]);
  std::swap(rows[2].start, rows[2].end);
  const RowFrame frame = row_frame(rows);
  EXPECT_TRUE(frame.regular);
  EXPECT_NEAR(frame.spacing, 2, 1e-12);
  EXPECT_EQ(frame.origin, Eigen::Vector2d(-2, 0));
}

TEST(RowFrameTest, UnevenRowsHaveTheWorldsAxes) {
  std::vector<RowConfig> uneven = three_rows(), oblique = three_rows(), close = three_rows();
  uneven[2].start.x() = uneven[2].end.x() = -4.5;
  oblique[2] = {{-3.5, 0}, {-4.5, 5}};           // 2 m apart in the middle
  close[1].start.x() = close[1].end.x() = -0.2;  // rows are at least 0.25 m apart
  close[2].start.x() = close[2].end.x() = -0.4;
  for (const auto& rows : {uneven, oblique, close}) {
    const RowFrame frame = row_frame(rows);
    EXPECT_FALSE(frame.regular);
    EXPECT_EQ(frame.along, Eigen::Vector2d::UnitX());
    EXPECT_EQ(frame.rows.min().y(), 0);
    EXPECT_EQ(frame.rows.max().y(), 5);
  }
}

TEST(RowFrameTest, RowsInLineCountAsOne) {
  std::vector<RowConfig> rows = three_rows();
  rows.push_back({{-2, 7}, {-2, 12}});
  const RowFrame frame = row_frame(rows);
  EXPECT_TRUE(frame.regular);
  EXPECT_NEAR(frame.spacing, 2, 1e-12);
  EXPECT_EQ(frame.rows.max().x(), 12);
}

TEST(RowFrameTest, ASingleRowOrNoneIsRegularEnough) {
  const RowFrame single = row_frame({{{1, 1}, {4, 5}}});
  EXPECT_TRUE(single.regular);
  EXPECT_EQ(single.spacing, 2.5);
  EXPECT_LT((single.along - Eigen::Vector2d(0.6, 0.8)).norm(), 1e-12);
  const RowFrame none = row_frame({});
  EXPECT_FALSE(none.regular);
  EXPECT_EQ(none.along, Eigen::Vector2d::UnitX());
  EXPECT_EQ(none.origin, Eigen::Vector2d::Zero());
}

}  // namespace
}  // namespace vinebench::sim
