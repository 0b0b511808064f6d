// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <pybind11/eigen.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

#include "core/frame.h"
#include "core/trajectory.h"

namespace vinebench::python {

namespace py = pybind11;

using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// (h, w) or (h, w, channels), without a copy: the array keeps the image's memory alive.
py::array to_array(const cv::Mat& mat);

/// A copy of an image of uint8, (h, w) or (h, w, 3); empty for None. Throws TypeError or ValueError
/// that names `what`.
cv::Mat to_image(const py::handle& array, const std::string& what);

/// float64 rows of so many columns; none for None. Throws TypeError or ValueError that names
/// `what`, also for numbers that are not finite.
Rows to_rows(const py::handle& array, Eigen::Index columns, const std::string& what);

/// (n, 7): s, rad/s x y z, m/s^2 x y z.
Rows rows_of(const std::vector<ImuSample>& imu);
std::vector<ImuSample> imu_of(const Rows& rows);

/// (n, 9): s, rad of the four wheels, rad/s of them.
Rows rows_of(const std::vector<WheelSample>& wheels);
std::vector<WheelSample> wheels_of(const Rows& rows);

/// (n, 8), as a TUM file: s, m x y z, quaternion x y z w.
Rows rows_of(const Trajectory& trajectory);
/// Throws ValueError that names `what` for stamps that do not ascend and quaternions that are not
/// of unit length.
Trajectory trajectory_of(const Rows& rows, const std::string& what);

/// Of a 4 x 4 matrix. Throws ValueError that names `what` unless it is a rigid transform.
Pose pose_of(const py::handle& matrix, const std::string& what);

}  // namespace vinebench::python
