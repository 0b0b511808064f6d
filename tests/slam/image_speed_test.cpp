// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0

// CPU time of the image side on pictures of one's own, grey or colour:
//   VINEBENCH_LEFT=left.png VINEBENCH_RIGHT=right.png VINEBENCH_SIDE=side.png
//   slam_test --gtest_also_run_disabled_tests --gtest_filter='*ImageSpeed*'

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <ctime>
#include <functional>
#include <iostream>
#include <opencv2/imgcodecs.hpp>
#include <vector>

#include "slam/stereo_matcher.h"
#include "slam/tag_detector.h"

namespace vinebench {
namespace {

cv::Mat picture_of(const char* variable) {
  const char* file = std::getenv(variable);
  return file == nullptr ? cv::Mat() : cv::imread(file, cv::IMREAD_GRAYSCALE);
}

/// Median CPU time of 50 calls, ms.
double measure(const std::function<void()>& call) {
  const auto now = [] {
    timespec time{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return 1e3 * static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_nsec);
  };
  std::vector<double> spent(50);
  for (double& one : spent) {
    const double start = now();
    call();
    one = now() - start;
  }
  std::ranges::nth_element(spent, spent.begin() + 25);
  return spent[25];
}

TEST(ImageSpeed, DISABLED_FeaturesAndStereo) {
  const cv::Mat left = picture_of("VINEBENCH_LEFT");
  const cv::Mat right = picture_of("VINEBENCH_RIGHT");
  ASSERT_FALSE(left.empty() || right.empty()) << "expected VINEBENCH_LEFT and VINEBENCH_RIGHT";
  const OrbExtractor extractor({});
  const PinholeCamera lens{left.cols, left.rows, 263.2786, 263.2786, 375.5, 239.5, {}};
  const Extraction extraction = extractor.extract(left);
  const std::vector<cv::Mat> pyramid = extractor.pyramid(right);
  std::cout << extraction.features.size()
            << " features: " << measure([&] { extractor.extract(left); }) << " ms, right pyramid "
            << measure([&] { extractor.pyramid(right); }) << " ms, stereo "
            << measure([&] { match_stereo(extraction, pyramid, lens, 0.12, extractor, {}); })
            << " ms\n";
}

TEST(ImageSpeed, DISABLED_Tags) {
  const cv::Mat side = picture_of("VINEBENCH_SIDE");
  ASSERT_FALSE(side.empty()) << "expected VINEBENCH_SIDE";
  const PinholeCamera lens{side.cols, side.rows, 733, 733, 959.5, 539.5, {}};
  TagDetector detector({}, {});
  std::cout << detector.detect(side, lens, 0).size()
            << " tags: " << measure([&] { detector.detect(side, lens, 0); }) << " ms\n";
}

}  // namespace
}  // namespace vinebench
