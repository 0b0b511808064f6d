// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "python/arrays.h"

#include <cmath>
#include <memory>
#include <utility>

#include "core/util/error.h"

namespace vinebench::python {
namespace {

constexpr double kUnitTolerance = 1e-3;  // of quaternions and rotation matrices

py::dtype dtype_of(const cv::Mat& mat) {
  switch (mat.depth()) {
    case CV_8U:
      return py::dtype::of<std::uint8_t>();
    case CV_32S:
      return py::dtype::of<std::int32_t>();
    case CV_32F:
      return py::dtype::of<float>();
    default:
      fail("an image of OpenCV type {} has no array", mat.type());
  }
}

std::string shape_text(const py::array& array) {
  std::string text;
  for (py::ssize_t i = 0; i < array.ndim(); ++i) {
    text += fmt::format("{}{}", i == 0 ? "" : ", ", array.shape(i));
  }
  return fmt::format("({}{})", text, array.ndim() == 1 ? "," : "");
}

std::string type_name(const py::handle& object) {
  return py::str(py::type::handle_of(object).attr("__name__"));
}

py::array array_of(const py::handle& object, const std::string& what) {
  if (!py::isinstance<py::array>(object)) {
    throw py::type_error(
        fmt::format("{}: expected a NumPy array, found {}", what, type_name(object)));
  }
  return py::reinterpret_borrow<py::array>(object);
}

Stamp stamp_of(double seconds, const std::string& what, Stamp before) {
  const Stamp stamp = from_seconds(seconds);
  if (stamp <= before) {
    throw py::value_error(fmt::format("{}: expected ascending stamps, found {} s after {} s", what,
                                      format_seconds(stamp), format_seconds(before)));
  }
  return stamp;
}

}  // namespace

py::array to_array(const cv::Mat& mat) {
  const auto item = static_cast<py::ssize_t>(mat.elemSize1());
  std::vector<py::ssize_t> shape{mat.rows, mat.cols};
  std::vector<py::ssize_t> strides{static_cast<py::ssize_t>(mat.step[0]), item * mat.channels()};
  if (mat.channels() > 1) {
    shape.push_back(mat.channels());
    strides.push_back(item);
  }
  auto kept = std::make_unique<cv::Mat>(mat);
  const py::capsule owner(kept.get(), [](void* held) { delete static_cast<cv::Mat*>(held); });
  const void* pixels = kept.release()->data;
  return {dtype_of(mat), std::move(shape), std::move(strides), pixels, owner};
}

cv::Mat to_image(const py::handle& object, const std::string& what) {
  if (object.is_none()) return {};
  const py::array array = array_of(object, what);
  if (!py::isinstance<py::array_t<std::uint8_t>>(array)) {
    throw py::type_error(fmt::format("{}: expected dtype uint8, found {}", what,
                                     std::string(py::str(array.dtype()))));
  }
  if (array.ndim() != 2 && (array.ndim() != 3 || array.shape(2) != 3)) {
    throw py::value_error(
        fmt::format("{}: expected shape (h, w) or (h, w, 3), found {}", what, shape_text(array)));
  }
  const auto whole = py::array_t<std::uint8_t, py::array::c_style | py::array::forcecast>(array);
  const int type = array.ndim() == 2 ? CV_8UC1 : CV_8UC3;
  return cv::Mat(static_cast<int>(array.shape(0)), static_cast<int>(array.shape(1)), type,
                 const_cast<std::uint8_t*>(whole.data()))
      .clone();
}

Rows to_rows(const py::handle& object, Eigen::Index columns, const std::string& what) {
  if (object.is_none()) return Rows(0, columns);
  const py::array array = array_of(object, what);
  const char kind = array.dtype().kind();
  if (kind != 'f' && kind != 'i' && kind != 'u') {
    throw py::type_error(fmt::format("{}: expected an array of numbers, found dtype {}", what,
                                     std::string(py::str(array.dtype()))));
  }
  if (array.ndim() != 2 || array.shape(1) != columns) {
    throw py::value_error(
        fmt::format("{}: expected shape (n, {}), found {}", what, columns, shape_text(array)));
  }
  const auto whole = py::array_t<double, py::array::c_style | py::array::forcecast>(array);
  Rows rows = Eigen::Map<const Rows>(whole.data(), array.shape(0), columns);
  if (!rows.allFinite()) throw py::value_error(what + ": expected finite numbers");
  return rows;
}

Rows rows_of(const std::vector<ImuSample>& imu) {
  Rows rows(imu.size(), 7);
  for (std::size_t i = 0; i < imu.size(); ++i) {
    rows.row(static_cast<Eigen::Index>(i)) << to_seconds(imu[i].stamp),
        imu[i].angular_velocity.transpose(), imu[i].specific_force.transpose();
  }
  return rows;
}

std::vector<ImuSample> imu_of(const Rows& rows) {
  std::vector<ImuSample> samples;
  Stamp before = -kMostStamp - 1;
  for (Eigen::Index i = 0; i < rows.rows(); ++i) {
    ImuSample& sample = samples.emplace_back();
    sample.stamp = before = stamp_of(rows(i, 0), "imu", before);
    sample.angular_velocity = rows.row(i).segment<3>(1);
    sample.specific_force = rows.row(i).segment<3>(4);
  }
  return samples;
}

Rows rows_of(const std::vector<WheelSample>& wheels) {
  Rows rows(wheels.size(), 9);
  for (std::size_t i = 0; i < wheels.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    rows(row, 0) = to_seconds(wheels[i].stamp);
    for (Eigen::Index w = 0; w < 4; ++w) {
      rows(row, 1 + w) = wheels[i].angle[static_cast<std::size_t>(w)];
      rows(row, 5 + w) = wheels[i].velocity[static_cast<std::size_t>(w)];
    }
  }
  return rows;
}

std::vector<WheelSample> wheels_of(const Rows& rows) {
  std::vector<WheelSample> samples;
  Stamp before = -kMostStamp - 1;
  for (Eigen::Index i = 0; i < rows.rows(); ++i) {
    WheelSample& sample = samples.emplace_back();
    sample.stamp = before = stamp_of(rows(i, 0), "wheels", before);
    for (Eigen::Index w = 0; w < 4; ++w) {
      sample.angle[static_cast<std::size_t>(w)] = rows(i, 1 + w);
      sample.velocity[static_cast<std::size_t>(w)] = rows(i, 5 + w);
    }
  }
  return samples;
}

Rows rows_of(const Trajectory& trajectory) {
  Rows rows(trajectory.size(), 8);
  for (std::size_t i = 0; i < trajectory.size(); ++i) {
    const Eigen::Quaterniond& q = trajectory[i].pose.rotation;
    rows.row(static_cast<Eigen::Index>(i)) << to_seconds(trajectory[i].stamp),
        trajectory[i].pose.translation.transpose(), q.x(), q.y(), q.z(), q.w();
  }
  return rows;
}

Trajectory trajectory_of(const Rows& rows, const std::string& what) {
  Trajectory trajectory;
  Stamp before = -kMostStamp - 1;
  for (Eigen::Index i = 0; i < rows.rows(); ++i) {
    const Eigen::Quaterniond q(rows(i, 7), rows(i, 4), rows(i, 5), rows(i, 6));
    if (!(std::abs(q.norm() - 1) <= kUnitTolerance)) {
      throw py::value_error(
          fmt::format("{}: row {}: expected a quaternion of unit length, found {}, {}, {}, {}",
                      what, i, q.x(), q.y(), q.z(), q.w()));
    }
    before = stamp_of(rows(i, 0), what, before);
    trajectory.push_back({before, {q.normalized(), rows.row(i).segment<3>(1)}});
  }
  return trajectory;
}

Pose pose_of(const py::handle& matrix, const std::string& what) {
  const Rows rows = to_rows(matrix, 4, what);
  if (rows.rows() != 4) {
    throw py::value_error(
        fmt::format("{}: expected shape (4, 4), found ({}, 4)", what, rows.rows()));
  }
  const Eigen::Matrix3d R = rows.topLeftCorner<3, 3>();
  const double off = (R * R.transpose() - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
  const Eigen::RowVector4d last(0, 0, 0, 1);
  if (!(off <= kUnitTolerance) || R.determinant() < 0 ||
      (rows.row(3) - last).cwiseAbs().maxCoeff() > kUnitTolerance) {
    throw py::value_error(what +
                          ": expected a rigid transform: a rotation matrix, a translation, "
                          "and 0, 0, 0, 1 in the last row");
  }
  return {Eigen::Quaterniond(R).normalized(), rows.topRightCorner<3, 1>()};
}

}  // namespace vinebench::python
