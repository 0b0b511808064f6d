// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/patches/patch.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>

#include "tests/support/synthetic_texture.h"

namespace vinebench::slam {
namespace {

using test::render_image;
using test::SyntheticTexture;

constexpr int kWidth = 160;
constexpr int kHeight = 120;
constexpr double kNoise = 1.5;  // grey levels

Eigen::Matrix3d scaling(double s) {
  return Eigen::Vector3d(s, s, 1).asDiagonal();
}

cv::Mat texture_image() {
  return render_image(kWidth, kHeight, SyntheticTexture(3), kNoise, 1);
}

/// The texture as a homography (its own pixels to the image's) shows it.
cv::Mat warped_image(const Eigen::Matrix3d& H) {
  const Eigen::Matrix3d back = H.inverse();
  const SyntheticTexture texture(3);
  const auto grey = [&](double x, double y) {
    const Eigen::Vector2d p = (back * Eigen::Vector3d(x, y, 1)).hnormalized();
    return texture(p.x(), p.y());
  };
  return render_image(kWidth, kHeight, grey, kNoise, 2);
}

/// RMS distance (px) of the fits from the patches' positions by the homography, each started a
/// pixel off; `found` counts them.
double fit_error(const Eigen::Matrix3d& H, bool plain, int& found) {
  const cv::Mat then = texture_image();
  const cv::Mat now = warped_image(H);
  double sum = 0;
  found = 0;
  for (int y = 20; y <= 100; y += 10) {
    for (int x = 20; x <= 140; x += 10) {
      const auto patch = cut_patch(then, x, y);
      const Eigen::Vector2d truth = (H * Eigen::Vector3d(x, y, 1)).hnormalized();
      Eigen::Matrix3d at = Eigen::Matrix3d::Identity();
      at.topRightCorner<2, 1>() = Eigen::Vector2d(x, y);
      const auto window =
          warp_patch(*patch, plain ? Eigen::Matrix3d::Identity() : Eigen::Matrix3d(H * at));
      if (!window) continue;
      const auto fit = fit_patch(*window, now, truth.x() + 0.7, truth.y() - 0.7);
      if (!fit) continue;
      ++found;
      sum += (Eigen::Vector2d(fit->x, fit->y) - truth).squaredNorm();
    }
  }
  return std::sqrt(sum / std::max(found, 1));
}

TEST(PatchTest, IsFoundToAFractionOfAPixel) {
  Eigen::Matrix3d shift = Eigen::Matrix3d::Identity();
  shift(0, 2) = 3.3;
  shift(1, 2) = -2.6;
  int found = 0;
  // Noise of 1.5 grey levels over 81 pixels whose gradients are some 10 levels a pixel: 1.5 *
  // sqrt(2) / (10 * 9) = 0.02 px; bilinear interpolation adds some hundredths.
  EXPECT_LT(fit_error(shift, false, found), 0.08);
  EXPECT_GT(found, 80);  // of 117
}

TEST(PatchTest, FollowsAWarpThatAPlainShiftCannot) {
  // A surface that tilts: 20 % larger, and larger still towards the bottom.
  Eigen::Matrix3d H = scaling(1.2);
  H(2, 1) = -0.002;
  H(0, 2) = -20;
  H(1, 2) = -15;
  int found = 0;
  const double warped = fit_error(H, false, found);
  EXPECT_LT(warped, 0.1);
  // Of 117: magnified by up to a half, gradients are as much weaker, and some too weak.
  EXPECT_GT(found, 40);
  EXPECT_GT(fit_error(H, true, found), 2 * warped);
}

/// The unwarped patch around (x, y).
std::optional<PatchWindow> plain_window(const cv::Mat& image, double x, double y) {
  return warp_patch(*cut_patch(image, x, y), Eigen::Matrix3d::Identity());
}

TEST(PatchTest, RefusesWhatCannotBePlaced) {
  const cv::Mat image = texture_image();
  EXPECT_FALSE(cut_patch(image, 3, 60));
  EXPECT_FALSE(cut_patch(image, 80, 118));
  EXPECT_FALSE(fit_patch(*plain_window(image, 80, 60), image, 2, 60));

  // A flat surface, and an edge along which a patch slides.
  const cv::Mat flat(kHeight, kWidth, CV_8UC1, cv::Scalar(90));
  EXPECT_FALSE(fit_patch(*plain_window(flat, 80, 60), flat, 80, 60));
  cv::Mat edge = flat.clone();
  edge.colRange(80, kWidth).setTo(160);
  EXPECT_FALSE(fit_patch(*plain_window(edge, 80, 60), edge, 80, 60));
}

TEST(PatchTest, ShowsNoMoreThanWasCut) {
  const auto patch = cut_patch(texture_image(), 80, 60);
  // The window and its border reach 5 px, the patch 8: seen from 8 / 5 as far away it still fills
  // the window, from twice as far it does not.
  EXPECT_TRUE(warp_patch(*patch, scaling(1 / 1.5)));
  EXPECT_FALSE(warp_patch(*patch, scaling(1 / 2.0)));
}

TEST(PatchTest, TellsAnotherSurfaceByItsDifference) {
  const cv::Mat image = texture_image();
  const cv::Mat other = render_image(kWidth, kHeight, SyntheticTexture(4), kNoise, 2);
  const auto window = plain_window(image, 80, 60);
  const auto itself = fit_patch(*window, image, 80.5, 60.5);
  ASSERT_TRUE(itself);
  EXPECT_LT(itself->difference, 0.1 * itself->contrast);
  if (const auto wrong = fit_patch(*window, other, 80, 60)) {
    EXPECT_GT(wrong->difference, 0.35 * wrong->contrast);
  }
}

TEST(PatchTest, BrightnessDoesNotMatter) {
  const cv::Mat image = texture_image();
  const cv::Mat brighter = image + 25;
  const auto fit = fit_patch(*plain_window(image, 80, 60), brighter, 81, 60);
  ASSERT_TRUE(fit);
  EXPECT_NEAR(fit->x, 80, 0.05);  // px; a few pixels saturate
  EXPECT_NEAR(fit->y, 60, 0.05);
}

}  // namespace
}  // namespace vinebench::slam
