// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "core/util/percentile.h"
#include "harness/realism/picture_statistics.h"

namespace vinebench::harness {
namespace {

constexpr int kWindow = 16;    // px
constexpr int kLongest = 200;  // px, of a correlation

void add_gradients(const cv::Mat& light, PictureStatistics& statistics) {
  cv::Mat right;
  cv::Mat down;
  cv::Mat gradient;
  cv::Sobel(light, right, CV_32F, 1, 0);
  cv::Sobel(light, down, CV_32F, 0, 1);
  cv::magnitude(right, down, gradient);
  std::vector<double> values(gradient.begin<float>(), gradient.end<float>());
  for (double& value : values) value /= 8;
  const double median = percentile(values, 0.5);
  const double sharpest = percentile(values, 0.99);
  statistics.emplace_back("grad_p50", median);
  statistics.emplace_back("grad_p90", percentile(values, 0.9));
  statistics.emplace_back("grad_p99", sharpest);
  statistics.emplace_back("grad_p99_over_p50", sharpest / std::max(median, 0.1));
}

/// Standard deviations in windows side by side.
void add_windows(const cv::Mat& light, PictureStatistics& statistics) {
  cv::Mat mean;
  cv::Mat mean_of_squares;
  cv::blur(light, mean, {kWindow, kWindow});
  cv::blur(light.mul(light), mean_of_squares, {kWindow, kWindow});
  std::vector<double> deviations;
  for (int y = kWindow / 2; y < light.rows; y += kWindow) {
    for (int x = kWindow / 2; x < light.cols; x += kWindow) {
      const float m = mean.at<float>(y, x);
      deviations.push_back(std::sqrt(std::max(mean_of_squares.at<float>(y, x) - m * m, 0.0F)));
    }
  }
  const auto plain = std::ranges::count_if(deviations, [](double sd) { return sd < 4; });
  statistics.emplace_back("local_sd", percentile(deviations, 0.5));
  statistics.emplace_back("local_sd_p10", percentile(deviations, 0.1));
  statistics.emplace_back("textureless_cells", static_cast<double>(plain) / deviations.size());
}

/// Mean distance to the next edge, px.
void add_edges(const cv::Mat& grey, PictureStatistics& statistics) {
  cv::Mat edges;
  cv::Mat distances;
  cv::Canny(grey, edges, 60, 120);
  cv::distanceTransform(255 - edges, distances, cv::DIST_L2, 3);
  statistics.emplace_back("edge_dist", cv::mean(distances)[0]);
}

/// The shift (px) at which the mean of horizontal and vertical autocorrelation falls below a half;
/// 0 if it never does.
void add_correlation(const cv::Mat& light, PictureStatistics& statistics) {
  const cv::Mat centred = light - cv::mean(light)[0];
  cv::Mat spectrum;
  cv::Mat correlation;
  cv::dft(centred, spectrum, cv::DFT_COMPLEX_OUTPUT);
  cv::mulSpectrums(spectrum, spectrum, spectrum, 0, true);
  cv::dft(spectrum, correlation, cv::DFT_INVERSE | cv::DFT_REAL_OUTPUT);
  const float whole = correlation.at<float>(0, 0);
  int length = 0;
  for (int shift = 1; shift < std::min({kLongest, light.cols, light.rows}); ++shift) {
    const float sum = correlation.at<float>(0, shift) + correlation.at<float>(shift, 0);
    if (sum >= whole) continue;
    length = shift;
    break;
  }
  statistics.emplace_back("corr_len", length);
}

}  // namespace

void add_contrast_statistics(const cv::Mat& grey, PictureStatistics& statistics) {
  cv::Mat light;
  grey.convertTo(light, CV_32F);
  add_gradients(light, statistics);
  add_windows(light, statistics);
  add_edges(grey, statistics);
  add_correlation(light, statistics);
}

}  // namespace vinebench::harness
