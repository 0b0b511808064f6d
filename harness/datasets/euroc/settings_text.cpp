// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/datasets/euroc/settings_text.h"

#include <fmt/ranges.h>

#include <algorithm>

namespace vinebench::harness {

std::string real(double value) {
  std::string text = fmt::format("{}", value);
  if (text.find_first_of(".en") == std::string::npos) text += ".0";
  if (const std::size_t e = text.find('e'); e != std::string::npos) {
    if (text.find('.') == std::string::npos) text.insert(e, ".0");
  }
  return text;
}

std::vector<double> row_major(const Eigen::MatrixXd& matrix) {
  std::vector<double> values;
  for (Eigen::Index row = 0; row < matrix.rows(); ++row) {
    for (Eigen::Index column = 0; column < matrix.cols(); ++column) {
      values.push_back(matrix(row, column));
    }
  }
  return values;
}

std::string reals(const std::vector<double>& values) {
  std::vector<std::string> texts;
  for (const double value : values) texts.push_back(real(value));
  return fmt::format("{}", fmt::join(texts, ", "));
}

double noise(double density) {
  constexpr double kLeast = 1e-6;
  return std::max(density, kLeast);
}

}  // namespace vinebench::harness
