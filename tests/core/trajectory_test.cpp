// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "core/trajectory.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "core/util/error.h"
#include "core/util/random.h"
#include "tests/support/test_folder.h"

namespace vinebench {
namespace {

void expect_error(const std::string& text, const std::string& message) {
  const test::TestFolder folder;
  EXPECT_THAT(test::error_of([&] { read_tum(folder.write("trajectory_test.tum", text)); }),
              testing::HasSubstr(message))
      << text;
}

TEST(TrajectoryTest, ComesBackToTheLastDecimal) {
  RandomSequence random(RandomStream(1, "trajectory"));
  Trajectory written;
  for (std::int64_t i = 0; i < 50; ++i) {
    const Eigen::Vector3d turn{random.normal(), random.normal(), random.normal()};
    const Eigen::Vector3d p(random.uniform(-100, 100), random.uniform(-100, 100), random.normal());
    written.push_back({stamp_of_frame(i, 15), {exp_so3(turn), p}});
  }
  const test::TestFolder folder;
  const auto file = folder / "trajectory_test.tum";
  write_tum(written, file);
  const Trajectory read = read_tum(file);
  ASSERT_EQ(read.size(), written.size());
  for (std::size_t i = 0; i < read.size(); ++i) {
    EXPECT_EQ(read[i].stamp, written[i].stamp);
    // Half of the ninth decimal in each of three and four numbers.
    EXPECT_LT((read[i].pose.translation - written[i].pose.translation).norm(), 1e-9);
    EXPECT_LT(angle_of(read[i].pose.rotation.conjugate() * written[i].pose.rotation), 4e-9);
    EXPECT_NEAR(read[i].pose.rotation.norm(), 1, 1e-15);
  }
}

TEST(TrajectoryTest, WritesTheScalarLast) {
  const Pose quarter_turn{Eigen::Quaterniond(0.6, 0, 0, 0.8), {1, 2, 3}};
  EXPECT_EQ(format_tum({{66'666'667, quarter_turn}}),
            "0.066666667 1.000000000 2.000000000 3.000000000 0.000000000 0.000000000 0.800000000 "
            "0.600000000\n");
}

TEST(TrajectoryTest, SkipsCommentsAndEmptyLines) {
  const test::TestFolder folder;
  const Trajectory read =
      read_tum(folder.write("a.tum", "# t x y z\n\n0.5 1 2 3 0 0 0 1\r\n  # more\n"));
  ASSERT_EQ(read.size(), 1u);
  EXPECT_EQ(read[0].stamp, 500'000'000);
  EXPECT_EQ(read[0].pose.translation, Eigen::Vector3d(1, 2, 3));
  EXPECT_TRUE(read_tum(folder.write("none.tum", "")).empty());
}

TEST(TrajectoryTest, ErrorsNameFileLineAndWhatWasFound) {
  const std::string good = "# header\n0 1 2 3 0 0 0 1\n";
  expect_error(good + "1 1 2 3 0 0 0\n",
               "trajectory_test.tum:3: expected 8 columns (t x y z qx qy qz qw), found 7");
  expect_error(good + "1 1 2 3 0 0 0 1 9\n", "trajectory_test.tum:3: expected 8 columns");
  expect_error(good + "1 1 two 3 0 0 0 1\n",
               "trajectory_test.tum:3: expected a number, found 'two'");
  expect_error(good + "1 nan 2 3 0 0 0 1\n", "trajectory_test.tum:3: expected a number");
  expect_error("x 1 2 3 0 0 0 1\n", "trajectory_test.tum:1: expected a time in seconds, found 'x'");
  expect_error("0 1 2 3 0 0 0 0\n", "trajectory_test.tum:1: expected a unit quaternion");
  expect_error("0 1 2 3 0 0 0 2\n", "trajectory_test.tum:1: expected a unit quaternion");
}

TEST(TrajectoryTest, StampsMustAscend) {
  const std::string line = " 1 2 3 0 0 0 1\n";
  expect_error("2" + line + "1" + line,
               "trajectory_test.tum:2: expected ascending stamps, found 1.000000000 after "
               "2.000000000");
  expect_error("2" + line + "2" + line, "trajectory_test.tum:2: expected ascending stamps");
}

TEST(TrajectoryTest, MissingFileIsNamed) {
  EXPECT_THAT([] { read_tum("/nowhere/x.tum"); },
              testing::ThrowsMessage<Error>(testing::HasSubstr("/nowhere/x.tum")));
}

}  // namespace
}  // namespace vinebench
