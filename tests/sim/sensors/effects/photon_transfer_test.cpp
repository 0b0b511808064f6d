// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/sensors/effects/photon_transfer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/core.hpp>
#include <vector>

#include "sim/render/image_encoding.h"
#include "tests/support/effect_camera.h"

namespace vinebench::sim {
namespace {

struct Moments {
  double mean = 0;
  double variance = 0;
};

Moments moments(const cv::Mat& image) {
  cv::Scalar mean, deviation;
  cv::meanStdDev(image, mean, deviation);
  return {mean[0], deviation[0] * deviation[0]};
}

Moments noisy_moments(const PhotonTransfer& sensor, int level) {
  cv::Mat image(500, 600, CV_8UC1, cv::Scalar(level));
  sensor.apply(image, RandomStream(3, "test", static_cast<std::uint64_t>(level)));
  return moments(image);
}

/// Slope and intercept of the least-squares line.
std::pair<double, double> fit_line(const std::vector<Moments>& points) {
  double x = 0, y = 0, xx = 0, xy = 0;
  for (const Moments& p : points) {
    x += p.mean;
    y += p.variance;
    xx += p.mean * p.mean;
    xy += p.mean * p.variance;
  }
  const auto n = static_cast<double>(points.size());
  const double slope = (n * xy - x * y) / (n * xx - x * x);
  return {slope, (y - slope * x) / n};
}

/// The photon-transfer curve of a linear sensor: in codes, variance = k mean + (k read_noise)^2 +
/// 1/12, where k = 255 / full_well * gain is the codes an electron makes and 1/12 the rounding's.
void expect_curve(double full_well, double read_noise, double gain_db) {
  PhotonTransfer sensor({true, full_well, read_noise}, 1.0);
  sensor.set_gain(gain_db);
  std::vector<Moments> points;
  for (int level = 80; level <= 200; level += 10) points.push_back(noisy_moments(sensor, level));
  const auto [slope, intercept] = fit_line(points);
  const double k = 255 / full_well * std::pow(10.0, gain_db / 20);
  // 300000 draws a level give each variance to 0.26 %. Over 13 levels from 20 to 150 codes that
  // leaves 0.3 % of the slope; the draws' classes another 0.2 %.
  EXPECT_NEAR(slope, k, 0.01 * k);
  // The same share of the variance that the slope makes over the 60 codes to zero, and of its own.
  const double expected = k * k * read_noise * read_noise + 1 / 12.0;
  EXPECT_NEAR(intercept, expected, 0.01 * (60 * k + expected));
}

TEST(PhotonTransferTest, CurveFitsItsParameters) {
  expect_curve(3000, 5, 0);
  expect_curve(3000, 40, 0);
  expect_curve(6900, 2.5, 0);
}

TEST(PhotonTransferTest, GainMovesTheCurve) {
  expect_curve(12000, 20, 6);
  expect_curve(12000, 20, 12);
}

TEST(PhotonTransferTest, MeanKeepsTheLight) {
  const PhotonTransfer sensor({true, 3000, 10}, 1.0);
  for (const int level : {90, 128, 200}) {
    // Standard error of the mean of 300000 pixels of 3.3 codes: 0.006; of the rounding: none.
    EXPECT_NEAR(noisy_moments(sensor, level).mean, 255 * light_of_code(level), 0.03) << level;
  }
}

TEST(PhotonTransferTest, DefaultIsAboutOneAndAHalfGreyLevelsAtMidGrey) {
  const PhotonTransfer sensor({}, kImageGamma);
  EXPECT_NEAR(std::sqrt(noisy_moments(sensor, 128).variance), 1.5, 0.1);
}

TEST(PhotonTransferTest, WhiteSaturates) {
  const PhotonTransfer sensor({true, 1000, 10}, kImageGamma);
  cv::Mat image(300, 300, CV_8UC3, cv::Scalar::all(255));
  sensor.apply(image, RandomStream(1, "test"));
  // Half of the draws are above white and clipped to it.
  EXPECT_NEAR(cv::countNonZero(image.reshape(1) == 255) / (3 * 300.0 * 300.0), 0.5, 0.1);
}

TEST(PhotonTransferTest, OffLeavesEveryCode) {
  const PhotonTransfer off({false, 1000, 10}, kImageGamma);
  EXPECT_TRUE(off.is_identity());
  EXPECT_FALSE(PhotonTransfer({}, kImageGamma).is_identity());
  cv::Mat image(1, 256, CV_8UC1);
  for (int i = 0; i < 256; ++i) image.at<std::uint8_t>(i) = static_cast<std::uint8_t>(i);
  const cv::Mat before = image.clone();
  off.apply(image, RandomStream(1, "test"));
  EXPECT_EQ(cv::countNonZero(image != before), 0);
}

TEST(PhotonTransferTest, LinearResponseWithoutNoise) {
  const PhotonTransfer linear({false, 1000, 0}, 1.0);
  EXPECT_FALSE(linear.is_identity());
  cv::Mat image(1, 1, CV_8UC1, cv::Scalar(128));
  linear.apply(image, RandomStream(1, "test"));
  EXPECT_EQ(image.at<std::uint8_t>(0), 56);  // 255 (128 / 255)^2.2 = 55.98
}

TEST(PhotonTransferTest, ADrawDependsOnItsPlaceAlone) {
  const PhotonTransfer sensor({}, kImageGamma);
  cv::Mat one(40, 61, CV_8UC3, cv::Scalar::all(100));  // 183 values a row: no multiple of 8
  cv::Mat other = one.clone();
  other.at<cv::Vec3b>(7, 9) = {1, 2, 3};
  sensor.apply(one, RandomStream(5, "test", 2));
  sensor.apply(other, RandomStream(5, "test", 2));
  cv::Mat different = cv::Mat(one != other).reshape(1);
  EXPECT_GE(cv::countNonZero(different), 1);
  different.row(7).colRange(27, 30) = 0;
  EXPECT_EQ(cv::countNonZero(different), 0);
  cv::Mat next(40, 61, CV_8UC3, cv::Scalar::all(100));
  sensor.apply(next, RandomStream(5, "test", 3));
  EXPECT_GT(cv::countNonZero(cv::Mat(one != next).reshape(1)), 1000);
}

// 100 pixels of mid grey with 1.5 grey levels of noise: two equal draws are next to impossible.
TEST(PhotonTransferTest, AnotherPatternIsAnotherNoise) {
  const test::EffectCamera camera;
  const auto noisy = [&](const PhotonTransferConfig& config) {
    cv::Mat codes(10, 10, CV_8UC3, cv::Scalar::all(127));
    make_photon_transfer(config, kImageGamma, camera.inputs())->apply(codes, {});
    return codes;
  };
  const auto differ = [](const cv::Mat& a, const cv::Mat& b) {
    return cv::countNonZero(cv::Mat(a != b).reshape(1)) > 0;
  };
  PhotonTransferConfig other;
  other.pattern = 1;
  EXPECT_FALSE(differ(noisy({}), noisy({})));
  EXPECT_TRUE(differ(noisy({}), noisy(other)));
  EXPECT_FALSE(differ(noisy(other), noisy(other)));
}

TEST(LightTest, ThereAndBackGivesTheSameCodes) {
  cv::Mat codes(1, 256, CV_8UC3);
  for (int i = 0; i < 256; ++i) codes.at<cv::Vec3b>(i) = cv::Vec3b::all(static_cast<uchar>(i));
  EXPECT_EQ(cv::countNonZero(cv::Mat(to_codes(to_light(codes)) != codes).reshape(1)), 0);
}

TEST(LightTest, AMeanOfLightIsNotTheMeanOfCodes) {
  cv::Mat sum;
  add_light(cv::Mat(1, 1, CV_8UC3, cv::Scalar::all(0)), 0.5f, sum);
  add_light(cv::Mat(1, 1, CV_8UC3, cv::Scalar::all(255)), 0.5f, sum);
  EXPECT_EQ(to_codes(sum).at<cv::Vec3b>(0)[0], 186);  // 255 * 0.5^(1 / 2.2) = 186.1
}

}  // namespace
}  // namespace vinebench::sim
