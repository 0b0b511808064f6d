// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace vinebench::harness {

// Parts of the settings of other SLAM systems.

/// With a decimal point, which ORB-SLAM3 requires.
std::string real(double value);

/// Numbers with commas between them.
std::string reals(const std::vector<double>& values);

std::vector<double> row_major(const Eigen::MatrixXd& matrix);

/// A noise density, at least 1e-6: other systems divide by it.
double noise(double density);

}  // namespace vinebench::harness
