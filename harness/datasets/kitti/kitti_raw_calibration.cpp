// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/datasets/kitti/kitti_raw_calibration.h"

#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include "core/files/input_file.h"
#include "core/util/error.h"
#include "harness/datasets/files/text_table.h"
#include "harness/datasets/kitti/kitti_projection.h"

namespace vinebench::harness {
namespace {

namespace fs = std::filesystem;

constexpr double kFileTolerance = 1e-3;  // of an entry of R R^T; the files have seven digits
constexpr std::size_t kDistortion = 5;   // k1, k2, p1, p2, k3

/// A calibration file: lines of a name, a colon and numbers.
class NamedNumbers {
 public:
  explicit NamedNumbers(const fs::path& file) : file_(file) {
    for (TableRow& row : read_rows(file)) {
      std::string name = row.fields.front();
      if (!name.ends_with(':')) continue;
      name.pop_back();
      lines_.insert_or_assign(std::move(name), std::move(row));
    }
  }

  /// Row by row. Throws Error for a line that is absent or has another count.
  Eigen::MatrixXd matrix(const std::string& name, Eigen::Index rows, Eigen::Index columns) const {
    const TableRow& row = line(name);
    const auto count = static_cast<std::size_t>(rows * columns);
    if (row.fields.size() != count + 1) {
      row.fault(
          fmt::format("{}: expected {} numbers, found {}", name, count, row.fields.size() - 1));
    }
    Eigen::MatrixXd values(rows, columns);
    for (Eigen::Index i = 0; i < rows * columns; ++i) {
      values(i / columns, i % columns) = row.number(static_cast<std::size_t>(i) + 1);
    }
    return values;
  }

  Eigen::Matrix3d rotation(const std::string& name) const {
    const Eigen::Matrix3d R = matrix(name, 3, 3);
    if (!is_rotation(R, kFileTolerance)) {
      fault(name, "expected a rotation matrix");
    }
    return R;
  }

  cv::Size size(const std::string& name) const {
    const Eigen::Vector2d size = matrix(name, 1, 2).transpose();
    if (!(size.minCoeff() >= kSmallestImageSide && size.maxCoeff() <= kLargestImageSide)) {
      fault(name,
            fmt::format("expected {} to {} pixels a side", kSmallestImageSide, kLargestImageSide));
    }
    return {static_cast<int>(size.x()), static_cast<int>(size.y())};
  }

  [[noreturn]] void fault(const std::string& name, const std::string& message) const {
    line(name).fault(fmt::format("{}: {}", name, message));
  }

  const TableRow& line(const std::string& name) const {
    const auto found = lines_.find(name);
    if (found == lines_.end()) fail("{}: expected a line {}:", file_.string(), name);
    return found->second;
  }

 private:
  fs::path file_;
  std::map<std::string, TableRow> lines_;
};

/// T_to_from of a file of R and T.
Pose read_mount(const fs::path& file) {
  const NamedNumbers numbers(file);
  const Eigen::Vector3d t = numbers.matrix("T", 3, 1);
  return {Eigen::Quaterniond(numbers.rotation("R")).normalized(), t};
}

std::string name_of(const char* quantity, int camera) {
  return fmt::format("{}_{:02}", quantity, camera);
}

/// As it is: with its lens, where it is on camera 0.
RigCamera unrectified_camera(const NamedNumbers& file, int number) {
  RigCamera camera;
  const std::string name = name_of("K", number);
  const Eigen::Matrix3d K = file.matrix(name, 3, 3);
  if (!(K(0, 0) > 0 && K(1, 1) > 0)) file.fault(name, "expected focal lengths above 0");
  camera.model = {.fx = K(0, 0), .fy = K(1, 1), .cx = K(0, 2), .cy = K(1, 2)};
  const Eigen::VectorXd D = file.matrix(name_of("D", number), kDistortion, 1);
  camera.model.set_lens(LensModel::kRadialTangential, {D.begin(), D.end()});
  const Eigen::Vector3d t = file.matrix(name_of("T", number), 3, 1);
  const Pose T_cam_first{Eigen::Quaterniond(file.rotation(name_of("R", number))).normalized(), t};
  camera.T_body_cam = T_cam_first.inverse();
  return camera;
}

/// Rectified cameras have the axes of camera 0 once R_rect_00 turned it.
RigCamera rectified_camera(const NamedNumbers& file, int number) {
  const std::string name = name_of("P_rect", number);
  const Projection P = file.matrix(name, 3, 4);
  if (!is_projection(P)) file.fault(name, kProjectionExpected);
  RigCamera camera = camera_of_projection(P);
  const Pose T_rectified_first{Eigen::Quaterniond(file.rotation(name_of("R_rect", 0))).normalized(),
                               {0, 0, 0}};
  camera.T_body_cam = T_rectified_first.inverse() * camera.T_body_cam;
  return camera;
}

}  // namespace

KittiRawCalibration::KittiRawCalibration(const fs::path& folder, int left, int right,
                                         cv::Size images) {
  const fs::path path = folder / "calib_cam_to_cam.txt";
  const NamedNumbers file(path);
  rectified_ = images == file.size(name_of("S_rect", left));
  const cv::Size original = file.size(name_of("S", left));
  if (!rectified_ && images != original) {
    file.fault(
        name_of("S", left),
        fmt::format("expected images of {} x {} (as they are) or {} x {} (rectified), found "
                    "{} x {}",
                    original.width, original.height, file.size(name_of("S_rect", left)).width,
                    file.size(name_of("S_rect", left)).height, images.width, images.height));
  }
  const std::array<int, 2> numbers{left, right};
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    cameras_[i] =
        rectified_ ? rectified_camera(file, numbers[i]) : unrectified_camera(file, numbers[i]);
    const cv::Size size = file.size(name_of(rectified_ ? "S_rect" : "S", numbers[i]));
    cameras_[i].model.width = size.width;
    cameras_[i].model.height = size.height;
    cameras_[i].name = i == 0 ? "left" : "right";
  }
}

std::optional<Pose> KittiRawCalibration::inertial_unit(const fs::path& folder) {
  const fs::path to_scanner = folder / "calib_imu_to_velo.txt";
  const fs::path to_camera = folder / "calib_velo_to_cam.txt";
  if (!is_present(to_scanner) || !is_present(to_camera)) return std::nullopt;
  return read_mount(to_camera) * read_mount(to_scanner);
}

}  // namespace vinebench::harness
