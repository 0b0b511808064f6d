// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/world/row_index.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/util/random.h"

namespace vinebench::sim {
namespace {

std::vector<RowConfig> even_and_slanted_rows() {
  return {{{0, 0}, {30, 0}}, {{0, 2}, {30, 2}}, {{-20, 5}, {-12, 13}}};
}

TEST(RowIndexTest, FindsTheDistanceToTheNearestRow) {
  const RowIndex rows(even_and_slanted_rows());
  EXPECT_NEAR(rows.distance({15, 0.7}), 0.7, 1e-12);
  EXPECT_NEAR(rows.distance({15, 1.2}), 0.8, 1e-12);
  EXPECT_NEAR(rows.distance({32, 2}), 2, 1e-12);
  EXPECT_NEAR(rows.distance({-16, 10}), std::sqrt(0.5), 1e-12);  // 1 m above the diagonal
  EXPECT_EQ(rows.distance({15, 40}), RowIndex::kReach);
  EXPECT_EQ(rows.distance({1e6, -1e6}), RowIndex::kReach);
}

/// Against every row, one after the other, wherever squares of the index meet.
TEST(RowIndexTest, AgreesWithASearchOfAllRows) {
  const std::vector<RowConfig> rows = even_and_slanted_rows();
  const RowIndex index(rows);
  RandomSequence random(RandomStream(1, "places"));
  for (int i = 0; i < 3000; ++i) {
    const Eigen::Vector2d p(random.uniform(-26, 36), random.uniform(-6, 19));
    double nearest = RowIndex::kReach;
    for (const RowConfig& row : rows) {
      const Eigen::Vector2d along = row.end - row.start;
      const double t = std::clamp((p - row.start).dot(along) / along.squaredNorm(), 0.0, 1.0);
      nearest = std::min(nearest, (p - row.start - t * along).norm());
    }
    EXPECT_NEAR(index.distance(p), nearest, 1e-12) << p.transpose();
  }
}

TEST(RowIndexTest, WithoutRowsAllIsOutOfReach) {
  EXPECT_EQ(RowIndex({}).distance({0, 0}), RowIndex::kReach);
}

}  // namespace
}  // namespace vinebench::sim
