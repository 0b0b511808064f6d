// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/datasets/kitti/kitti_raw_reader.h"

#include <array>
#include <optional>

#include "core/files/input_file.h"
#include "core/util/error.h"
#include "harness/datasets/kitti/kitti_images.h"
#include "harness/datasets/kitti/kitti_oxts.h"
#include "harness/datasets/kitti/kitti_raw_calibration.h"
#include "harness/datasets/kitti/kitti_stamps.h"
#include "harness/datasets/reading/image_association.h"
#include "harness/datasets/reading/reading_order.h"
#include "harness/datasets/reading/recorded_images.h"

namespace vinebench::harness {
namespace {

namespace fs = std::filesystem;

constexpr const char* kCalibration = "calib_cam_to_cam.txt";
// Below this the estimator's integration between readings is too coarse:
// synchronised drives have one reading a frame.
constexpr double kLowestInertialRate = 40;  // Hz

fs::path camera_folder(const fs::path& drive, int camera) {
  return drive / fmt::format("image_{:02}", camera);
}

/// The left camera of the first pair that is there: grey, else in colour.
std::optional<int> left_camera(const fs::path& drive) {
  std::error_code ignored;
  for (const int left : {0, 2}) {
    if (fs::is_directory(camera_folder(drive, left) / "data", ignored)) return left;
  }
  return std::nullopt;
}

/// The folder of the day's calibration: the drive's own, else the one above.
fs::path calibration_folder(const fs::path& drive) {
  return is_present(drive / kCalibration) ? drive : fs::weakly_canonical(drive).parent_path();
}

/// Images with their stamps; 10 Hz where there are none.
ImageList read_images(const fs::path& camera) {
  const fs::path times = camera / "timestamps.txt";
  const bool timed = is_present(times);
  const std::vector<Stamp> stamps = timed ? read_kitti_stamps(times) : std::vector<Stamp>();
  ImageList list;
  list.camera = camera.filename().string();
  for (const auto& [number, file] : images_in(camera / "data")) {
    if (timed && number >= static_cast<std::int64_t>(stamps.size())) {
      fail("{}: expected a line for {}, found {}", times.string(), file.filename().string(),
           stamps.size());
    }
    list.entries.push_back(
        {timed ? stamps[static_cast<std::size_t>(number)] : stamp_of_frame(number, kKittiRate),
         file});
  }
  put_in_order(list);
  return list;
}

void set_frames(const fs::path& drive, int left, Recording& recording) {
  const std::vector<ImageList> lists{read_images(camera_folder(drive, left)),
                                     read_images(camera_folder(drive, left + 1))};
  const std::vector<Stamp> instants = instants_of(lists.front());
  recording.frames = associate_images(lists, instants);
  const Stamp period = median_period(instants);
  recording.rig.rate_hz = period > 0 ? 1 / to_seconds(period) : kKittiRate;
}

/// Truth and inertial readings of a unit on the body.
void set_unit(const fs::path& folder, const Pose& T_body_unit, Recording& recording) {
  if (!is_present(folder / "timestamps.txt")) return;
  KittiOxts oxts = read_kitti_oxts(folder);
  put_in_order(oxts.poses, "oxts", recording);
  for (const StampedPose& pose : oxts.poses) {
    recording.truth.push_back({pose.stamp, pose.pose * T_body_unit.inverse()});
  }
  std::vector<Stamp> stamps;
  for (const ImuSample& sample : oxts.inertial) stamps.push_back(sample.stamp);
  const Stamp period = median_period(stamps);
  if (period <= 0 || 1 / to_seconds(period) < kLowestInertialRate) return;
  for (ImuSample& sample : oxts.inertial) {
    if (T_body_unit.rotation.w() == 1) break;
    sample.angular_velocity = T_body_unit.rotation * sample.angular_velocity;
    sample.specific_force = T_body_unit.rotation * sample.specific_force;
  }
  recording.imu = std::move(oxts.inertial);
  put_in_order(recording.imu, "oxts", recording);
}

/// What is known of a drive's cameras and unit.
struct Day {
  std::optional<KittiRawCalibration> calibration;
  std::optional<Pose> T_first_unit;  ///< in camera 0 as it is
};

Day read_day(const fs::path& drive, int left, bool required, const Recording& recording) {
  const fs::path folder = calibration_folder(drive);
  Day day{std::nullopt, KittiRawCalibration::inertial_unit(folder)};
  if (!required && !is_present(folder / kCalibration)) return day;
  const cv::Size size = first_image_size(recording, 0);
  if (size.empty()) {
    fail("{}: no image of the left camera can be read",
         recording.frames.front().images[0].string());
  }
  day.calibration.emplace(folder, left, left + 1, size);
  return day;
}

Rig rig_of_day(const Day& day, double rate_hz) {
  const Pose T_body_first = day.T_first_unit
                                ? day.T_first_unit->inverse()
                                : Rig::mount(Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero());
  Rig rig;
  rig.name = "KITTI";
  rig.rate_hz = rate_hz;
  rig.stereo_pairs = {{"front", 0, 1}};
  for (std::size_t i = 0; i < 2; ++i) {
    RigCamera camera = day.calibration->camera(i);
    camera.T_body_cam = T_body_first * camera.T_body_cam;
    rig.cameras.push_back(std::move(camera));
  }
  return rig;
}

}  // namespace

bool is_kitti_raw(const fs::path& folder) {
  return left_camera(folder).has_value();
}

Recording read_kitti_raw(const fs::path& drive, const RecordingOptions& options) {
  const std::optional<int> left = left_camera(drive);
  if (!left) fail("{}: expected image_00/data or image_02/data", drive.string());
  Recording recording;
  recording.format = "KITTI raw";
  set_frames(drive, *left, recording);
  const Day day = read_day(drive, *left, options.rig.empty(), recording);
  const double rate = recording.rig.rate_hz;
  if (options.rig.empty()) {
    recording.rig = rig_of_day(day, rate);
  } else {
    set_rig(options.rig, 2, recording);
  }
  recording.rig.rate_hz = rate;
  const Pose& T_body_left = recording.rig.cameras.front().T_body_cam;
  recording.T_body_left = T_body_left;
  if (day.calibration && day.T_first_unit) {
    const Pose T_left_unit = day.calibration->camera(0).T_body_cam.inverse() * *day.T_first_unit;
    set_unit(drive / "oxts", T_body_left * T_left_unit, recording);
  }
  if (!options.groundtruth.empty()) recording.truth.clear();
  return recording;
}

}  // namespace vinebench::harness
