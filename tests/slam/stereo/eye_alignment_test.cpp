// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/stereo/eye_alignment.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/core.hpp>

#include "tests/support/synthetic_plane.h"

namespace vinebench::slam {
namespace {

using test::SyntheticPlane;

constexpr double kEyeNoise = 1.5;  // grey levels

/// A wall 2 m away: 263 px * 0.12 m / 2 m = 15.8 px.
const SyntheticPlane kFacade{15.8, 0.02, 0.01, 640, 400, 3};
const PinholeCamera kEyeLens{640, 400, 263, 263, 320, 200, {}};

/// A right eye that is off: lower by `shift` px and turned.
struct CrookedEye {
  double shift = 0;
  double turn = 0;  // rad

  /// By how much it has things lower at a pixel of the straight image.
  double lower(double x) const { return shift + turn * (x - 320); }

  cv::Mat see() const {
    // x' = x - turn y and y' = turn x + y + shift about the centre, solved for what it sees at a
    // pixel.
    const double norm = 1 + turn * turn;
    return test::render_image(
        640, 400,
        [&](double x, double y) {
          const double u = x - 320;
          const double v = y - 200 - shift;
          return kFacade.right_grey(320 + (u + turn * v) / norm, 200 + (v - turn * u) / norm);
        },
        kEyeNoise, 2);
  }
};

class EyeAlignmentTest : public testing::Test {
 protected:
  std::vector<StereoMatch> match(const Extraction& left, const Extraction& right) const {
    return match_stereo(left, right, kEyeLens, 0.12, extractor_, {});
  }
  /// One frame, as FrontEnd does it.
  std::vector<StereoMatch> see(const cv::Mat& right_image) {
    const auto search = [this](const Extraction& a, const Extraction& b) { return match(a, b); };
    Extraction right{{}, extractor_.pyramid(alignment_.aligned(right_image))};
    auto matches = match(left_, right);
    if (alignment_.search_shift(left_, right.pyramid, matches, search)) {
      right.pyramid = extractor_.pyramid(alignment_.aligned(right_image));
      matches = match(left_, right);
    }
    alignment_.measure(left_, right.pyramid, matches, extractor_);
    return matches;
  }
  /// px, the largest difference from what the eye is, at the corners of the image.
  double error(const CrookedEye& eye) const {
    double most = 0;
    for (const double x : {0, 640}) {
      for (const double y : {0, 400}) {
        most = std::max(most, std::abs(alignment_.correction(x, y) - eye.lower(x)));
      }
    }
    return most;
  }
  /// px, RMS of the disparities.
  double disparity_error(const std::vector<StereoMatch>& matches) const {
    double squares = 0;
    for (std::size_t i = 0; i < matches.size(); ++i) {
      if (matches[i].x_right < 0) continue;
      const Keypoint& seen = left_.features.keypoints[i];
      const double off =
          static_cast<double>(seen.x - matches[i].x_right) -
          kFacade.disparity(static_cast<double>(seen.x), static_cast<double>(seen.y));
      squares += off * off;
    }
    return std::sqrt(squares / static_cast<double>(count_found(matches)));
  }

  OrbExtractor extractor_{OrbConfig{}};
  Extraction left_ = extractor_.extract(kFacade.left(kEyeNoise));
  EyeAlignment alignment_{kEyeLens, {0.5, 0.5}};
};

TEST_F(EyeAlignmentTest, EyesThatAgreeAreLeftAlone) {
  const cv::Mat right = kFacade.right(kEyeNoise);
  for (int frame = 0; frame < 5; ++frame) EXPECT_GT(count_found(see(right)), 500u);
  EXPECT_EQ(alignment_.aligned(right).data, right.data);
  EXPECT_EQ(alignment_.correction(0, 0), 0);
}

TEST_F(EyeAlignmentTest, LeavesAloneWhatWholeRowsCannotFollow) {
  const cv::Mat right = CrookedEye{0.4, 0}.see();
  for (int frame = 0; frame < 5; ++frame) EXPECT_GT(count_found(see(right)), 500u);
  EXPECT_EQ(alignment_.aligned(right).data, right.data);
}

// A turn about the optical axis alone leaves the middle row where it is: 0.003 rad are 0.96 px at
// the sides, 0.78 px root mean square over the left, middle and right column.
TEST_F(EyeAlignmentTest, LooksBesideTheMiddle) {
  const CrookedEye eye{0, 0.003};
  const cv::Mat right = eye.see();
  for (int frame = 0; frame < 20; ++frame) see(right);
  EXPECT_LT(error(eye), 0.1);  // px
  alignment_ = EyeAlignment(kEyeLens, {0.5, 1});
  for (int frame = 0; frame < 20; ++frame) see(right);
  EXPECT_EQ(alignment_.aligned(right).data, right.data);
}

TEST_F(EyeAlignmentTest, FindsALowerAndTurnedEye) {
  const CrookedEye eye{0.9, 0.0005};  // at a corner 0.9 + 0.16 = 1.06 px
  const cv::Mat right = eye.see();
  const double before = disparity_error(see(right));
  for (int frame = 0; frame < 20; ++frame) see(right);
  EXPECT_LT(error(eye), 0.05);  // px, a tenth of what is left alone
  // Oblique edges were found to the side by about as much as they are lower. Columns stay turned:
  // 0.0005 rad of rows spread evenly over 400 px is 0.058 px RMS.
  EXPECT_LT(disparity_error(see(right)), before / 2);
}

TEST_F(EyeAlignmentTest, SearchesForAShiftThatLeavesNothingToMatch) {
  for (const double shift : {-2.3, 3.6}) {
    alignment_ = EyeAlignment(kEyeLens, {0.5, 0.5});
    const CrookedEye eye{shift, 0};
    const cv::Mat right = eye.see();
    EXPECT_LT(count_found(match(left_, {{}, extractor_.pyramid(right)})), 50u);
    EXPECT_GT(count_found(see(right)), 500u);
    for (int frame = 0; frame < 20; ++frame) see(right);
    EXPECT_LT(error(eye), 0.08);  // px, a sixth of what is left alone
  }
}

TEST_F(EyeAlignmentTest, BelievesNothingOfAnEyeThatSeesSomethingElse) {
  SyntheticPlane other = kFacade;
  other.texture = 4;
  const cv::Mat right = other.right(kEyeNoise);
  for (int frame = 0; frame < 12; ++frame) see(right);
  EXPECT_EQ(alignment_.aligned(right).data, right.data);
}

TEST_F(EyeAlignmentTest, KeepsWhatItKnowsBehindACover) {
  const CrookedEye eye{1.2, 0};
  const cv::Mat right = eye.see();
  for (int frame = 0; frame < 5; ++frame) see(right);
  const double known = alignment_.correction(320, 200);
  for (int frame = 0; frame < 12; ++frame) see(cv::Mat(right.size(), CV_8UC1, cv::Scalar(90)));
  EXPECT_EQ(alignment_.correction(320, 200), known);
}

}  // namespace
}  // namespace vinebench::slam
