// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <opencv2/core.hpp>

#include "harness/realism/picture_statistics.h"

namespace vinebench::harness {
namespace {

constexpr int kEdges = 40;
constexpr double kLowest = 0.01;  // cycles per px
constexpr double kHighest = 0.5;

/// Mean power in rings of frequency.
struct Spectrum {
  std::array<double, kEdges - 1> frequency{};  ///< cycles per px
  std::array<double, kEdges - 1> power{};
  std::array<int, kEdges - 1> count{};
};

double edge(int index) {
  return kLowest * std::pow(kHighest / kLowest, static_cast<double>(index) / (kEdges - 1));
}

/// The largest square about the middle, without its mean, under a Hann window.
cv::Mat windowed_square(const cv::Mat& grey) {
  const int n = std::min(grey.rows, grey.cols) / 2 * 2;
  cv::Mat square;
  grey(cv::Rect((grey.cols - n) / 2, (grey.rows - n) / 2, n, n)).convertTo(square, CV_64F);
  square -= cv::mean(square)[0];
  std::vector<double> window(static_cast<std::size_t>(n));
  for (int i = 0; i < n; ++i) {
    window[static_cast<std::size_t>(i)] = 0.5 - 0.5 * std::cos(2 * std::numbers::pi * i / (n - 1));
  }
  const cv::Mat column(window, true);
  return square.mul(column * column.t());
}

Spectrum spectrum_of(const cv::Mat& grey) {
  cv::Mat transformed;
  cv::dft(windowed_square(grey), transformed, cv::DFT_COMPLEX_OUTPUT);
  const int n = transformed.rows;
  Spectrum spectrum;
  for (int y = 0; y < n; ++y) {
    const double fy = static_cast<double>(y < n / 2 ? y : y - n) / n;
    for (int x = 0; x < n; ++x) {
      const double fx = static_cast<double>(x < n / 2 ? x : x - n) / n;
      const double frequency = std::hypot(fx, fy);
      if (frequency < kLowest || frequency >= kHighest) continue;
      const double place = std::log(frequency / kLowest) / std::log(kHighest / kLowest);
      const auto ring =
          std::min<std::size_t>(static_cast<std::size_t>(place * (kEdges - 1)), kEdges - 2);
      spectrum.power[ring] += cv::norm(transformed.at<cv::Vec2d>(y, x), cv::NORM_L2SQR);
      ++spectrum.count[ring];
    }
  }
  for (std::size_t i = 0; i < spectrum.power.size(); ++i) {
    spectrum.power[i] /= std::max(spectrum.count[i], 1);
    spectrum.frequency[i] = std::sqrt(edge(static_cast<int>(i)) * edge(static_cast<int>(i) + 1));
  }
  return spectrum;
}

/// Of the logarithm of power over that of frequency, by least squares; 0 without two rings.
double slope(const Spectrum& spectrum, double low, double high) {
  double n = 0, x_sum = 0, y_sum = 0, xx = 0, xy = 0;
  for (std::size_t i = 0; i < spectrum.power.size(); ++i) {
    const double f = spectrum.frequency[i];
    if (f < low || f > high || spectrum.power[i] <= 0) continue;
    const double x = std::log(f);
    const double y = std::log(spectrum.power[i]);
    n += 1;
    x_sum += x;
    y_sum += y;
    xx += x * x;
    xy += x * y;
  }
  const double determinant = n * xx - x_sum * x_sum;
  return n < 2 ? 0 : (n * xy - x_sum * y_sum) / determinant;
}

double mean_power(const Spectrum& spectrum, double low, double high) {
  double sum = 0;
  int rings = 0;
  for (std::size_t i = 0; i < spectrum.power.size(); ++i) {
    if (spectrum.frequency[i] <= low || spectrum.frequency[i] >= high) continue;
    sum += spectrum.power[i];
    ++rings;
  }
  return sum / std::max(rings, 1);
}

}  // namespace

void add_spectrum_statistics(const cv::Mat& grey, PictureStatistics& statistics) {
  const Spectrum spectrum = spectrum_of(grey);
  statistics.emplace_back("slope", slope(spectrum, 0.015, 0.35));
  statistics.emplace_back("slope_high", slope(spectrum, 0.1, 0.45));
  const double fine = mean_power(spectrum, 0.35, 0.5);
  const double medium = mean_power(spectrum, 0.1, 0.2);
  if (fine > 0 && medium > 0) statistics.emplace_back("hf_db", 10 * std::log10(fine / medium));
}

}  // namespace vinebench::harness
