// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/explain/repeated_run.h"

#include <gmock/gmock.h>

#include "tests/support/test_folder.h"

namespace vinebench::harness {
namespace {

Step step(std::int64_t index, double x, bool tracked = true) {
  Step step{.index = index, .stamp = stamp_of_frame(index, 10), .T_world_body = {}};
  step.T_map_body = Pose{Eigen::Quaterniond::Identity(), {x, 0, 0}};
  step.tracked = tracked;
  return step;
}

class KnownPosesTest : public testing::Test {
 protected:
  static KnownPoses known(const std::string& differences = "") {
    const Trajectory poses{{step(0, 0).stamp, *step(0, 0).T_map_body},
                           {step(2, 0.5).stamp, *step(2, 0.5).T_map_body}};
    return KnownPoses("# comment\n" + format_tum(poses), differences);
  }
};

TEST_F(KnownPosesTest, TheSamePosesAndGapsPass) {
  const KnownPoses poses = known();
  poses.check(step(0, 0));
  poses.check(step(1, 0.25, false));  // dead reckoning is in no file
  poses.check(step(2, 0.5));
}

// The file has 1e-9 m.
TEST_F(KnownPosesTest, AnotherPoseIsAnError) {
  EXPECT_THAT(test::error_of([&] { known().check(step(2, 0.500000001)); }),
              testing::HasSubstr("0.200000000 s (frame 2) is another one"));
  EXPECT_NE(test::error_of([&] { known().check(step(1, 0.25)); }), "");
  EXPECT_NE(test::error_of([&] { known().check(step(2, 0.5, false)); }), "");
}

TEST_F(KnownPosesTest, SaysWhatComputesDifferently) {
  EXPECT_THAT(test::error_of([&] { known("libm, blas").check(step(2, 0.6)); }),
              testing::HasSubstr("What computes is different: libm, blas"));
}

}  // namespace
}  // namespace vinebench::harness
